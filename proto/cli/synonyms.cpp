// SPDX-FileCopyrightText: 2026 The Hapnet authors
// SPDX-License-Identifier: MIT
#include "proto/cli/synonyms.hpp"

#include "proto/base/reading.hpp"

#include <algorithm>
#include <array>
#include <cctype>
#include <spdlog/fmt/fmt.h>
#include <vector>

namespace hapnet::cli {

namespace {

/// A word that a user may type, and its name here: an option ("--rate"), or a command line of a
/// program ("hapnet-emulator check"). Only names that the present program has are suggested.
struct Synonym {
    std::string_view typed;
    std::string_view meant;
};

constexpr std::string_view normal_jitter = R"(--jitter '{ law = "normal", sd = "3ms" }')";

constexpr std::array synonyms{
    // tc-netem, tcconfig, pumba
    Synonym{"bandwidth", "--rate"},
    Synonym{"bw", "--rate"},
    Synonym{"throughput", "--rate"},
    Synonym{"bitrate", "--rate"},
    Synonym{"limit-rate", "--rate"},
    Synonym{"latency", "--delay"},
    Synonym{"lag", "--delay"},
    Synonym{"delay-time", "--delay"},
    Synonym{"rtt", "--delay"},
    Synonym{"ping", "--delay"},
    Synonym{"delay-distro", "--jitter"},
    Synonym{"distribution", "--jitter"},
    Synonym{"correlation", "--correlation-time"},
    Synonym{"sd", normal_jitter},
    Synonym{"stddev", normal_jitter},
    Synonym{"variation", "--jitter"},
    Synonym{"delay-variation", "--jitter"},
    Synonym{"packet-loss", "--loss"},
    Synonym{"packetloss", "--loss"},
    Synonym{"drop", "--loss"},
    Synonym{"drop-rate", "--loss"},
    Synonym{"loss-rate", "--loss"},
    Synonym{"burst", "--burst-loss"},
    Synonym{"burstloss", "--burst-loss"},
    Synonym{"gemodel", "--loss"},
    Synonym{"duplication", "--duplicate"},
    Synonym{"dup", "--duplicate"},
    Synonym{"corruption", "--corrupt"},
    Synonym{"tamper", "--corrupt"},
    Synonym{"bit-errors", "--corrupt"},
    Synonym{"ber", "--corrupt"},
    Synonym{"reordering", "--reorder"},
    Synonym{"ood", "--reorder"},
    Synonym{"out-of-order", "--reorder"},
    Synonym{"gap", "--reorder"},
    Synonym{"slot", "--rate"},
    Synonym{"throttle", "--rate"},
    Synonym{"queue", "--rate"},
    Synonym{"limit", "--in-flight"},
    Synonym{"assert", "--require"},
    Synonym{"fail-on", "--require"},
    Synonym{"tc", "--netem"},
    Synonym{"qdisc", "--netem"},
    // toxiproxy
    Synonym{"preset", "--profile"},
    Synonym{"toxic", "--profile"},
    Synonym{"toxicity", "--loss"},
    Synonym{"conditions", "--profile"},
    Synonym{"config", "--profile"},
    Synonym{"file", "--profile"},
    Synonym{"listen", "--listen-a"},
    Synonym{"upstream", "--b"},
    Synonym{"downstream", "--a"},
    Synonym{"client", "--a"},
    Synonym{"server", "--b"},
    Synonym{"target", "--b"},
    // iperf and the like
    Synonym{"time", "--duration"},
    Synonym{"length", "--duration"},
    Synonym{"for", "--duration"},
    Synonym{"port", "--listen"},
    Synonym{"port", "--listen-a"},
    Synonym{"bind", "--listen"},
    Synonym{"bind", "--listen-a"},
    Synonym{"local", "--listen"},
    Synonym{"host", "--remote"},
    Synonym{"connect", "--remote"},
    Synonym{"peer", "--remote"},
    Synonym{"dest", "--remote"},
    Synonym{"interval", "--every"},
    Synonym{"n", "--packets"},
    Synonym{"count", "--packets"},
    Synonym{"size", "--bytes"},
    Synonym{"payload", "--bytes"},
    Synonym{"packet-size", "--mtu"},
    // any program
    Synonym{"dry-run", "hapnet-emulator check"},
    Synonym{"dryrun", "hapnet-emulator check"},
    Synonym{"check", "hapnet-emulator check"},
    Synonym{"validate", "hapnet-emulator check"},
    Synonym{"predict", "hapnet-emulator predict"},
    Synonym{"verify", "hapnet-emulator verify"},
    Synonym{"list-presets", "hapnet-emulator check --list"},
    Synonym{"presets", "hapnet-emulator check --list"},
    Synonym{"devices", "hapnet-peer list-devices"},
    Synonym{"list-devices", "hapnet-peer list-devices"},
    Synonym{"list", "hapnet-emulator check --list"},
    Synonym{"list", "hapnet-peer list-devices"},
    Synonym{"random-seed", "--seed"},
    Synonym{"rng", "--seed"},
    Synonym{"output", "--out"},
    Synonym{"output", "--stats"},
    Synonym{"o", "--out"},
    Synonym{"o", "--stats"},
    Synonym{"out", "--stats"},
    Synonym{"stat", "--stats"},
    Synonym{"statistics", "--stats"},
    Synonym{"metrics", "--stats"},
    Synonym{"log", "--fates"},
    Synonym{"log", "--record"},
    Synonym{"trace", "--fates"},
    Synonym{"trace", "--record"},
    Synonym{"capture", "--pcap"},
    Synonym{"pcapng", "--pcap"},
    Synonym{"sock", "--socket"},
    Synonym{"sock", "--control"},
    Synonym{"socket", "--control"},
    Synonym{"ctl", "--control"},
    Synonym{"until", "hapnet-ctl SOCKET wait"},
    Synonym{"threads", "--jobs"},
    Synonym{"j", "--jobs"},
    Synonym{"parallel", "--jobs"},
    Synonym{"algo", "--algorithm"},
    Synonym{"compensation", "--algorithm"},
    Synonym{"hand", "--operator"},
    Synonym{"person", "--operator"},
    Synonym{"max-force", "--force-limit"},
    Synonym{"force", "--force-limit"},
    Synonym{"scale", "--mount-scale"},
    Synonym{"offset", "--mount-offset"},
    Synonym{"no-key", "--insecure"},
    Synonym{"unsafe", "--insecure"},
    Synonym{"dt", "--tick"},
    Synonym{"step", "--tick"},
};

/// Words in the place of a command, and the command to suggest.
constexpr std::array commands{
    Synonym{"start", "hapnet-emulator --listen-a ADDRESS --listen-b ADDRESS"},
    Synonym{"run", "hapnet-emulator --listen-a ADDRESS --listen-b ADDRESS"},
    Synonym{"relay", "hapnet-emulator --listen-a ADDRESS --listen-b ADDRESS"},
    Synonym{"proxy", "hapnet-emulator --listen-a ADDRESS --listen-b ADDRESS"},
    Synonym{"start", "hapnet-peer --remote ADDRESS"},
    Synonym{"run", "hapnet-peer --remote ADDRESS"},
    Synonym{"connect", "hapnet-peer --remote ADDRESS"},
    Synonym{"start", "hapnet-lab run"},
    Synonym{"validate", "hapnet-emulator check"},
    Synonym{"lint", "hapnet-emulator check"},
    Synonym{"dry-run", "hapnet-emulator check"},
    Synonym{"show", "hapnet-emulator check"},
    Synonym{"list", "hapnet-emulator check --list"},
    Synonym{"presets", "hapnet-emulator check --list"},
    Synonym{"simulate", "hapnet-emulator predict"},
    Synonym{"test", "hapnet-emulator verify"},
    Synonym{"list", "hapnet-peer list-devices"},
    Synonym{"devices", "hapnet-peer list-devices"},
    Synonym{"diagnose", "hapnet-peer doctor"},
    Synonym{"selftest", "hapnet-peer self-test"},
    Synonym{"test", "hapnet-peer self-test"},
    Synonym{"csv", "hapnet-lab export"},
    Synonym{"dump", "hapnet-lab export"},
    Synonym{"plot", "hapnet-lab report"},
    Synonym{"experiment", "hapnet-lab run"},
    Synonym{"scene", "hapnet-lab explain"},
    Synonym{"get", "hapnet-ctl SOCKET show"},
    Synonym{"status", "hapnet-ctl SOCKET show"},
    Synonym{"change", "hapnet-ctl SOCKET set"},
    Synonym{"add", "hapnet-ctl SOCKET set"},
    Synonym{"load", "hapnet-ctl SOCKET apply"},
    Synonym{"statistics", "hapnet-ctl SOCKET stats"},
    Synonym{"metrics", "hapnet-ctl SOCKET stats"},
    Synonym{"quit", "hapnet-ctl SOCKET stop"},
    Synonym{"exit", "hapnet-ctl SOCKET stop"},
    Synonym{"kill", "hapnet-ctl SOCKET stop"},
    Synonym{"monitor", "hapnet-ctl SOCKET watch"},
    Synonym{"clear", "hapnet-ctl SOCKET reset"},
    Synonym{"restore", "hapnet-ctl SOCKET reset"},
};

/// Another name for a value of an option. If `why` is set, this project has no such value.
struct ValueSynonym {
    std::string_view option;
    std::string_view typed;
    std::string_view meant;
    std::string_view why{};
};

constexpr std::array values{
    ValueSynonym{"--algorithm", "dr", "dead-reckoning"},
    ValueSynonym{"--algorithm", "deadreckoning", "dead-reckoning"},
    ValueSynonym{"--algorithm", "dead_reckoning", "dead-reckoning"},
    ValueSynonym{"--algorithm", "none", "base"},
    ValueSynonym{"--algorithm", "paper", "base"},
    ValueSynonym{"--algorithm", "hybrid", "base"},
    ValueSynonym{"--algorithm", "tidec", "sep",
                 "TiDeC is not open; sep is its open stand-in: --algorithm sep"},
    ValueSynonym{"--device", "simulated", "sim"},
    ValueSynonym{"--device", "none", "sim"},
    ValueSynonym{"--timing", "accurate", "precise"},
    ValueSynonym{"--timing", "busy", "spin"},
    ValueSynonym{"--timing", "sleep", "eco"},
};

std::string plain(std::string_view word)
{
    std::string text;
    for (const char c : word) {
        text += c == '_' ? '-' : static_cast<char>(std::tolower(static_cast<unsigned char>(c)));
    }
    return text;
}

std::vector<std::string_view> option_names(const Command& command,
                                           std::vector<std::string>& storage)
{
    storage = {"--help", "--version"};
    for (const Command* one : {&command, command.parent()}) {
        if (one == nullptr || (one != &command && !one->needs_command())) continue;
        for (const Option& option : one->options()) {
            if (!option.is_positional()) storage.push_back(option.name());
        }
    }
    return {storage.begin(), storage.end()};
}

const Command& program_of(const Command& command)
{
    return command.parent() == nullptr ? command : *command.parent();
}

std::vector<std::string_view> names_of(const Command& program)
{
    std::vector<std::string_view> names;
    for (const Command& command : program.commands()) names.push_back(command.name());
    return names;
}

/// Returns a table's suggestion for a word; "" if it has none that this program supports.
template <std::size_t size>
std::string proposed(const std::array<Synonym, size>& table, std::string_view word,
                     std::span<const std::string_view> options, const Command& program)
{
    for (const auto& [typed, meant] : table) {
        const bool is_of_program = meant.starts_with(program.name() + " ");
        const auto option = meant.substr(0, meant.find(' ')); // without an example of its value
        const bool is_option = std::find(options.begin(), options.end(), option) != options.end();
        if (typed == word && (is_of_program || is_option)) return std::string{meant};
    }
    return "";
}

std::string option_meant(const Command& command, std::string_view typed)
{
    std::vector<std::string> storage;
    const auto names = option_names(command, storage);
    const auto dashes = std::min(typed.find_first_not_of('-'), typed.size());
    const std::string word = plain(typed.substr(dashes, typed.find('=') - dashes));
    for (const std::string_view prefix : {"", "both.", "up.", "down."}) {
        if (!word.starts_with(prefix)) continue;
        const std::string rest = word.substr(prefix.size());
        const std::string way = prefix == "both." ? "" : std::string{prefix};
        auto name = proposed(synonyms, rest, names, program_of(command));
        if (!name.empty() && !way.empty() && name.starts_with("--")) {
            return fmt::format("--{}{}", way, name.substr(2));
        }
        if (!name.empty()) return name;
        auto exact = fmt::format("--{}{}", way, rest);
        if (std::find(names.begin(), names.end(), exact) != names.end()) return exact;
    }
    std::vector<std::string_view> undashed;
    for (const std::string_view name : names) undashed.push_back(name.substr(2));
    const auto nearest = base::nearest(word, undashed);
    return nearest ? fmt::format("--{}", *nearest) : "";
}

} // namespace

std::string unknown_option(const Command& command, std::string_view word)
{
    const auto name = word.substr(0, word.find('='));
    const std::string meant = option_meant(command, word);
    if (!meant.empty()) return fmt::format("unknown option {}: did you mean {}?", name, meant);
    return fmt::format("unknown option {}: {} --help lists the options", name, command.path());
}

std::string command_meant(const Command& program, std::string_view word)
{
    auto meant = proposed(commands, plain(word), {}, program);
    if (!meant.empty()) return meant;
    const auto name = base::nearest(plain(word), names_of(program));
    return name ? program.find_command(*name)->path() : "";
}

std::string unknown_command(const Command& program, std::string_view word)
{
    const std::string meant = command_meant(program, word);
    if (!meant.empty()) return fmt::format("unknown command '{}': did you mean {}?", word, meant);
    return fmt::format("unknown command '{}': commands are {}", word,
                       fmt::join(names_of(program), ", "));
}

base::Result<std::string> meant_value(std::string_view option, const std::string& value)
{
    for (const ValueSynonym& synonym : values) {
        if (synonym.option != option || synonym.typed != plain(value)) continue;
        if (synonym.why.empty()) return std::string{synonym.meant};
        return base::fail(fmt::format("'{}': {}", value, synonym.why));
    }
    return value;
}

} // namespace hapnet::cli
