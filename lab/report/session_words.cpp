// SPDX-FileCopyrightText: 2026 The Hapnet authors
// SPDX-License-Identifier: MIT
#include "lab/report/session_words.hpp"

#include "emulator/core/profile/text.hpp"
#include "lab/report/played.hpp"

#include <algorithm>
#include <cmath>
#include <optional>
#include <spdlog/fmt/fmt.h>
#include <string_view>

namespace hapnet::lab::report {

namespace {

using results::RecordedPeer;
using results::RecordedSession;

/// The `boot_id` in records of sessions in virtual time.
constexpr std::string_view virtual_boot = "virtual time";

/// Returns a value of a configuration as a text; empty where there is none.
std::string said(const RecordedPeer& peer, const char* key)
{
    const auto found = peer.config.find(key);
    if (found == peer.config.end() || found->is_null()) return "";
    return found->is_string() ? found->get<std::string>() : found->dump();
}

std::string seconds(base::Duration length)
{
    return fmt::format("{:g} s", std::round(1e3 * base::to_seconds(length)) / 1e3);
}

/// Returns "a simulated hand", or a description of the device; empty where the record does not say.
std::string hand_of(const RecordedPeer& peer)
{
    const std::string device = said(peer, "device");
    if (device == "sim" || !said(peer, "operator").empty()) return "a simulated hand";
    return device == "replay" ? "a recorded hand" : device;
}

std::string players_of(const RecordedSession& session)
{
    const auto& [a, b] = std::pair{session.a, session.b};
    const std::string hand_a = hand_of(a), hand_b = hand_of(b);
    if (hand_a.empty() || hand_b.empty()) return fmt::format("Peers {} (A) and {} (B)", a.id, b.id);
    if (hand_a == "a simulated hand" && hand_a == hand_b)
        return fmt::format("Two simulated hands, A (peer {}) and B (peer {}),", a.id, b.id);
    return fmt::format("A (peer {}, {}) and B (peer {}, {})", a.id, hand_a, b.id, hand_b);
}

/// Quotes a word for a shell.
std::string word(const std::string& text)
{
    const auto is_plain = [](char c) {
        return std::isalnum(static_cast<unsigned char>(c)) != 0 ||
               std::string_view{"-_./:=,+%@"}.find(c) != std::string_view::npos;
    };
    if (!text.empty() && std::ranges::all_of(text, is_plain)) return text;
    std::string quoted = "'";
    for (const char c : text) quoted += c == '\'' ? "'\\''" : std::string{c};
    return quoted + "'";
}

/// Returns the other peers in the form for a peer's command: one by its address alone, several also
/// by their ids.
std::string others_of(const RecordedPeer& peer)
{
    const auto others = peer.config.value("peers", nlohmann::json::array());
    if (!others.is_array() || others.size() < 2) return " --remote HOST:PORT";
    std::string words;
    for (const auto& id : others) words += fmt::format(" --peer {}=HOST:PORT", id.dump());
    return words;
}

/// Returns the command of a peer, as far as its record holds it.
std::string command_of(const RecordedPeer& peer, base::Duration length)
{
    std::string command = fmt::format("hapnet-peer --id {}{}", peer.id, others_of(peer));
    for (const char* key : {"task", "scene", "algorithm", "seed", "operator"}) {
        const std::string value = said(peer, key);
        if (!value.empty()) command += fmt::format(" --{} {}", key, word(value));
    }
    command += fmt::format(" \\\n    --duration {:g}s", base::to_seconds(length));
    return command + " --record " + word(peer.file.empty() ? "FILE" : peer.file);
}

} // namespace

bool is_virtual(const RecordedSession& session)
{
    return said(session.a, "boot_id") == virtual_boot;
}

std::string about_network(const RecordedSession& session)
{
    if (const std::string toml = said(session.a, "network_toml"); !toml.empty()) {
        const auto profile = emulator::parse_profile(toml, "network_toml", {});
        const std::string asked = profile ? network_in_words(*profile) : toml;
        return fmt::format("Asked of the network: {}.",
                           asked.empty() ? "nothing, it is perfect" : asked);
    }
    if (is_virtual(session))
        return "What was asked of the network is not in the records: the manifest.json of the "
               "experiment has it.";
    return "What was asked of the network is not in the records. An emulator that is started with "
           "--stats RUN.json tells it: hapnet-emulator report RUN.json --out run.html draws what "
           "was asked and what came of it.";
}

std::string sentence_of(const RecordedSession& session)
{
    std::string text = players_of(session) + " played";
    if (!session.task.empty()) text += " task " + session.task;
    const std::string scene = said(session.a, "scene");
    if (!scene.empty()) text += fmt::format(" in the scene {}", scene);
    text += " for " + seconds(session.length);
    if (!session.algorithm.empty()) text += " with the algorithm " + session.algorithm;
    return text + (is_virtual(session) ? ", in virtual time." : ".");
}

std::string about_clocks(const RecordedSession& session)
{
    if (is_virtual(session))
        return "Both peers played in virtual time, which is one clock: the delays "
               "are exact, and no tick is late.";
    const records::Clock& clock = session.analysis.clock;
    if (clock.method == records::ClockMethod::same_boot)
        return "Both peers ran on one machine, so both stamps of a message are of one clock.";
    if (clock.method == records::ClockMethod::synchronised)
        return fmt::format("Two clocks, which both peers state to be synchronised: each delay may "
                           "be wrong by up to {:.3f} ms.",
                           1e3 * base::to_seconds(clock.uncertainty));
    return fmt::format(
        "Two clocks: B’s was {:.3f} ms ahead of A’s, and ran {:.1f} ppm faster. That is estimated "
        "from the echoes in the messages, as if the shortest delays of both directions were "
        "equal. Where they are not, half of their difference is taken from the delays of one "
        "direction and added to those of the other: each may be wrong by up to {:.3f} ms, and the "
        "sum of both directions is right.",
        1e3 * base::to_seconds(clock.offset), 1e6 * clock.skew,
        1e3 * base::to_seconds(clock.uncertainty));
}

records::TextTable settings_table(const RecordedSession& session)
{
    records::TextTable table{"What the records say of both peers", "", {"A", "B"}};
    const auto add = [&](std::string name, const std::string& a, const std::string& b) {
        if (a.empty() && b.empty()) return;
        const auto cell = [](const std::string& text) { return text.empty() ? "–" : text; };
        table.rows.push_back({std::move(name), {cell(a), cell(b)}});
    };
    add("peer", std::to_string(session.a.id), std::to_string(session.b.id));
    add("record", session.a.file, session.b.file);
    for (const auto& [name, key] : {std::pair{"program", "program"},
                                    {"version", "version"},
                                    {"commit", "commit"},
                                    {"device", "device"},
                                    {"simulated hand", "operator"},
                                    {"task", "task"},
                                    {"scene", "scene"},
                                    {"scene, its hash", "scene_hash"},
                                    {"algorithm", "algorithm"},
                                    {"seed", "seed"},
                                    {"duration, s", "duration_s"},
                                    {"force limit, N", "force_limit_n"}})
        add(name, said(session.a, key), said(session.b, key));
    table.remarks.emplace_back("The seed of the lower id counts for both.");
    return table;
}

std::vector<Repeat> repeats_of(const RecordedSession& session)
{
    const auto named = [](const RecordedPeer& peer, const char* otherwise) {
        return word(peer.file.empty() ? otherwise : peer.file);
    };
    const std::string a = named(session.a, "A.rec"), b = named(session.b, "B.rec");
    std::vector<Repeat> repeats{
        {"The numbers of this page, the page itself, and both worlds as they moved:",
         {fmt::format("hapnet-lab analyse {} {}", a, b),
          fmt::format("hapnet-lab report {} {}", a, b),
          fmt::format("hapnet-lab play {} {} --control lab.sock", a, b)}},
        {"Each peer again in virtual time, with the device’s samples and the messages that its "
         "record holds:",
         {"hapnet-lab replay " + a, "hapnet-lab replay " + b}}};
    if (is_virtual(session)) {
        repeats.push_back({"hapnet-lab played the session: its command and its network stand in "
                           "the manifest.json of the experiment.",
                           {}});
        return repeats;
    }
    repeats.push_back(
        {"The same session with fresh hands, through a network of yours:",
         {command_of(session.a, session.length), command_of(session.b, session.length)}});
    return repeats;
}

} // namespace hapnet::lab::report
