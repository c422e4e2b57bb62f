// SPDX-FileCopyrightText: 2026 The Hapnet authors
// SPDX-License-Identifier: MIT
#include "device/simulated/script.hpp"

#include "device/simulated/minimum_jerk.hpp"
#include "proto/base/math.hpp"

#include <algorithm>
#include <chrono>
#include <cmath>
#include <gtest/gtest.h>

namespace hapnet::device::task_test {
namespace {

using namespace std::chrono_literals;

constexpr base::TimePoint start{1h};
constexpr base::Duration hands_on = 27s;

Cue cue(bool is_left)
{
    return {start, hands_on, base::Seed{1}, static_cast<std::uint16_t>(is_left ? 1 : 2), is_left};
}
Script left(Task task) { return Script{task, cue(true)}; }
Script right(Task task) { return Script{task, cue(false)}; }

/// The x of the path without its ease-in, as in the task's description.
double formula_x(double t)
{
    const auto swing = [t](double mm, double hertz, double phase) {
        return mm * std::sin(base::two_pi * hertz * t + phase);
    };
    return 1e-3 * (22.0 + std::min(52.7, swing(24.0, 0.484, 3.09) + swing(29.0, 0.501, 3.24) +
                                             swing(46.7, 0.383, 4.43) + swing(23.2, 0.254, 5.32)));
}

struct Statistics {
    double mean = 0.0;
    double deviation = 0.0;
    double most = 0.0;
};

/// Statistics of |x(t) - x(t - 160 ms)| over 0.16 to 30 s, in mm.
template <typename Path>
Statistics discrepancy(const Path& x)
{
    double sum = 0.0;
    double squares = 0.0;
    Statistics result;
    constexpr int first = 160;
    constexpr int end = 30'000;
    for (int ms = first; ms < end; ++ms) {
        const double e = 1e3 * std::abs(x(1e-3 * ms) - x(1e-3 * (ms - first)));
        sum += e;
        squares += e * e;
        result.most = std::max(result.most, e);
    }
    result.mean = sum / (end - first);
    result.deviation = std::sqrt(squares / (end - first) - result.mean * result.mean);
    return result;
}

TEST(Path, IsTheFormulaOnceItsFirstSecondHasPassed)
{
    for (int ms = 1000; ms <= 30'000; ++ms) {
        EXPECT_NEAR(path_x(1e-3 * ms), formula_x(1e-3 * ms), 1e-12) << ms;
    }
}

TEST(Path, SwingsInFromTheStartOfTheCubeWithinASecond)
{
    EXPECT_EQ(path_x(-5.0), 0.0);
    EXPECT_EQ(path_x(0.0), 0.0);
    EXPECT_NEAR(path_x(0.5), 0.5 * formula_x(0.5), 1e-12); // halfway in time, halfway in share
    EXPECT_LT(std::abs(path_x(0.001)), 1e-9);              // without a jump of speed
}

TEST(Path, GivesTheFirstColumnOfTable1WithADelayOf160MsAlone)
{
    const Statistics s = discrepancy(formula_x);
    EXPECT_NEAR(s.mean, 13.61, 0.005 * 13.61);
    EXPECT_NEAR(s.deviation, 10.68, 0.005 * 10.68);
    EXPECT_NEAR(s.most, 47.25, 0.005 * 47.25);
}

TEST(Path, LosesOnePercentOfThatToItsFirstSecond)
{
    const Statistics s = discrepancy(path_x);
    EXPECT_NEAR(s.mean, 13.458, 0.001);
    EXPECT_NEAR(s.deviation, 10.534, 0.001);
    EXPECT_NEAR(s.most, 47.269, 0.001);
}

TEST(Path, FitsTheOmnisWidthAndEndsAtTheStaticCube)
{
    double least = 0.0;
    double most = 0.0;
    for (int ms = 0; ms <= 30'000; ++ms) {
        least = std::min(least, path_x(1e-3 * ms));
        most = std::max(most, path_x(1e-3 * ms));
    }
    EXPECT_NEAR(least, -0.0746, 0.0001);
    EXPECT_NEAR(most, 0.0747, 1e-12);
}

TEST(Path, IsDefinedForTheLongestSessionThatCanBeAskedFor)
{
    for (const double seconds : {3e5, 4e5, 1e6}) {
        EXPECT_LE(std::abs(path_x(seconds)), 0.16) << seconds;
    }
}

TEST(MinimumJerk, GoesFromZeroToOneAndIsSymmetric)
{
    EXPECT_EQ(minimum_jerk(-1.0), 0.0);
    EXPECT_EQ(minimum_jerk(0.0), 0.0);
    EXPECT_EQ(minimum_jerk(0.5), 0.5);
    EXPECT_EQ(minimum_jerk(1.0), 1.0);
    EXPECT_EQ(minimum_jerk(7.0), 1.0);
    EXPECT_NEAR(minimum_jerk(0.25) + minimum_jerk(0.75), 1.0, 1e-15);
    EXPECT_NEAR(minimum_jerk(0.25), 0.103515625, 1e-15); // 10/64 - 15/256 + 6/1024
}

TEST(Tasks, HaveNames)
{
    for (const Task task : all_tasks) {
        EXPECT_EQ(task_named(name_of(task)), task);
    }
    const auto unknown = task_named("P2");
    ASSERT_FALSE(unknown);
    EXPECT_EQ(unknown.error().message,
              "unknown task 'P2': use P1, T1, T2, T3, T4, T5, T6, T7, T8, T9, T10");
}

TEST(TaskP1, LetsTheLeftHandAloneHoldTheCubeWhileTheHandsAreOn)
{
    for (const auto& [time, grips] :
         {std::pair{-1ms, false}, {0ms, true}, {26'999ms, true}, {27'000ms, false}}) {
        EXPECT_EQ(left(Task::p1).at(start + time).gripping, grips) << time.count();
        EXPECT_FALSE(right(Task::p1).at(start + time).gripping) << time.count();
    }
}

TEST(TaskP1, AimsTheLeftHandAtTheFaceOfACubeOnThePathAndNotIntoTheStaticCube)
{
    for (int ms = 0; ms < 27'000; ms += 100) {
        const auto target = left(Task::p1).at(start + ms * 1ms).target;
        EXPECT_NEAR(target.x(), path_x(1e-3 * ms) - 0.025, 1e-12) << ms;
        EXPECT_LE(target.x() + 0.025, 0.0747 + 1e-12) << ms;
        EXPECT_EQ(target.y(), 0.0);
        EXPECT_EQ(target.z(), 0.0);
        // Above the cube, wherever a prediction may move it.
        EXPECT_EQ(right(Task::p1).at(start + ms * 1ms).target.y(), 0.045);
    }
}

TEST(TaskT1, LetsTheHandPushThatIsBehindTheMotionAndKeepsTheOtherOff)
{
    int rising = 0;
    int falling = 0;
    for (int ms = 1000; ms < 27'000; ms += 10) {
        const double t = 1e-3 * ms;
        const double speed = (path_x(t + 0.005) - path_x(t - 0.005)) / 0.01;
        const double l = left(Task::t1).at(start + ms * 1ms).target.x() - path_x(t);
        const double r = right(Task::t1).at(start + ms * 1ms).target.x() - path_x(t);
        if (speed > 0.021) {
            EXPECT_NEAR(l, -0.025, 1e-12) << ms;
            EXPECT_NEAR(r, 0.033, 1e-12) << ms;
            ++rising;
        } else if (speed < -0.021) {
            EXPECT_NEAR(l, -0.033, 1e-12) << ms;
            EXPECT_NEAR(r, 0.025, 1e-12) << ms;
            ++falling;
        }
    }
    EXPECT_GT(rising, 500);
    EXPECT_GT(falling, 500);
}

TEST(TaskT3, LetsBothSqueezeAtHalfSpeedWithTheRightOne60MsBehind)
{
    for (int ms = 100; ms < 27'000; ms += 100) {
        const double t = 1e-3 * ms;
        EXPECT_NEAR(left(Task::t3).at(start + ms * 1ms).target.x(), path_x(0.5 * t) - 0.021, 1e-12);
        EXPECT_NEAR(right(Task::t3).at(start + ms * 1ms).target.x(),
                    path_x(0.5 * (t - 0.060)) + 0.021, 1e-12);
    }
}

TEST(TaskT7, SharesTheSqueezeOfASideAmongTheHandsOnIt)
{
    const double t = 5.0;
    for (const double share : {1.0, 0.5, 0.25}) {
        Cue of_one = cue(true);
        of_one.share = share;
        const Script hand{Task::t7, of_one};
        // 4 mm of a nominal hand's aim press with the full force.
        EXPECT_NEAR(hand.at(start + base::from_seconds(t)).target.x(),
                    path_x(0.5 * t) - 0.025 + share * 0.004, 1e-12);
    }
}

TEST(EveryTask, TakesTheHands20MmOffWithinHalfASecondAtItsEndAndLeavesThemThere)
{
    for (const Task task : all_tasks) {
        for (const bool is_left : {true, false}) {
            const Script script{task, cue(is_left)};
            const double side = -script.pressing_toward();
            const double from = script.at(start + hands_on).target.x();
            const auto moved = [&](base::Duration after) {
                return side * (script.at(start + hands_on + after).target.x() - from);
            };
            EXPECT_NEAR(moved(250ms), 0.010, 1e-12);
            EXPECT_NEAR(moved(500ms), 0.020, 1e-12);
            EXPECT_NEAR(moved(3s), 0.020, 1e-12);
            EXPECT_FALSE(script.at(start + hands_on + 1s).gripping);
        }
    }
}

} // namespace
} // namespace hapnet::device::task_test
