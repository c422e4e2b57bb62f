// SPDX-FileCopyrightText: 2026 The Hapnet authors
// SPDX-License-Identifier: MIT
// SEP in closed loops: the effect of its force prediction on two hands that feel each other.
#include "lab/virtual_time/play.hpp"

#include <chrono>
#include <gtest/gtest.h>

namespace hapnet::lab {
namespace {

using namespace std::chrono_literals;

struct Means {
    double apart_mm = 0.0; // |x_L - x_R|
    double force_n = 0.0;  // on the left hand
};

Means means_of(device::Task task, base::Duration delay, const peer::Algorithm& algorithm)
{
    virtual_time::Setting setting;
    setting.task = task;
    setting.length = 16s;
    setting.profile.path.up.delay.law = emulator::ConstantLaw{delay};
    setting.profile.path.down = setting.profile.path.up;
    for (virtual_time::PlayerSetting& player : setting.players) player.algorithm = algorithm;
    const virtual_time::Trace trace = play(setting).value();
    const std::size_t count = trace.sides[0].size();
    Means means;
    for (std::size_t i = 0; i < count; ++i) {
        const virtual_time::Sample& left = trace.sides[0][i];
        means.apart_mm += 1e3 * std::abs(left.body.x() - trace.sides[1][i].body.x());
        means.force_n += base::norm(left.on_hand);
    }
    means.apart_mm /= static_cast<double>(count);
    means.force_n /= static_cast<double>(count);
    return means;
}

peer::Algorithm sep(base::Duration force_ahead_max)
{
    return peer::EstimatorPredictor{{.force_ahead_max = force_ahead_max}};
}

TEST(EstimatorPredictor, IsTheBaseAlgorithmWithin3PercentWhereTwoHandsCarryOver160Ms)
{
    const Means base = means_of(device::Task::t3, 160ms, peer::BaseAlgorithm{});
    const Means predicted = means_of(device::Task::t3, 160ms, peer::EstimatorPredictor{});
    EXPECT_NEAR(predicted.apart_mm, base.apart_mm, 0.03 * base.apart_mm);
    EXPECT_NEAR(predicted.force_n, base.force_n, 0.03 * base.force_n);
}

TEST(EstimatorPredictor, ShakesHandsThatPressAgainstEachOtherWhenItLooksFartherThanItsFilterBears)
{
    const double base = means_of(device::Task::t2, 40ms, peer::BaseAlgorithm{}).force_n;
    // Small gain: 1.35 time constants of 10 ms. One delay is below, two are beyond.
    EXPECT_NEAR(means_of(device::Task::t2, 40ms, sep(10ms)).force_n, base, 0.2 * base);
    EXPECT_GT(means_of(device::Task::t2, 40ms, sep(20ms)).force_n, 2.0 * base);
    EXPECT_GT(means_of(device::Task::t2, 40ms, sep(50ms)).force_n, 2.0 * base);
}

} // namespace
} // namespace hapnet::lab
