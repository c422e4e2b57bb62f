// SPDX-FileCopyrightText: 2026 The Hapnet authors
// SPDX-License-Identifier: MIT
#include "peer/monitor/report.hpp"

#include <gtest/gtest.h>
#include <string>

namespace hapnet::peer::monitor {
namespace {

using namespace std::chrono_literals;

struct Shown : testing::Test {
    [[nodiscard]] nlohmann::ordered_json show() const
    {
        return show_json({options, status, "a device"}, {});
    }
    [[nodiscard]] std::string says() const { return show()["says"]; }

    Options options;
    loop::ServoStatus status;
};

TEST_F(Shown, SaysThatItWaitsForTheOther)
{
    EXPECT_EQ(show()["state"], "waiting");
    EXPECT_NE(says().find("waiting for the other peer"), std::string::npos);
    EXPECT_EQ(show()["session"], nullptr);
    EXPECT_EQ(show()["device"], "a device");
}

TEST_F(Shown, SaysWhyTheRunIsNotValid)
{
    const auto verdict = [&] {
        const std::string text = summary({options, status, "a device"});
        const auto start = text.find("NOT VALID as a measurement: ");
        return start == std::string::npos ? "valid"
                                          : text.substr(start + 28, text.find('\n') - start - 28);
    };
    EXPECT_EQ(verdict(), "no tick began");
    for (int i = 0; i < 1000; ++i) status.loop.late.add(100us);
    status.loop.ticks = 991;
    EXPECT_EQ(verdict(), "valid");
    options.events = "events.jsonl";
    EXPECT_EQ(why_not_valid({.options = options,
                             .status = status,
                             .device = "a device",
                             .are_events_whole = false}),
              "events are missing");
    status.loop.missed = 9;
    EXPECT_EQ(verdict(), "0.9 % of the ticks were missed, more than 0.5 %");
    status.loop.missed = 0;
    for (int i = 0; i < 100; ++i) status.loop.late.add(2ms);
    EXPECT_EQ(verdict().rfind("p99 lateness 2", 0), 0U) << verdict();
    EXPECT_NE(verdict().find(" us, more than 1000 us"), std::string::npos) << verdict();
}

TEST_F(Shown, SaysWhoKeepsTheForceBackAndThatNothingCanBeSent)
{
    EXPECT_EQ(show()["force_withheld"], false);
    status.loop.last_send = net::SendOutcome::no_route;
    EXPECT_NE(says().find("nothing can be sent to the other peer: there is no route"),
              std::string::npos);
    status.withheld = loop::Withheld::by_dead_man;
    EXPECT_EQ(show()["force_withheld"], true);
    EXPECT_EQ(show()["state"], "waiting");
    EXPECT_NE(says().find("the dead man's switch is not held: zero force"), std::string::npos);
    status.fault = {device::Fault::disconnected, device::Trip::device};
    EXPECT_EQ(show()["state"], "fault");
    status.withheld = loop::Withheld::by_emergency_stop;
    EXPECT_EQ(show()["state"], "emergency_stop");
    EXPECT_NE(says().find("only a new start of the program"), std::string::npos);
}

TEST_F(Shown, SaysWhereInTheSessionItIs)
{
    status.session = Session{.number = 7, .start = base::TimePoint{10s}, .is_left = true};
    status.at = base::TimePoint{12s};
    status.phase = record::Phase::running;
    status.is_remote_heard = true;
    EXPECT_EQ(show()["state"], "running");
    EXPECT_EQ(show()["session"]["at_s"], 2.0);
    EXPECT_EQ(says(), "in session");
    status.is_remote_heard = false;
    EXPECT_EQ(says(), "in session, but the other peer is silent: zero force");
}

TEST_F(Shown, SaysWhatTheCalibrationNeedsBeforeAnythingOfTheSession)
{
    status.calibration = device::CalibrationStep::dock_stylus;
    EXPECT_EQ(show()["state"], "calibrating");
    EXPECT_EQ(says(), device::describe(device::CalibrationStep::dock_stylus));
}

TEST_F(Shown, SaysAFaultAndItsCureBeforeAllElse)
{
    status.calibration = device::CalibrationStep::failed;
    status.fault = {device::Fault::disconnected, device::Trip::device};
    EXPECT_EQ(show()["state"], "fault");
    EXPECT_EQ(show()["fault"]["fault"], "disconnected");
    EXPECT_EQ(show()["fault"]["tripped_by"], "device");
    EXPECT_NE(says().find("zero force (disconnected): the device has gone: plug it in"),
              std::string::npos)
        << says();
}

TEST_F(Shown, HasTheClockOfEachOtherAndThePathsToItAndBack)
{
    const auto others = [&] { return statistics_json({options, status, "a device"})["others"]; };
    EXPECT_TRUE(others().empty());
    status.others_count = 2;
    EXPECT_EQ(others()[0]["clock"], nullptr);
    EXPECT_EQ(others()[0]["in"]["loss"], nullptr);
    EXPECT_EQ(others()[0]["out"]["age_ms"], nullptr);
    loop::OtherStatus& other = status.others[1];
    other.id = 3;
    other.clock = ClockEstimate{.offset = -2s, .uncertainty = 40ms, .skew_ppm = 12.5};
    other.is_clock_in_doubt = true;
    other.clock_jumps = 1;
    other.paths.arrived.sent = 4;
    other.paths.arrived.received = 3;
    other.paths.loss = 0.25;
    other.paths.in.delay = base::Quantiles{.p50 = 1ms, .p99 = 2ms, .max = 3ms};
    other.paths.out.age = base::Age{.mean = 4ms, .peak_mean = {}, .peak_max = 5ms};
    const auto shown = others()[1];
    EXPECT_EQ(shown["id"], 3);
    EXPECT_EQ(shown["clock"]["offset_ms"], -2000.0);
    EXPECT_EQ(shown["clock"]["uncertainty_ms"], 40.0);
    EXPECT_EQ(shown["clock"]["skew_ppm"], 12.5);
    EXPECT_EQ(shown["clock"]["in_doubt"], true);
    EXPECT_EQ(shown["clock"]["jumps"], 1);
    EXPECT_EQ(shown["in"]["loss"], 0.25);
    EXPECT_EQ(shown["in"]["delay_ms"]["p99"], 2.0);
    EXPECT_EQ(shown["in"]["jitter_ms"], nullptr);
    EXPECT_EQ(shown["out"]["age_ms"]["peak_max"], 5.0);
}

TEST_F(Shown, HasTheSessionAndTheKeyWithEachOfACircle)
{
    status.session = Session{.number = 0, .start = base::TimePoint{10s}};
    status.others_count = 2;
    for (const std::size_t i : {0U, 1U}) {
        loop::OtherStatus& other = status.others.at(i);
        other.id = static_cast<std::uint16_t>(i + 2);
        other.session = static_cast<std::uint32_t>(i + 70);
        other.is_heard = i == 1;
        other.line.strangers = 1 - i;
        other.line.key = decltype(other.line.key)::value_type{};
        other.line.key->is_agreed = i == 0;
        other.line.key->counts.handshakes = 1;
        other.line.key->counts.last_handshake = (i + 1) * 1ms;
    }
    const auto statistics = statistics_json({options, status, "a device"});
    EXPECT_EQ(statistics["session"]["number"], nullptr);
    EXPECT_EQ(statistics["others"][1]["session"], 71);
    EXPECT_EQ(statistics["others"][0]["heard"], false);
    EXPECT_EQ(statistics["others"][0]["secure"]["agreed"], true);
    EXPECT_EQ(statistics["secure"]["agreed"], false);
    EXPECT_EQ(statistics["secure"]["handshakes"], 2);
    EXPECT_EQ(statistics["secure"]["handshake_ms"], 2.0);
    EXPECT_EQ(statistics["messages"]["strangers"], 1);
    EXPECT_EQ(show()["others"][1]["id"], 3);
    EXPECT_EQ(show()["others"][1]["heard"], true);
}

} // namespace
} // namespace hapnet::peer::monitor
