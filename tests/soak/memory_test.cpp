// SPDX-FileCopyrightText: 2026 The Hapnet authors
// SPDX-License-Identifier: MIT
//
// An emulator with everything switched on, for HAPNET_SOAK_SECONDS (default 600), at 20 000
// datagrams a second: 10 000 each way.
#include "proto/net/clock.hpp"
#include "tests/e2e/emulator.hpp"
#include "tests/e2e/process.hpp"
#include "tests/soak/capture_reader.hpp"
#include "tests/soak/traffic.hpp"

#include <algorithm>
#include <array>
#include <chrono>
#include <cstdio>
#include <fstream>
#include <gtest/gtest.h>
#include <nlohmann/json.hpp>
#include <spdlog/fmt/fmt.h>
#include <string>
#include <tuple>
#include <vector>

namespace hapnet::soak {

namespace {

using namespace std::chrono_literals;

constexpr std::int64_t datagrams_per_second = 10'000; // each way

constexpr std::string_view everything = R"(name = "everything at once"
seed = 7

[both]
mtu = "1400B"
rate = { limit = "100Mbit/s", queue = "128KiB" }
loss = [
    "0.5%",
    { law = "k-of-n", lost = 1, of = 500 },
    { law = "gilbert-elliott", good_to_bad = "0.1%", bad_to_good = "25%" },
    { law = "four-state", share = "0.5%", burst = 10, density = "80%", isolated = "0.1%" },
    { law = "timed-burst", lost = "2ms", every = "1s" },
]
corrupt = "1%"
duplicate = "1%"
delay = "60ms"
jitter = { law = "gamma", mean = "8ms", sd = "5ms", correlation_time = "20ms", order = "free" }
reorder = { share = "1%", displacement = 3 }
)";

/// Two ramps; at its lowest rate the queue overflows.
constexpr std::string_view ramps = R"(
[[at]]
time = "0s"
ramp = "700ms"
up.delay = "20ms"
up.rate = "5Mbit/s"

[[at]]
time = "100ms"
ramp = "800ms"
down.delay = "30ms"
down.corrupt = "5%"
)";

/// Changes that a person makes repeatedly, once a second.
std::vector<std::vector<std::string>> changes(const std::string& ramped_profile)
{
    return {{"set", "both.delay", "50ms", "up.loss", "3%", "--for", "1500ms"},
            {"set", "down.rate", "20Mbit/s", "down.order", "sorted"},
            {"apply", ramped_profile},
            {"stats"},
            {"reset"}};
}

/// Changes it once a second until the end; gives the memory at the end of each second.
std::vector<Memory> observe(e2e::Emulator& emulator, const std::string& socket,
                            const std::vector<std::vector<std::string>>& steps,
                            std::int64_t seconds)
{
    std::vector<Memory> memory;
    const auto start = net::monotonic_now();
    for (std::int64_t second = 0; second < seconds; ++second) {
        auto words = steps[static_cast<std::size_t>(second) % steps.size()];
        words.insert(words.begin(), socket);
        const auto outcome = e2e::run("hapnet-ctl", words);
        EXPECT_EQ(outcome.exit, 0) << outcome.err;
        net::sleep_until(start + (second + 1) * 1s);
        memory.push_back(memory_of(emulator.process().pid()));
        if (second % 60 == 59) fmt::print("{}", line(second + 1, memory.back()));
        std::fflush(stdout);
    }
    return memory;
}

std::uint64_t lines_of(const std::string& path)
{
    std::ifstream file{path, std::ios::binary};
    std::vector<char> part(1 << 20);
    std::uint64_t lines = 0;
    while (file.read(part.data(), static_cast<std::streamsize>(part.size())), file.gcount() > 0) {
        lines += static_cast<std::uint64_t>(
            std::count(part.begin(), part.begin() + file.gcount(), '\n'));
    }
    return lines;
}

void print(const char* direction, const nlohmann::json& of)
{
    const auto& late = of["lateness_us"];
    fmt::print("  {:4}: {} in, {} out, {} overflowed, late by p50 {} us, p99 {} us, max {} us\n",
               direction, of["received"].dump(), of["delivered"].dump(), of["overflowed"].dump(),
               late["p50"].dump(), late["p99"].dump(), late["max"].dump());
    for (const auto& [cause, count] : of["dropped"].items()) {
        if (count != 0) fmt::print("        {} {}\n", count.dump(), cause);
    }
}

} // namespace

TEST(Soak, MemoryStaysFlatWithEverythingSwitchedOn)
{
    const auto seconds = setting("HAPNET_SOAK_SECONDS", 600);
    const e2e::TemporaryFolder folder;
    const std::string profile = folder.file("everything.toml");
    const std::string ramped = folder.file("ramped.toml");
    const std::string socket = folder.file("control.sock");
    std::ofstream{profile} << everything;
    std::ofstream{ramped} << everything << ramps;
    CaptureReader capture{folder.file("run.pcapng")};
    Traffic traffic;
    e2e::Emulator emulator{{"--a", traffic.a().to_text(), "--b", traffic.b().to_text(), "--profile",
                            profile, "--control", socket, "--fates", folder.file("fates.csv"),
                            "--pcap", capture.path()}};

    traffic.start(datagrams_per_second, {emulator.a()}, {emulator.b()});
    expect_flat(observe(emulator, socket, changes(ramped), seconds));
    traffic.stop();
    const auto statistics = emulator.stop(); // expects the identity, and files without losses

    std::uint64_t received = 0;
    std::uint64_t delivered = 0;
    for (const char* direction : {"up", "down"}) {
        const auto& of = statistics[direction];
        received += of["received"].get<std::uint64_t>();
        delivered += of["delivered"].get<std::uint64_t>();
        EXPECT_GT(of["delivered"], 0);
        EXPECT_GT(of["duplicated"], 0);
        EXPECT_GT(of["corrupted"], 0);
        EXPECT_GT(of["reordered"], 0);
        EXPECT_GT(of["dropped"]["mtu"], 0);
        EXPECT_EQ(of["in_flight"], 0);
        print(direction, of);
    }
    EXPECT_EQ(traffic.sent(), received + statistics["overflowed"].get<std::uint64_t>());
    EXPECT_GT(static_cast<double>(traffic.sent()),
              0.99 * 2.0 * static_cast<double>(datagrams_per_second * seconds));
    EXPECT_EQ(statistics["fates_lost"], 0);
    EXPECT_EQ(statistics["capture_lost"], 0);
    EXPECT_EQ(lines_of(folder.file("fates.csv")), received + 1);
    EXPECT_EQ(capture.packets(), received + delivered);
    fmt::print("  {} generations, SCHED_FIFO {}, locked memory {}\n",
               statistics["generation"].dump(), statistics["real_time"]["fifo"].dump(),
               statistics["real_time"]["locked_memory"].dump());
}

} // namespace hapnet::soak
