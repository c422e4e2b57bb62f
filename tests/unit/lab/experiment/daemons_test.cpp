// SPDX-FileCopyrightText: 2026 The Hapnet authors
// SPDX-License-Identifier: MIT
#include "lab/experiment/daemons.hpp"

#include "lab/experiment/text.hpp"

#include <gtest/gtest.h>
#include <string>

namespace hapnet::lab::experiment {
namespace {

using namespace std::chrono_literals;

Experiment table1(const std::string& setting)
{
    return load_experiment("table1", {}, {.quick = true, .settings = {setting}}).value();
}

TEST(DaemonSessions, AreThoseOfTheExperiment)
{
    const auto sessions = daemon_sessions(table1("tasks=[\"T1\"]"));
    ASSERT_TRUE(sessions);
    // P1 once and two seeds of T1, with each of three algorithms.
    ASSERT_EQ(sessions->size(), 9U);
    EXPECT_EQ(sessions->front().task, device::Task::p1);
    EXPECT_EQ(sessions->front().spec.rows_per_s, 0U);
}

TEST(DaemonSessions, RefuseWhatOnlyVirtualTimePlays)
{
    const auto refusal_of = [](const std::string& setting) {
        const auto sessions = daemon_sessions(table1(setting));
        return sessions ? std::string{} : sessions.error().message;
    };
    EXPECT_EQ(refusal_of("tick=2ms"),
              "the daemons cannot play this: their tick is 1 ms; leave 'tick' out");
    EXPECT_EQ(refusal_of("duration=5500ms"),
              "the daemons cannot play this: 'duration' has to be whole seconds");
    EXPECT_EQ(refusal_of("keyed=true"),
              "the daemons cannot play this: leave 'keyed' out: this plays without keys");
    EXPECT_EQ(refusal_of("clock=\"synchronised\""),
              "the daemons cannot play this: leave 'clock' out: here is one clock");
    EXPECT_NE(refusal_of("device.friction=0.1N").find("leave 'device' out"), std::string::npos);
    const auto limits = load_experiment("fig6a", {}, {}).value();
    EXPECT_NE(daemon_sessions(limits).error().message.find("kind = \"plane\""), std::string::npos);
}

TEST(ProgramFiles, SayHowPeersSendAndPlayMessages)
{
    for (const auto& [setting, words] :
         {std::pair{"send=\"every:6\"", "--send every:6 --playout none\n"},
          std::pair{"send=\"deadband:8%,100ms\"", "--send deadband:8%,100ms --playout none\n"},
          std::pair{"playout=\"adaptive\"", "--send every:1 --playout adaptive\n"}}) {
        const auto sessions = daemon_sessions(table1(setting)).value();
        EXPECT_EQ(program_files(sessions.front().spec.setting)[5].text, words);
    }
}

TEST(ProgramFiles, SayWhatTheSessionIs)
{
    const auto sessions = daemon_sessions(table1("hands=[\"firm\", \"relaxed\"]")).value();
    const auto files = program_files(sessions.front().spec.setting);
    ASSERT_EQ(files.size(), 6U);
    EXPECT_EQ(files[5].text, "--send every:1 --playout none\n");
    EXPECT_EQ(device::parse_operator(files[1].text, "left").value().name, "firm");
    EXPECT_EQ(device::parse_operator(files[2].text, "right").value().name, "relaxed");
    EXPECT_NE(files[4].text.find("160ms"), std::string::npos);
}

} // namespace
} // namespace hapnet::lab::experiment
