// SPDX-FileCopyrightText: 2026 The Hapnet authors
// SPDX-License-Identifier: MIT
#include "emulator/core/delay/table.hpp"
#include "emulator/core/delay/trace.hpp"
#include "emulator/core/profile/ramp.hpp"
#include "emulator/core/profile/text.hpp"

#include <chrono>
#include <gtest/gtest.h>
#include <memory>
#include <string>
#include <vector>

namespace hapnet::emulator {
namespace {

using namespace std::chrono_literals;

TEST(ProfileFiles, TablesAndTracesAreReadFromTheFilesTheyName)
{
    const OpenFile open = [](const std::string& name) -> base::Result<std::string> {
        if (name == "pareto.dist") return "0 8192 12000\n";
        if (name == "lte.csv") return "time_s,delay_ms\n0,40\n1,45\n";
        if (name == "wrong.csv") return "40ms\n12\n";
        if (name == "plain.txt") return "40\n12\n";
        return base::fail("there is no file " + name);
    };
    const auto profile = parse_profile("[up]\ndelay = { law = \"trace\", file = \"lte.csv\" }\n"
                                       "jitter = { law = \"table\", file = \"pareto.dist\", "
                                       "sd = \"5ms\" }\n",
                                       "test.toml", open);
    ASSERT_TRUE(profile) << profile.error().message;
    const auto& delay = std::get<TraceLaw>(profile->path.up.delay.law);
    EXPECT_EQ(delay.trace->delays(), (std::vector<base::Duration>{40ms, 45ms}));
    EXPECT_EQ(std::get<TableLaw>(profile->path.up.jitter.law).table->quantile(1.0), 12000.0);
    const auto refused = [&](const std::string& law) {
        const auto result = parse_profile("[up]\njitter = { " + law + " }\n", "test.toml", open);
        return result ? "accepted" : result.error().message;
    };
    EXPECT_EQ(
        refused("law = \"table\", file = \"wrong.csv\""),
        "test.toml:2:10: wrong.csv: line 2: '12' has no unit: write 12ms in each line, or say "
        "columns \"delay=1:ms\"");
    EXPECT_EQ(refused("law = \"table\", file = \"plain.txt\", columns = \"delay=1:ms\""),
              "accepted");
    EXPECT_EQ(refused("law = \"table\", file = \"pareto.dist\""),
              "test.toml:2:10: sd must be more than 0");
    EXPECT_EQ(refused("law = \"trace\", file = \"no.csv\""),
              "test.toml:2:10: there is no file no.csv");
}

TEST(ProfileFiles, ReadsAndPrintsARateByTraceAndItsNamedColumns)
{
    const OpenFile open = [](const std::string& name) -> base::Result<std::string> {
        if (name == "lte.up") return "1\n5\n9\n";
        if (name == "lte.csv") return "stamp,Mbit,gone\n3,10,0\n4,20,0.5\n";
        return base::fail("there is no file " + name);
    };
    const std::string text =
        "\n[up]\nrate = { law = \"trace\", file = \"lte.up\", repeat = false, offset = \"2ms\", "
        "start = \"first\", queue = \"128KiB\" }\n"
        "\n[down]\nrate = { law = \"trace\", file = \"lte.csv\", columns = \"time=stamp:s, "
        "rate=Mbit:Mbps\" }\n"
        "loss = { law = \"timed-trace\", file = \"lte.csv\", columns = \"time=stamp:s, "
        "loss=gone\", interpolate = \"linear\" }\n";
    const auto profile = parse_profile(text, "test.toml", open);
    ASSERT_TRUE(profile) << profile.error().message;
    EXPECT_EQ(to_text(*profile), text);
    const Rate& up = profile->path.up.rate;
    EXPECT_EQ(up.trace->trace->period(), 9ms);
    EXPECT_EQ(up.trace->timing, (TraceTiming{false, 2ms, TraceStart::first}));
    EXPECT_EQ(up.queue_bytes_max, 128U << 10U);
    EXPECT_EQ(profile->path.down.rate.trace->trace->mean_rate(), 15e6);
    const auto refused = [&](const std::string& value) {
        const auto result = parse_setting("up.rate", value, open);
        return result ? "accepted" : result.error().message;
    };
    EXPECT_EQ(refused("{ law = \"trace\", file = \"x\" }"),
              "up.rate: '{ law = \"trace\", file = \"x\" }': there is no file x");
    EXPECT_NE(refused("{ law = \"lte\" }").find("unknown law 'lte': use trace, or limit without"),
              std::string::npos);
    EXPECT_NE(refused("{ law = \"trace\" }").find("missing key 'file'"), std::string::npos);
    EXPECT_NE(refused("{ law = \"trace\", file = \"lte.up\", limit = \"1Mbit/s\" }").find("limit"),
              std::string::npos);
    EXPECT_NE(refused("{ law = \"trace\", file = \"lte.up\", offset = \"-1s\" }").find("offset"),
              std::string::npos);
    Patch to;
    to.rate = Rate{.bits_per_second = 1000};
    EXPECT_EQ(validate_ramp(profile->path.up, to).error().message,
              "cannot ramp rate from or to a trace; use an [[at]] step without ramp");
}

TEST(ProfileFiles, BetweenDelaysAsMeasuredAndATableWithMeanAndSdThereIsNoRamp)
{
    const auto table = std::make_shared<const QuantileTable>(std::vector<double>{1e6, 2e6},
                                                             QuantileTable::Unit::nanoseconds);
    const auto with = [&](base::Duration mean, base::Duration sd) {
        return Variation{TableLaw{"lte.csv", mean, sd, table}, 0ms};
    };
    Conditions from;
    Patch to;
    to.delay = with(50ms, 5ms);
    from.delay = with(0ms, 0ms);
    EXPECT_FALSE(validate_ramp(from, to));
    from.delay = with(20ms, 1ms);
    EXPECT_TRUE(validate_ramp(from, to));
    EXPECT_EQ(ramped(from, from, to, 0.5).delay, with(35ms, 3ms));
}

} // namespace
} // namespace hapnet::emulator
