// SPDX-FileCopyrightText: 2026 The Hapnet authors
// SPDX-License-Identifier: MIT
//
// Compares two regimes at 1000 datagrams a second on real sockets with the same regimes in virtual
// time. HAPNET_SOAK_ROW_SECONDS (default 20) is a third of what it takes.
#include "emulator/core/profile/text.hpp"
#include "emulator/tools/learn/likeness.hpp"
#include "proto/base/figures/quantiles.hpp"
#include "tests/e2e/emulator.hpp"
#include "tests/e2e/process.hpp"
#include "tests/e2e/udp.hpp"
#include "tests/soak/traffic.hpp"

#include <algorithm>
#include <chrono>
#include <cstdio>
#include <fstream>
#include <gtest/gtest.h>
#include <nlohmann/json.hpp>
#include <optional>
#include <spdlog/fmt/fmt.h>
#include <string>
#include <thread>
#include <vector>

namespace hapnet::soak {

namespace {

using namespace std::chrono_literals;
using emulator::tools::MeasuredWay;

constexpr const char* profile = R"(seed = 42
[[down.regime]]
name = "good"
stay = "900ms"
delay = "20ms"
jitter = { law = "normal", sd = "1ms" }
[[down.regime]]
name = "bad"
stay = "300ms"
delay = "60ms"
jitter = { law = "gamma", mean = "20ms", sd = "8ms" }
loss = "10%"
)";

/// The delays that arrive at A from B through an emulator; nullopt: the machine has stopped it for
/// longer than 10 ms, so they say nothing.
std::optional<MeasuredWay> live(const std::string& file, std::size_t packets)
{
    e2e::Host a;
    e2e::Host b;
    e2e::Emulator emulator{
        {"--profile", file, "--a", a.endpoint().to_text(), "--b", b.endpoint().to_text()}};
    std::vector<std::optional<base::Duration>> delays(packets);
    std::thread sender{[&] { e2e::stream(b, emulator.b(), packets, 1ms); }};
    for (const e2e::Arrival& one : a.receive(packets, 500ms)) delays.at(one.number) = one.delay;
    sender.join();
    const auto down = emulator.stop().at("down");
    if (down.at("lateness_us").at("max").get<double>() > 10'000.0) return std::nullopt;
    MeasuredWay way{.spacing = 1ms};
    for (const auto& delay : delays) way.add(delay, !delay);
    return way;
}

base::Quantiles quantiles_of(const MeasuredWay& way)
{
    base::DurationSample sample;
    for (const auto& delay : way.delays) {
        if (delay) sample.add(*delay);
    }
    return sample.quantiles().value();
}

double in_ms(base::Duration delay) { return base::to_nanoseconds(delay) / 1e6; }

double lost_share(const MeasuredWay& way)
{
    return static_cast<double>(std::ranges::count(way.lost, true)) /
           static_cast<double>(way.lost.size());
}

/// Prints a figure of both, and expects that they differ by no more than this.
void expect_near(const char* name, double is, double expected, double most)
{
    fmt::print("  regimes, {:28} live {:8.3f}, in virtual time {:8.3f}\n", name, is, expected);
    EXPECT_NEAR(is, expected, most) << name;
}

} // namespace

/// Equal seeds give equal stays and draws. Differences come from the moment at which the sender
/// begins, some 0.1 s after the emulator, and from the time that real datagrams take, about 0.1 ms.
TEST(Regimes, DoLiveWhatTheyDoInVirtualTime)
{
    const auto packets = static_cast<std::size_t>(3000 * setting("HAPNET_SOAK_ROW_SECONDS", 20));
    const e2e::TemporaryFolder folder;
    const auto file = folder.file("regimes.toml");
    std::ofstream{file} << profile;
    std::optional<MeasuredWay> is;
    for (int attempt = 0; attempt < 3 && !is; ++attempt) is = live(file, packets);
    ASSERT_TRUE(is) << "the machine stopped it three times";
    const auto conditions = emulator::parse_profile(profile, file, {}).value().path.down;
    const auto expected =
        emulator::tools::played(conditions, packets, 1ms, base::Duration{1us}, base::Seed{42});
    const auto live_delays = quantiles_of(*is);
    const auto virtual_delays = quantiles_of(expected);
    expect_near("delay p50, ms", in_ms(live_delays.p50), in_ms(virtual_delays.p50), 1.0);
    expect_near("delay p90, ms", in_ms(live_delays.p90), in_ms(virtual_delays.p90), 1.0);
    expect_near("delay p99, ms", in_ms(live_delays.p99), in_ms(virtual_delays.p99), 1.0);
    expect_near("loss, percent", 100.0 * lost_share(*is), 100.0 * lost_share(expected), 0.5);
    for (const base::Duration lag : {base::Duration{100ms}, base::Duration{1s}, {5s}}) {
        expect_near(fmt::format("correlation, {:g} s apart", base::to_seconds(lag)).c_str(),
                    emulator::tools::autocorrelation(*is, lag).value(),
                    emulator::tools::autocorrelation(expected, lag).value(), 0.05);
    }
    std::fflush(stdout);
}

} // namespace hapnet::soak
