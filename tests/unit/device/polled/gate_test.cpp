// SPDX-FileCopyrightText: 2026 The Hapnet authors
// SPDX-License-Identifier: MIT
#include "device/polled/gate.hpp"

#include <gtest/gtest.h>
#include <limits>
#include <tuple>

namespace hapnet::device::polled {
namespace {

using namespace std::chrono_literals;

constexpr base::TimePoint start{1000s};
const Command push{{{1.0, -2.0, 0.5}}, true};

Report good_report()
{
    Report report;
    report.calibrated = true;
    return report;
}

TEST(PolledGate, LetsAFreshForceThroughToADeviceThatAnsweredWell)
{
    Gate gate;
    std::ignore = gate.heard(good_report(), start);
    EXPECT_EQ(gate.pass(push, true, start), push);
    EXPECT_EQ(gate.pass(push, false, start + Gate::fresh_for), push);
}

TEST(PolledGate, GivesZeroBeforeTheFirstAnswer)
{
    Gate gate;
    EXPECT_EQ(gate.pass(push, true, start), Command{});
}

TEST(PolledGate, GivesZeroForAForceThatIsNotGivenAnew)
{
    Gate gate;
    std::ignore = gate.heard(good_report(), start);
    EXPECT_EQ(gate.pass(push, true, start), push);
    EXPECT_EQ(gate.pass(push, false, start + Gate::fresh_for + 1ns), Command{});
    EXPECT_EQ(gate.pass(push, true, start + 1s), push);
}

TEST(PolledGate, GivesZeroAfterAnExchangeWithoutAGoodAnswer)
{
    Report at_fault = good_report();
    at_fault.fault = Fault::communication;
    for (const std::optional<Report>& answer :
         {std::optional<Report>{}, std::optional{Report{}}, std::optional{at_fault}}) {
        Gate gate;
        std::ignore = gate.heard(good_report(), start);
        std::ignore = gate.heard(answer, start);
        EXPECT_EQ(gate.pass(push, true, start), Command{});
        std::ignore = gate.heard(good_report(), start + 1s);
        EXPECT_EQ(gate.pass(push, true, start + 1s), push);
    }
}

TEST(PolledGate, HoldsAFaultForWhoeverReadsLessOften)
{
    Gate gate;
    Report at_fault = good_report();
    at_fault.fault = Fault::over_velocity;
    const auto fault_at = [&](base::TimePoint at) { return gate.heard(good_report(), at)->fault; };
    EXPECT_EQ(fault_at(start), Fault::none);
    EXPECT_EQ(gate.heard(at_fault, start + 1ms)->fault, Fault::over_velocity);
    EXPECT_EQ(fault_at(start + 2ms), Fault::over_velocity);
    EXPECT_EQ(gate.pass(push, true, start + 2ms), Command{});
    EXPECT_FALSE(gate.heard(std::nullopt, start + 3ms));
    EXPECT_EQ(fault_at(start + 1ms + Gate::fault_held_for), Fault::over_velocity);
    EXPECT_EQ(fault_at(start + 1ms + Gate::fault_held_for + 1ns), Fault::none);
    EXPECT_EQ(gate.pass(push, true, start + 30ms), push);
}

TEST(PolledGate, GivesZeroForWhatIsNotFiniteAndForMotorsThatAreOff)
{
    Gate gate;
    std::ignore = gate.heard(good_report(), start);
    for (const double bad :
         {std::numeric_limits<double>::quiet_NaN(), std::numeric_limits<double>::infinity()}) {
        EXPECT_EQ(gate.pass({{{0.0, bad, 0.0}}, true}, true, start), Command{});
    }
    EXPECT_EQ(gate.pass({{{1.0, 0.0, 0.0}}, false}, true, start), Command{});
}

} // namespace
} // namespace hapnet::device::polled
