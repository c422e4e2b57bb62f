// SPDX-FileCopyrightText: 2026 The Hapnet authors
// SPDX-License-Identifier: MIT
//
// Many paths on two threads for HAPNET_SOAK_SECONDS (default 600): 28 links at 10 000 datagrams a
// second each way, and 64 clients.
#include "proto/net/clock.hpp"
#include "tests/e2e/emulator.hpp"
#include "tests/e2e/process.hpp"
#include "tests/e2e/udp.hpp"
#include "tests/soak/traffic.hpp"

#include <algorithm>
#include <chrono>
#include <csignal>
#include <cstdio>
#include <gtest/gtest.h>
#include <nlohmann/json.hpp>
#include <spdlog/fmt/fmt.h>
#include <string>
#include <vector>

namespace hapnet::soak {

namespace {

using namespace std::chrono_literals;
using nlohmann::json;

constexpr std::int64_t each_way_per_second = 10'000;

constexpr std::int64_t warm_up_seconds = 20;

/// The queued rows of fates of all paths vary; and 1 MiB.
constexpr std::int64_t growth_max_kib = 4096 + 1024;

const std::vector<std::string>& conditions()
{
    static const std::vector<std::string> words{
        "--in-flight", "32MiB",   "--threads",
        "2",           "--delay", "40ms",
        "--jitter",    "10ms",    "--order",
        "free",        "--loss",  "2%",
        "--duplicate", "1%",      "--corrupt",
        "1%",          "--set",   "all.rate={ limit = \"20Mbit/s\", queue = \"64KiB\" }"};
    return words;
}

/// An emulator with several paths, and what it writes.
class Running {
public:
    explicit Running(std::vector<std::string> words)
    {
        words.insert(words.end(), conditions().begin(), conditions().end());
        words.insert(words.end(), {"--stats", folder_.file("stats.json"), "--control", socket()});
        words.insert(words.end(), {"--fates", folder_.file("fates.csv")});
        process_.emplace("hapnet-emulator", words);
        const auto line = process_->wait_for_out("ready ", 10s);
        if (!line) throw std::runtime_error{"the emulator is not ready: " + process_->err()};
        ready = *line;
    }

    /// Changes it once a second until the end; gives the memory at the end of each second after
    /// the warm-up.
    std::vector<Memory> observe(const std::string& path)
    {
        const auto seconds = warm_up_seconds + setting("HAPNET_SOAK_SECONDS", 600);
        const std::vector<std::vector<std::string>> steps{
            {"set", path + ".delay", "60ms", "up.loss", "3%", "--for", "1500ms"},
            {"stats"},
            {"set", "down.order", "sorted"},
            {"show"},
            {"reset"}};
        std::vector<Memory> memory;
        const auto start = net::monotonic_now();
        for (std::int64_t second = 0; second < seconds; ++second) {
            auto words = steps[static_cast<std::size_t>(second) % steps.size()];
            words.insert(words.begin(), socket());
            const auto outcome = e2e::run("hapnet-ctl", words);
            EXPECT_EQ(outcome.exit, 0) << outcome.err;
            net::sleep_until(start + (second + 1) * 1s);
            if (second < warm_up_seconds) continue;
            memory.push_back(memory_of(process_->pid()));
            if (second % 60 == 59) fmt::print("{}", line(second + 1, memory.back()));
            std::fflush(stdout);
        }
        return memory;
    }

    json stop()
    {
        process_->signal(SIGTERM);
        EXPECT_EQ(process_->wait_exit(10s), 0) << process_->err();
        return json::parse(e2e::text_of(folder_.file("stats.json")));
    }

    std::string ready;

private:
    [[nodiscard]] std::string socket() const { return folder_.file("s"); }

    e2e::TemporaryFolder folder_;
    std::optional<e2e::Process> process_;
};

/// Expects that no more memory is allocated. Resident memory may grow within the reserved amount:
/// the ring in which datagrams wait for the rate is filled once, and each path has few datagrams.
void expect_no_allocation(const std::vector<Memory>& memory)
{
    std::int64_t most = 0;
    for (const Memory& one : memory) most = std::max(most, one.data);
    fmt::print("{}{}", line(0, memory.front()),
               line(static_cast<std::int64_t>(memory.size()), memory.back()));
    EXPECT_LT(most - memory.front().data, growth_max_kib);
}

/// Expects that every loss is counted: on each path, in the sums, and by the senders' counts.
void expect_accounted(const json& statistics, const json& paths, std::uint64_t sent)
{
    std::uint64_t received = 0;
    std::uint64_t overflowed = 0;
    for (const char* way : {"up", "down"}) {
        e2e::expect_identity(statistics[way]);
        EXPECT_EQ(statistics[way]["in_flight"], 0);
        EXPECT_GT(statistics[way]["delivered"], 0);
        std::uint64_t of_paths = 0;
        for (const json& path : paths) {
            e2e::expect_identity(path[way]);
            EXPECT_GT(path[way]["received"], 0);
            of_paths += path[way]["received"].get<std::uint64_t>();
        }
        EXPECT_EQ(statistics[way]["received"], of_paths);
        received += of_paths;
        overflowed += statistics[way]["overflowed"].get<std::uint64_t>();
        const auto& late = statistics[way]["lateness_us"];
        fmt::print("  {:4}: {} in, {} out, late by p50 {} us, p99 {} us, max {} us\n", way,
                   statistics[way]["received"].dump(), statistics[way]["delivered"].dump(),
                   late["p50"].dump(), late["p99"].dump(), late["max"].dump());
    }
    EXPECT_EQ(received + overflowed, sent);
    EXPECT_EQ(statistics["fates_lost"], 0);
}

} // namespace

TEST(ManyPaths, OfLinksLoseNothingUncountedAndKeepTheirMemory)
{
    constexpr std::size_t count = 28;
    Traffic traffic;
    std::vector<std::string> words;
    for (std::size_t i = 0; i < count; ++i) {
        words.insert(words.end(),
                     {"--link", fmt::format("l{}=127.0.0.1:0,127.0.0.1:0,{},{}", i,
                                            traffic.a().to_text(), traffic.b().to_text())});
    }
    Running emulator{words};
    std::vector<net::Endpoint> for_a;
    std::vector<net::Endpoint> for_b;
    for (std::size_t i = 0; i < count; ++i) {
        const auto at = emulator.ready.find(fmt::format(" l{}=", i));
        const auto begin = emulator.ready.find('=', at) + 1;
        const auto comma = emulator.ready.find(',', begin);
        const auto end = emulator.ready.find(' ', comma);
        for_a.push_back(e2e::endpoint_of(emulator.ready.substr(begin, comma - begin)));
        for_b.push_back(e2e::endpoint_of(emulator.ready.substr(comma + 1, end - comma - 1)));
    }
    traffic.start(each_way_per_second, for_a, for_b);
    expect_no_allocation(emulator.observe("l3"));
    traffic.stop();
    const auto statistics = emulator.stop();
    EXPECT_EQ(statistics["links"].size(), count);
    expect_accounted(statistics, statistics["links"], traffic.sent());
}

TEST(ManyPaths, OfClientsLoseNothingUncountedAndKeepTheirMemory)
{
    constexpr std::size_t count = 64;
    Traffic traffic{count};
    Running emulator{{"--listen", "127.0.0.1:0", "--upstream", traffic.b().to_text()}};
    traffic.start(each_way_per_second, {e2e::endpoint_in(emulator.ready, "listen")}, {});
    expect_no_allocation(emulator.observe("client.3"));
    traffic.stop();
    const auto statistics = emulator.stop();
    EXPECT_EQ(statistics["clients"].size(), count);
    expect_accounted(statistics, statistics["clients"], traffic.sent());
}

} // namespace hapnet::soak
