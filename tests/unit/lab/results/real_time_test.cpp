// SPDX-FileCopyrightText: 2026 The Hapnet authors
// SPDX-License-Identifier: MIT
#include "lab/results/real_time.hpp"

#include "emulator/core/profile/text.hpp"
#include "lab/results/table_text.hpp"
#include "lab/virtual_time/play.hpp"
#include "peer/core/sync/text.hpp"

#include <array>
#include <chrono>
#include <gtest/gtest.h>

namespace hapnet::lab::results {
namespace {

using namespace std::chrono_literals;
using Json = nlohmann::ordered_json;

/// The relevant part of the programs' output: 8 s of P1 with dead reckoning.
RealTimeSession as_written()
{
    const auto algorithm = peer::load_algorithm("dead-reckoning", {}).value();
    const auto person = device::operator_named("firm").value();
    return {
        .where = "loopback",
        .files = {
            .analysis = {{"discrepancy_x_mm",
                          {{"mean", 9.5}, {"min", 0.0}, {"max", 40.0}, {"std", 8.0}}},
                         {"valid", true},
                         {"invalid_because", Json::array()}},
            .emulator = {{"seed", 5}, {"profile", "[both]\ndelay = \"20ms\"\n"}, {"valid", true}},
            .peer = {{"task", "P1"},
                     {"scene", "paper"},
                     {"algorithm", "dead-reckoning"},
                     {"algorithm_toml", peer::print_algorithm(algorithm)},
                     {"operator_toml", device::print_operator(person)},
                     {"grip_damping_ns_per_m", 4.0},
                     {"duration_s", 8.0},
                     {"session", {{"seed", 7}}}}}};
}

RealTimeResult measured()
{
    return {.algorithm = "base",
            .where = "loopback",
            .real_mm = metrics::Spread{.mean = 13.5, .min = 0.0, .max = 44.0, .std = 10.5},
            .virtual_mm = metrics::Spread{.mean = 13.6, .min = 0.0, .max = 47.0, .std = 10.7},
            .invalid_because{}};
}

TEST(TwinOf, IsTheSessionThatTheProgramsDescribe)
{
    const auto twin = twin_of(as_written(), {});
    ASSERT_TRUE(twin) << twin.error().message;
    EXPECT_EQ(twin->task, device::Task::p1);
    EXPECT_EQ(twin->length, 8s);
    EXPECT_EQ(twin->seed.value(), 5U);
    ASSERT_TRUE(twin->players[0].seed);
    EXPECT_EQ(twin->players[0].seed->value(), 7U);
    EXPECT_EQ(twin->players[1].person.name, "firm");
    EXPECT_EQ(peer::name_of(twin->players[1].algorithm), "dead-reckoning");
    EXPECT_NE(emulator::to_text(twin->profile).find("20ms"), std::string::npos);
}

TEST(TwinOf, NamesWhatAProgramDidNotSay)
{
    RealTimeSession session = as_written();
    session.files.peer.erase("algorithm_toml");
    EXPECT_EQ(twin_of(session, {}).error().message, "hapnet-peer does not say /algorithm_toml");
    session = as_written();
    session.files.emulator["profile"] = nullptr; // a device that replays has no hand, for instance
    EXPECT_EQ(twin_of(session, {}).error().message, "hapnet-emulator does not say /profile");
    session = as_written();
    session.files.peer["grip_damping_ns_per_m"] = 2.0;
    EXPECT_EQ(twin_of(session, {}).error().message,
              "virtual time supports only the default grip damping");
}

TEST(TwinOf, HasEachPlayersOwnHandAndTicks)
{
    RealTimeSession session = as_written();
    Json other = session.files.peer;
    other["operator_toml"] = device::print_operator(device::operator_named("relaxed").value());
    session.files.others = {other};
    session.ticks = {{0ms, 1ms}, {500us, 2500us}};
    const auto twin = twin_of(session, {});
    ASSERT_TRUE(twin) << twin.error().message;
    EXPECT_EQ(twin->players[0].person.name, "firm");
    EXPECT_EQ(twin->players[1].person.name, "relaxed");
    ASSERT_TRUE(twin->players[1].ticks);
    EXPECT_EQ(*twin->players[1].ticks, session.ticks[1]);
}

TEST(KeptTime, CountsTheTicksBetweenTwo)
{
    const std::vector<base::Duration> ticks{0ms, 1100us, 2ms, 6ms, 7ms};
    EXPECT_EQ(kept_time(ticks).missed, 3U);
    EXPECT_EQ(kept_time(ticks).longest_gap, 4ms);
}

TEST(RealTime, InWhichALoopStoodStillIsNotValid)
{
    RealTimeSession session = as_written();
    session.ticks = {{0ms, 1ms}, {0ms, 20ms}};
    EXPECT_TRUE(result_of(session, virtual_time::Trace{}).valid());
    session.ticks[1][1] = 24ms;
    EXPECT_EQ(result_of(session, virtual_time::Trace{}).invalid_because,
              std::vector<std::string>{"peer 2: the loop stood still for 24.0 ms; after 20 ms the "
                                       "governor takes the force away"});
}

TEST(RealTime, IsComparedWithTheTwinAsItPlays)
{
    const RealTimeSession session = as_written();
    const auto trace = play(twin_of(session, {}).value());
    ASSERT_TRUE(trace);
    const RealTimeResult result = result_of(session, *trace);
    EXPECT_EQ(result.algorithm, "dead-reckoning");
    ASSERT_TRUE(result.real_mm && result.virtual_mm);
    EXPECT_EQ(result.real_mm->mean, 9.5);
    EXPECT_EQ(result.real_mm->std, 8.0);
    // Predicted over 20 ms with at most a few m/s^2: a fraction of a millimetre.
    EXPECT_GT(result.virtual_mm->mean, 0.001);
    EXPECT_LT(result.virtual_mm->mean, 1.0);
    EXPECT_TRUE(result.valid());
}

TEST(RealTime, DiffersByTheFartherOfMeanAndStd)
{
    RealTimeResult result = measured();
    EXPECT_DOUBLE_EQ(*result.difference_percent(), 100.0 * (10.5 - 10.7) / 10.7);
    result.real_mm->mean = 15.0;
    EXPECT_DOUBLE_EQ(*result.difference_percent(), 100.0 * (15.0 - 13.6) / 13.6);
    EXPECT_NE(real_time_table(std::array{result}).find("10.29 % off at most: DIFFERS"),
              std::string::npos);
    EXPECT_NE(real_time_table(std::array{measured()}).find("agrees"), std::string::npos);
    result.virtual_mm.reset();
    EXPECT_FALSE(result.difference_percent());
}

TEST(RealTime, ThatIsNotValidSaysWhyAndIsExcluded)
{
    RealTimeSession session = as_written();
    session.files.analysis["invalid_because"] = {"a: 0.70 % of the ticks missed, more than 0.5 %"};
    session.files.emulator["valid"] = false;
    const RealTimeResult result = result_of(session, virtual_time::Trace{});
    EXPECT_FALSE(result.valid());
    EXPECT_FALSE(result.difference_percent());
    const std::array results{measured(), result};
    EXPECT_EQ(csv_text(real_time_rows(results)),
              "algorithm,where,mean_mm,std_mm,max_mm,virtual_mean_mm,virtual_std_mm,"
              "virtual_max_mm,difference_percent,valid,invalid_because\n"
              "base,loopback,13.5000,10.5000,44.0000,13.6000,10.7000,47.0000,-1.87,true,\n"
              "dead-reckoning,loopback,9.5000,8.0000,40.0000,,,,,false,"
              "\"a: 0.70 % of the ticks missed, more than 0.5 %; "
              "the emulator was later than its budget\"\n");
    EXPECT_NE(real_time_table(results).find("NOT VALID, excluded"), std::string::npos);
    EXPECT_EQ(real_time_manifest(results, {}).at("valid"), false);
    EXPECT_EQ(real_time_manifest(std::array{measured()}, {}).at("valid"), true);
}

TEST(RealTime, WithoutASessionTogetherIsNotValid)
{
    RealTimeSession session = as_written();
    session.files.analysis["discrepancy_x_mm"] = nullptr;
    const RealTimeResult result = result_of(session, virtual_time::Trace{});
    EXPECT_EQ(result.invalid_because,
              std::vector<std::string>{"the two were never in session together"});
}

} // namespace
} // namespace hapnet::lab::results
