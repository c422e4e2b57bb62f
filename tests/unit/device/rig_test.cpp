// SPDX-FileCopyrightText: 2026 The Hapnet authors
// SPDX-License-Identifier: MIT
#include "device/rig.hpp"
#include "tests/support/device/governed.hpp"

#include <chrono>
#include <gtest/gtest.h>
#include <memory>

namespace hapnet::device {
namespace {

using namespace std::chrono_literals;
using test::along_x;

/// A device that reports nothing new every other time.
class SlowDevice final : public Device {
public:
    explicit SlowDevice(const Capabilities& can) : can_{can} {}
    [[nodiscard]] const Identity& identity() const override { return identity_; }
    [[nodiscard]] const Capabilities& capabilities() const override { return can_; }
    [[nodiscard]] Sample read(base::TimePoint /*now*/) override
    {
        Sample sample;
        sample.sequence = ++reads_ / 2; // every other report is old
        return sample;
    }
    void apply(const GovernedForce& /*force*/) override {}
    void halt() noexcept override {}

private:
    Identity identity_;
    Capabilities can_;
    std::uint64_t reads_ = 1;
};

TEST(Rig, KeepsToTheLimitsOfItsDevice)
{
    Rig rig{
        std::make_unique<SlowDevice>(Capabilities{.force_max_n = 0.5, .force_continuous_n = 0.5}),
        {.force_max_n = 2.0}};
    base::TimePoint now{1h};
    base::Force force;
    for (int i = 0; i < 1100; ++i) {
        std::ignore = rig.read(now += 1ms);
        force = rig.apply(along_x(9.0), true, now);
    }
    EXPECT_NEAR(force.x(), 0.5, 1e-12);
    EXPECT_EQ(rig.counters().reads, 1100U);
    EXPECT_EQ(rig.counters().repeated, 550U);
    EXPECT_EQ(rig.counters().repeated_most, 1U);
}

} // namespace
} // namespace hapnet::device
