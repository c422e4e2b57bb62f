// SPDX-FileCopyrightText: 2026 The Hapnet authors
// SPDX-License-Identifier: MIT
#include "device/governor.hpp"

#include "proto/base/random.hpp"

#include <algorithm>
#include <array>
#include <bit>
#include <chrono>
#include <cmath>
#include <glm/geometric.hpp>
#include <gtest/gtest.h>
#include <limits>

namespace hapnet::device {
namespace {

using namespace std::chrono_literals;

constexpr std::uint64_t rounds = 200'000;

/// Forces of every kind: usual, absurd, and any bits.
base::Force wish(const base::RandomStream& stream, std::uint64_t round)
{
    base::Force force;
    for (const int axis : {0, 1, 2}) {
        const auto draw = static_cast<std::uint32_t>(axis);
        const double usual = 10.0 * stream.uniform(round, draw) - 5.0;
        const std::uint64_t kind = stream.below(20, round / 100, 10);
        force.value[axis] = kind == 0   ? std::bit_cast<double>(stream.bits(round, draw))
                            : kind == 1 ? 1e300 * usual
                                        : usual;
    }
    return force;
}

TEST(Governor, NeverGivesAHandMoreThanItsLimitsWhateverItIsAskedFor)
{
    const auto stream = base::Seed{1}.stream("governor");
    const GovernorLimits limits;
    Governor governor{limits};
    base::TimePoint now{1h};
    base::Force before;
    Sample sample;
    std::uint64_t felt = 0;
    for (std::uint64_t round = 0; round < rounds; ++round) {
        const bool stalls = stream.below(2000, round, 13) == 0;
        const base::Duration elapsed{stream.below(stalls ? 100'000'000 : 2'000'000, round, 11)};
        const bool permitted = stream.below(50, round / 200, 12) != 0;
        now += elapsed;
        ++sample.sequence;
        const base::Force force =
            governor.govern({wish(stream, round), permitted}, sample, now).force();
        ASSERT_TRUE(base::is_finite(force)) << round;
        ASSERT_LE(base::norm(force), limits.force_max_n * (1.0 + 1e-12)) << round;
        const double step_max =
            limits.slew_max_n_per_s * base::to_seconds(std::min(elapsed, limits.tick));
        if (!(force == base::Force{})) {
            ASSERT_LE(base::norm(force - before), step_max + 1e-9) << round;
            ++felt;
        }
        before = force;
    }
    EXPECT_GT(felt, rounds / 2);
}

/// The reports of a device: good for a while, then anything.
class AnyDevice {
public:
    explicit AnyDevice(base::RandomStream stream) : stream_{stream} {}

    Sample sample(std::uint64_t round)
    {
        const std::uint64_t era = round / 500; // an operator needs a second at rest
        const bool is_well = stream_.below(3, era, 20) != 0;
        Sample sample = is_well ? Sample{} : anything(round);
        if (is_well || stream_.below(4, round / 125, 21) != 0) ++sequence_;
        sample.sequence = sequence_;
        sample.presses = static_cast<std::uint16_t>(round / 1700);
        // A person who holds the device at rest for a second, then presses for 0.3 s and more.
        if (is_well) sample.buttons = round % 1700 >= 1300 ? 1 : 0;
        return sample;
    }

private:
    [[nodiscard]] Sample anything(std::uint64_t round) const
    {
        Sample sample;
        const auto one_in = [&](std::uint32_t n, std::uint32_t draw) {
            return stream_.below(n, round / 30, draw) == 0;
        };
        for (const int axis : {0, 1, 2}) {
            const auto draw = static_cast<std::uint32_t>(30 + axis);
            sample.hip.value[axis] = 0.1 * stream_.uniform(round / 200, draw) - 0.05;
            sample.velocity.value[axis] = 1.6 * stream_.uniform(round / 60, draw + 10) - 0.8;
            if (one_in(200, draw + 20)) sample.hip.value[axis] = 1e300;
            if (one_in(50, draw + 50)) {
                sample.hip.value[axis] = std::numeric_limits<double>::quiet_NaN();
            }
        }
        sample.docked = stream_.below(10, round / 120, 61) == 0; // long enough to count
        sample.calibrated = !one_in(20, 62);
        if (one_in(40, 63)) sample.fault = static_cast<Fault>(stream_.below(14, round, 64));
        sample.buttons = one_in(2, 65) ? 1 : 0;
        return sample;
    }

    base::RandomStream stream_;
    std::uint64_t sequence_ = 1;
};

glm::dmat3 skew_arm(const base::Position& position)
{
    const glm::dvec3& p = position.value;
    return {glm::dvec3{0.13, p.x, 0.0}, glm::dvec3{0.0, 0.1, p.y}, glm::dvec3{p.z, 0.0, 0.2}};
}

GovernorLimits strict_limits()
{
    Capabilities can{.force_max_n = 3.3, .force_continuous_n = 0.88};
    can.workspace_min = {glm::dvec3{-0.04}};
    can.workspace_max = {glm::dvec3{0.04}};
    can.speed_max_m_per_s = 1.0;
    can.axes_out = 2;
    can.joints = JointLimits{{"test", skew_arm}, glm::dvec3{0.2, 0.2, 0.2}};
    return limits_for(can, {});
}

bool has_to_be_zero(const Sample& sample, base::Duration repeated_for)
{
    return sample.fault != Fault::none || !sample.calibrated || sample.docked ||
           !base::is_finite(sample.hip) || !base::is_finite(sample.velocity) ||
           base::norm(sample.velocity) > 1.0 || repeated_for >= std::chrono::milliseconds{20};
}

void expect_within(const GovernorLimits& limits, const Sample& sample, const base::Force& force)
{
    ASSERT_TRUE(base::is_finite(force));
    ASSERT_LE(base::norm(force), limits.force_max_n * (1.0 + 1e-12));
    ASSERT_EQ(force.z(), 0.0);
    for (const int axis : {0, 1, 2}) {
        const double along = force.value[axis];
        const double place = sample.hip.value[axis];
        ASSERT_TRUE(place < 0.04 + 0.005 || along <= 0.0) << place;
        ASSERT_TRUE(place > -0.04 - 0.005 || along >= 0.0) << place;
        const glm::dvec3 joint = skew_arm(sample.hip)[axis];
        const double torque = joint.x * force.x() + joint.y * force.y() + joint.z * force.z();
        ASSERT_TRUE(force == base::Force{} || std::abs(torque) <= 0.2 * (1.0 + 1e-12)) << torque;
    }
}

TEST(Governor, KeepsEveryRuleWhateverTheDeviceSaysAndTheSceneWants)
{
    const auto stream = base::Seed{7}.stream("governed device");
    const GovernorLimits limits = strict_limits();
    Governor governor{limits};
    AnyDevice device{stream};
    base::TimePoint now{1h};
    base::Force before;
    std::uint64_t sequence = 0;
    base::Duration repeated_for{};
    std::uint64_t felt = 0;
    for (std::uint64_t round = 0; round < rounds; ++round) {
        now += 1ms;
        const Sample sample = device.sample(round);
        repeated_for = sample.sequence == sequence ? repeated_for + 1ms : base::Duration{0};
        sequence = sample.sequence;
        const bool was_latched = governor.fault().fault != Fault::none;
        const auto given = governor.govern(
            {wish(stream, round), stream.below(50, round / 200, 12) != 0}, sample, now);
        const base::Force force = given.force();
        ASSERT_NO_FATAL_FAILURE(expect_within(limits, sample, force)) << round;
        if (has_to_be_zero(sample, repeated_for) || was_latched ||
            governor.state() == GovernorState::fault) {
            ASSERT_EQ(force, base::Force{}) << round;
            ASSERT_FALSE(given.motors_on()) << round;
        }
        ASSERT_TRUE(given.motors_on() || force == base::Force{}) << round;
        // A force grows by at most one newton per millisecond.
        ASSERT_LE(base::norm(force), base::norm(before) + 1.0 + 1e-9) << round;
        if (!(force == base::Force{})) ++felt;
        before = force;
    }
    EXPECT_GT(felt, rounds / 20);
    const GovernorCounters& c = governor.counters();
    const std::array counts{c.not_finite,     c.clamped,        c.joint_limited, c.flattened,
                            c.outside,        c.slewed,         c.faded,         c.silent,
                            c.docked,         c.uncalibrated,   c.too_fast,      c.resets,
                            c.faults.device,  c.faults.silence, c.faults.speed,  c.faults.jump,
                            c.faults.nonsense};
    for (std::size_t i = 0; i < counts.size(); ++i) EXPECT_GT(counts[i], 0U) << i;
}

TEST(Governor, KeepsTheDirectionOfWhatItShortens)
{
    const auto stream = base::Seed{8}.stream("direction");
    GovernorLimits limits = limits_for({.force_max_n = 3.3, .force_continuous_n = 0.88}, {});
    limits.joints = JointLimits{{"test", skew_arm}, glm::dvec3{0.2, 0.2, 0.2}};
    Governor governor{limits};
    Sample sample;
    base::TimePoint now{1h};
    for (std::uint64_t round = 0; round < 300; ++round) {
        base::Force wanted;
        for (const int axis : {0, 1, 2}) {
            const auto draw = static_cast<std::uint32_t>(axis);
            wanted.value[axis] = 20.0 * stream.uniform(round, draw) - 10.0;
            sample.hip.value[axis] = 0.06 * stream.uniform(round, draw + 3) - 0.03;
        }
        base::Force force;
        for (int ms = 0; ms < 150; ++ms) { // long enough for any slew
            ++sample.sequence;
            force = governor.govern({wanted, true}, sample, now += 1ms).force();
        }
        const double along = glm::dot(force.value, wanted.value);
        ASSERT_NEAR(along, base::norm(force) * base::norm(wanted), 1e-9) << round;
        ASSERT_LE(base::norm(force), 3.3 * (1.0 + 1e-12)) << round;
    }
    EXPECT_GT(governor.counters().heat_limited, 0U);
}

TEST(Governor, GivesTheSameBitsWithEveryCompiler)
{
    const auto stream = base::Seed{3}.stream("bits");
    Capabilities can{.force_max_n = 3.3, .force_continuous_n = 0.88};
    can.joints = JointLimits{{"test", skew_arm}, glm::dvec3{0.3}};
    Governor governor{limits_for(can, {})};
    Sample sample;
    base::TimePoint now{1h};
    std::uint64_t hash = 0xcbf29ce484222325; // FNV-1a
    for (std::uint64_t round = 0; round < 30'000; ++round) {
        ++sample.sequence;
        now += base::Duration{900'000 + stream.below(200'000, round, 9)};
        base::Force wanted;
        for (const int axis : {0, 1, 2}) {
            const auto draw = static_cast<std::uint32_t>(axis);
            sample.hip.value[axis] = 0.06 * stream.uniform(round / 20, draw) - 0.03;
            wanted.value[axis] = 8.0 * stream.uniform(round / 50, draw + 3) - 4.0;
        }
        const bool permitted = stream.below(40, round / 300, 8) != 0;
        const base::Force force = governor.govern({wanted, permitted}, sample, now).force();
        for (const int axis : {0, 1, 2}) {
            hash = (hash ^ std::bit_cast<std::uint64_t>(force.value[axis])) * 0x100000001b3;
        }
    }
    EXPECT_GT(governor.counters().joint_limited, 0U);
    EXPECT_GT(governor.counters().heat_limited, 0U);
    EXPECT_EQ(hash, 0x58a7544e7a0a3599U);
}

} // namespace
} // namespace hapnet::device
