// SPDX-FileCopyrightText: 2026 The Hapnet authors
// SPDX-License-Identifier: MIT
//
// soak_daemons round FOLDER PEERS KILLS: judges the files of daemons in one session with KILLS
// kills: the records FOLDER/peer-ID.RUN.rec, the statistics FOLDER/peer-ID.json and what
// `hapnet-lab analyse --json` says of the last runs, FOLDER/analysis.json. Prints a row for a
// table, and each breach below it. soak_daemons header: what stands above these rows. soak_daemons
// emulator FILE: judges the statistics of the emulator between them. Exits 0 when all is well, 1
// after a breach, 2 when something cannot be read.
#include "proto/net/text_file.hpp"
#include "tests/soak/round_judge.hpp"

#include <algorithm>
#include <charconv>
#include <filesystem>
#include <nlohmann/json.hpp>
#include <numeric>
#include <spdlog/fmt/fmt.h>
#include <stdexcept>
#include <string>
#include <vector>

namespace {

namespace fs = std::filesystem;
namespace soak = hapnet::soak;
using Json = nlohmann::json;
using nlohmann::literals::operator""_json_pointer;

constexpr double apart_max_mm = 0.1;
constexpr double apart_max_deg = 0.1;

Json json_in(const fs::path& path)
{
    const auto text = hapnet::net::text_of_file(path.string());
    if (!text) throw std::runtime_error{text.error().message};
    auto json = Json::parse(*text, nullptr, /*exceptions*/ false);
    if (!json.is_object()) throw std::runtime_error{path.string() + " is not one object of JSON"};
    return json;
}

std::uint64_t number_at(const Json& json, const char* pointer)
{
    const Json::json_pointer where{pointer};
    if (!json.contains(where) || !json.at(where).is_number())
        throw std::runtime_error{fmt::format("the statistics have no number {}", pointer)};
    return json.at(where).get<std::uint64_t>();
}

/// The results of a round.
struct Round {
    soak::Verdict sum;
    soak::Poses poses;
    double settled_mm = 0.0;
    bool valid = true;
    std::vector<std::string> breaches;
};

void add_record(Round& round, const fs::path& path)
{
    const auto record = hapnet::record::read(path.string());
    if (!record) throw std::runtime_error{record.error().message};
    const auto verdict = soak::judge(*record);
    if (!verdict) throw std::runtime_error{path.string() + ": " + verdict.error().message};
    soak::Verdict& sum = round.sum;
    sum.hands_on_s += verdict->hands_on_s;
    sum.silences += verdict->silences;
    sum.died_touching += verdict->died_touching;
    sum.counted_max_ms = std::max(sum.counted_max_ms, verdict->counted_max_ms);
    sum.felt_max_ms = std::max(sum.felt_max_ms, verdict->felt_max_ms);
    sum.played_on += verdict->played_on;
    sum.lasted += verdict->lasted;
    sum.force_max_n = std::max(sum.force_max_n, verdict->force_max_n);
    sum.was_at_fault = sum.was_at_fault || verdict->was_at_fault;
    for (const std::string& breach : verdict->breaches)
        round.breaches.push_back(fmt::format("peer {}: {}", verdict->peer, breach));
    soak::add_poses(round.poses, *record);
}

void add_statistics(Round& round, const fs::path& path)
{
    const Json json = json_in(path);
    round.valid = round.valid && json.value("valid", false);
    // A machine that stood still: the peer ended at zero force, and says so by its exit code.
    const bool at_fault = json.value("/governor/fault"_json_pointer, "") != "none";
    const auto exit = hapnet::net::text_of_file(fs::path{path}.replace_extension(".exit").string());
    if (!exit || (*exit != "0\n" && !at_fault))
        round.breaches.push_back(path.filename().string() + ": its exit code was not 0");
    const auto expect_none = [&](const char* pointer) {
        if (const auto count = number_at(json, pointer); count != 0)
            round.breaches.push_back(
                fmt::format("{}: {} is {}", path.filename().string(), pointer, count));
    };
    for (const char* pointer :
         {"/messages/malformed", "/messages/other_version", "/messages/implausible",
          "/messages/strangers", "/record_rows_lost"})
        expect_none(pointer);
    if (json.value("secure", Json{}).is_object()) {
        for (const char* pointer :
             {"/secure/forged", "/secure/unsealed", "/secure/other_circle", "/secure/misnamed"})
            expect_none(pointer);
    }
}

/// Reads all files of a round, and combines them.
Round round_in(const fs::path& folder)
{
    std::vector<fs::path> paths;
    for (const auto& entry : fs::directory_iterator{folder}) paths.push_back(entry.path());
    std::ranges::sort(paths);
    Round round;
    for (const fs::path& path : paths) {
        const bool is_of_peer = path.filename().string().starts_with("peer-");
        if (is_of_peer && path.extension() == ".rec") add_record(round, path);
        if (is_of_peer && path.extension() == ".json") add_statistics(round, path);
    }
    return round;
}

void judge_copies(Round& round, const fs::path& folder, std::size_t peers)
{
    const Json analysis = json_in(folder / "analysis.json");
    round.valid = round.valid && analysis.value("valid", false);
    const Json settled = analysis.value("settled_discrepancy_mm", Json{});
    if (settled.is_number()) {
        round.settled_mm = settled.get<double>();
    } else {
        round.breaches.emplace_back("they never had hands off together");
    }
    const soak::Apart apart = soak::apart(round.poses);
    round.settled_mm = std::max(round.settled_mm, apart.distance_mm);
    if (apart.copies != peers)
        round.breaches.push_back(
            fmt::format("{} of {} copies of a body are known", apart.copies, peers));
    if (round.settled_mm > apart_max_mm || apart.angle_deg > apart_max_deg)
        round.breaches.push_back(fmt::format("the copies are {:.4f} mm and {:.4f} degrees apart",
                                             round.settled_mm, apart.angle_deg));
}

int judge_round(const fs::path& folder, std::size_t peers, std::size_t kills)
{
    Round round = round_in(folder);
    judge_copies(round, folder, peers);
    const soak::Verdict& sum = round.sum;
    if (sum.silences < kills * (peers - 1))
        round.breaches.push_back(
            fmt::format("the others noticed {} times that one of them was killed, and {} were",
                        sum.silences, kills));
    if (peers > 2 && kills > 0 && sum.lasted == 0 && !sum.was_at_fault)
        round.breaches.emplace_back("none was away for so long that the others could play on");
    fmt::print("{:>8.0f} {:>6} {:>9} {:>8.1f} {:>8.1f} {:>9} {:>8.3f} {:>8.4f} {:>8.4f}  {:<5}  "
               "{}\n",
               sum.hands_on_s, kills, sum.died_touching, sum.counted_max_ms, sum.felt_max_ms,
               fmt::format("{}/{}", sum.played_on, sum.lasted), sum.force_max_n, round.settled_mm,
               soak::apart(round.poses).angle_deg, round.valid ? "yes" : "no",
               round.breaches.empty() ? "passed" : "BROKEN");
    for (const std::string& breach : round.breaches) fmt::print("    {}\n", breach);
    return round.breaches.empty() ? 0 : 1;
}

int judge_emulator(const fs::path& path)
{
    const Json json = json_in(path);
    int code = 0;
    for (const auto& [name, link] : json.at("links").items()) {
        for (const char* way : {"up", "down"}) {
            const Json& counts = link.at(way);
            const auto& dropped = counts.at("dropped");
            const auto drops = std::accumulate(
                dropped.begin(), dropped.end(), std::uint64_t{0},
                [](std::uint64_t sum, const Json& n) { return sum + n.get<std::uint64_t>(); });
            const auto in = number_at(counts, "/received") + number_at(counts, "/duplicated");
            const auto out =
                number_at(counts, "/delivered") + drops + number_at(counts, "/in_flight");
            if (in == out) continue;
            fmt::print("    {} {}: {} datagrams in, {} out\n", name, way, in, out);
            code = 1;
        }
    }
    fmt::print("emulator: every datagram is in one counter: {}; strangers: {}; valid: {}\n",
               code == 0 ? "yes" : "NO",
               number_at(json, "/up/strangers") + number_at(json, "/down/strangers"),
               json.value("valid", false) ? "yes" : "no");
    return code;
}

int print_header()
{
    fmt::print("{:>8} {:>6} {:>9} {:>8} {:>8} {:>9} {:>8} {:>8} {:>8}  {:<5}  {}\n", "hands s",
               "kills", "touching", "gone ms", "zero ms", "plays on", "force N", "apart mm",
               "degrees", "valid", "verdict");
    return 0;
}

int refuse()
{
    fmt::print(stderr, "usage: soak_daemons header | round FOLDER PEERS KILLS | emulator FILE\n");
    return 2;
}

} // namespace

int main(int argc, char** argv)
{
    const std::vector<std::string> words(argv + 1, argv + argc);
    const auto number = [](const std::string& word) {
        std::size_t value = 0;
        std::from_chars(word.data(), word.data() + word.size(), value);
        return value;
    };
    try {
        if (words.size() == 1 && words[0] == "header") return print_header();
        if (words.size() == 2 && words[0] == "emulator") return judge_emulator(words[1]);
        if (words.size() != 4 || words[0] != "round" || number(words[2]) < 2) return refuse();
        return judge_round(words[1], number(words[2]), number(words[3]));
    } catch (const std::exception& problem) {
        fmt::print(stderr, "soak_daemons: {}\n", problem.what());
        return 2;
    }
}
