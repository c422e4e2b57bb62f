// SPDX-FileCopyrightText: 2026 The Hapnet authors
// SPDX-License-Identifier: MIT
#include "emulator/tools/learn/irtt.hpp"

#include "emulator/tools/learn/learn.hpp"

#include <chrono>
#include <gtest/gtest.h>
#include <string>

namespace hapnet::emulator::tools {
namespace {

using namespace std::chrono_literals;

/// The output of irtt 0.9 (irtt-client(1)), with members that are ignored.
const std::string head = R"({
    "version": { "irtt": "0.9.0", "protocol": 1, "json_format": 1 },
    "config": { "params": { "duration": 600000000, "interval": 200000000, "clock": "both" },
                "supplied": { "params": { "interval": 1 } } },
    "stats": { "packets_sent": 3, "upstream_loss_percent": 33.333333333333336 },
    "round_trips": [
)";

std::string answered(int seqno, long send, long receive)
{
    return R"({ "seqno": )" + std::to_string(seqno) + R"(, "lost": "false", "timestamps": {
        "client": { "receive": { "wall": 1528621979787034330, "monotonic": 5644936 },
                    "send": { "wall": 1528621979786534330, "monotonic": 5144936 } },
        "server": { "receive": { "wall": 1528621979786600000, "monotonic": 314 },
                    "send": { "wall": 1528621979786700000, "monotonic": 315 } } },
        "delay": { "receive": )" +
           std::to_string(receive) + R"(, "rtt": )" + std::to_string(send + receive) +
           R"(, "send": )" + std::to_string(send) + R"( }, "ipdv": {} })";
}

std::string lost(const std::string& how)
{
    return R"({ "seqno": 1, "lost": ")" + how +
           R"(", "timestamps": { "client": { "receive": {}, "send": { "wall": 1528621979987000000,
           "monotonic": 205144936 } }, "server": { "receive": {}, "send": {} } }, "delay": {},
           "ipdv": {} })";
}

base::Result<Measurement> read(const std::string& trips) { return read_irtt(head + trips + "]}"); }

TEST(Irtt, TellsBothWaysAndOnWhichOneADatagramWasLost)
{
    const auto found = read(answered(0, 10'000'000, 20'000'000) + "," + lost("true_up") + "," +
                            lost("true_down") + "," + answered(3, 11'000'000, 22'000'000));
    ASSERT_TRUE(found) << found.error().message;
    ASSERT_TRUE(found->up && found->down);
    EXPECT_FALSE(found->mixes_losses);
    EXPECT_EQ(found->up->lost, (std::vector{false, true, false, false}));
    EXPECT_EQ(found->up->delays[3], 11ms);
    EXPECT_FALSE(found->up->delays[2]); // it arrived, at an unknown time
    EXPECT_EQ(found->down->lost, (std::vector{false, true, false})); // one never got a reply
    EXPECT_EQ(found->down->delays[2], 22ms);
    EXPECT_EQ(found->up->spacing, 200ms);
}

TEST(Irtt, CountsAllLossesTogetherWhereOneIsOfAnUnknownWay)
{
    const auto found = read(answered(0, 10, 20) + "," + lost("true_up") + "," + lost("true"));
    ASSERT_TRUE(found && found->down);
    EXPECT_TRUE(found->mixes_losses);
    EXPECT_EQ(found->down->lost, (std::vector{false, true, true}));
    EXPECT_NE(to_text(*learn(*found)).find("does not say on which way"), std::string::npos);
}

TEST(Irtt, MendsTheClocksOfTwoMachines)
{
    // The numbers of a Starlink measurement, whose clocks were 10.5 s apart.
    const auto found = read(answered(0, 10'488'213'200, -10'470'921'269) + "," +
                            answered(1, 10'487'722'034, -10'470'851'192));
    ASSERT_TRUE(found && found->up && found->down);
    EXPECT_NEAR(base::to_seconds(*found->up->delays[1]), 0.008400, 1e-6);
    EXPECT_NEAR(base::to_seconds(*found->down->delays[0]), 0.008400, 1e-6);
    EXPECT_NEAR(base::to_seconds(*found->up->delays[0] + *found->down->delays[0]), 0.017291931,
                1e-8);
}

TEST(Irtt, TellsRoundTripsWhereTheServerDidNotStamp)
{
    const auto found = read(R"({ "seqno": 0, "lost": "false", "delay": { "rtt": 30000000 } },
                               { "seqno": 1, "lost": true })");
    ASSERT_TRUE(found) << found.error().message;
    ASSERT_TRUE(found->round_trip);
    EXPECT_EQ(found->round_trip->delays[0], 30ms);
    EXPECT_TRUE(found->round_trip->lost[1]);
}

TEST(Irtt, NamesWhatItCannotRead)
{
    const auto error = [](const std::string& text) { return read_irtt(text).error().message; };
    EXPECT_EQ(error("{\n\"round_trips\": [\n,"), "line 3: this is not JSON");
    EXPECT_EQ(error("{\"a\": 1e999}"), "line 1: this is not JSON: a number is too large");
    EXPECT_EQ(error("{}"), "line 1: no list \"round_trips\": of JSON, that of irtt can be read");
    EXPECT_EQ(error("{\"round_trips\": []}"), "line 1: round_trips is empty");
    EXPECT_EQ(error("{\"round_trips\": [{\"lost\": \"false\"}]}"),
              "line 1: entry 1 of round_trips: \"delay\" has no \"rtt\" in nanoseconds");
    EXPECT_EQ(error("{\"round_trips\": [{}]}").rfind("line 1: entry 1 of round_trips: \"lost\"", 0),
              0U);
}

TEST(Irtt, IsOneOfSeveralFilesOfTheSamePath)
{
    const auto file = [](const char* name, const std::string& trips) {
        return MeasuredFile{name, head + trips + "]}"};
    };
    const auto monday = file("monday.json", answered(0, 10, 20) + "," + answered(1, 11, 21));
    const auto tuesday = file("tuesday.json", answered(0, 12, 22) + "," + lost("true_down"));
    const std::array week{monday, tuesday};
    const auto found = read_measurements(week);
    ASSERT_TRUE(found && found->down);
    EXPECT_EQ(found->down->lost, (std::vector{false, false, false, true}));
    EXPECT_EQ(found->down->spacing, 200ms);
    const std::array mixed{monday, MeasuredFile{"p.txt", "PING x\nicmp_seq=1 time=1 ms\n"}};
    EXPECT_EQ(read_measurements(mixed).error().message.rfind("p.txt: it was not measured as", 0),
              0U);
    const std::array bad{monday, MeasuredFile{"p.txt", "PING x\nnothing\n"}};
    EXPECT_EQ(read_measurements(bad).error().message,
              "p.txt: line 2: nothing answered: no line has a time, such as time=20.5 ms");
}

} // namespace
} // namespace hapnet::emulator::tools
