// SPDX-FileCopyrightText: 2026 The Hapnet authors
// SPDX-License-Identifier: MIT
// Requirements on every device.
#include "device/rig.hpp"
#include "tests/conformance/subject.hpp"

#include <algorithm>
#include <chrono>
#include <glm/vector_relational.hpp>
#include <gtest/gtest.h>
#include <limits>

namespace hapnet::conformance {
namespace {

using namespace std::chrono_literals;

constexpr base::Duration tick = 1ms;
const base::Force along_x{{1.0, 0.0, 0.0}};
constexpr double nan = std::numeric_limits<double>::quiet_NaN();

/// A device under the governor, driven once per millisecond of its own time.
class Device : public ::testing::Test {
protected:
    Device() : subject_{make_subject()} {}

    void open()
    {
        auto opened = subject_->open();
        ASSERT_TRUE(opened.has_value()) << opened.error().message;
        rig_.emplace(*std::move(opened), device::GovernorLimits{});
    }

    /// Opens the device and calibrates it with a person's help.
    void open_calibrated()
    {
        ASSERT_NO_FATAL_FAILURE(open());
        play_for(50ms, {});
        if (subject_->traits().calibrates) subject_->help_calibrate();
        EXPECT_TRUE(play_until([&] { return sample().calibrated; }, {}));
        if (subject_->traits().docks) subject_->dock(false);
        // A person who takes the stylus out of its holder, or has moved the joints to their stops,
        // needs a while to reach the workspace.
        EXPECT_TRUE(play_until([&] { return !sample().docked && is_inside(); }, {}));
    }
    [[nodiscard]] bool is_inside() const
    {
        const device::Capabilities& can = rig_->device().capabilities();
        const auto& hip = sample().hip.value;
        return glm::all(glm::greaterThanEqual(hip, can.workspace_min.value)) &&
               glm::all(glm::lessThanEqual(hip, can.workspace_max.value));
    }

    void play(const base::Force& wanted)
    {
        subject_->pass(tick);
        const base::TimePoint now = subject_->now();
        sample_ = rig_->read(now);
        felt_ = rig_->apply(wanted, true, now);
    }

    void play_for(base::Duration duration, const base::Force& wanted)
    {
        const base::TimePoint end = subject_->now() + duration;
        while (subject_->now() < end) play(wanted);
    }

    template <typename Condition>
    bool play_until(Condition condition, const base::Force& wanted, base::Duration most = 5s)
    {
        const base::TimePoint end = subject_->now() + most;
        while (!condition() && subject_->now() < end) play(wanted);
        return condition();
    }

    /// True if the double has received a force since its command number `first`.
    [[nodiscard]] bool was_pushed_since(std::size_t first) const
    {
        const auto commands = subject_->commands();
        return std::any_of(commands.begin() + static_cast<std::ptrdiff_t>(first), commands.end(),
                           [](const Command& command) { return !command.zero; });
    }
    [[nodiscard]] bool last_is_zero() const
    {
        const auto commands = subject_->commands();
        return commands.empty() || commands.back().zero;
    }

    [[nodiscard]] const device::Sample& sample() const { return sample_; }
    [[nodiscard]] Subject& subject() { return *subject_; }
    [[nodiscard]] Traits traits() const { return subject_->traits(); }

    std::unique_ptr<Subject> subject_;
    std::optional<device::Rig> rig_;
    device::Sample sample_;
    base::Force felt_;
};

#define SKIP_UNLESS(condition)                                                                     \
    if (!(condition)) GTEST_SKIP() << "does not apply to this device: " #condition

TEST_F(Device, SaysWhoItIsAndWhatItCanDo)
{
    open();
    const device::Identity& identity = rig_->device().identity();
    EXPECT_FALSE(identity.backend.empty());
    EXPECT_FALSE(identity.model.empty());
    const device::Capabilities& can = rig_->device().capabilities();
    for (int axis = 0; axis < can.axes_in; ++axis) {
        EXPECT_LT(can.workspace_min.value[axis], can.workspace_max.value[axis]);
    }
    EXPECT_EQ(can.axes_out > 0, can.force_max_n > 0.0);
    EXPECT_LE(can.force_continuous_n, can.force_max_n);
    EXPECT_GT(can.rate_hz, 0.0);
}

TEST_F(Device, GivesFinitePositionsInsideItsWorkspaceAndNewerOnesAsTimePasses)
{
    open_calibrated();
    const std::uint64_t before = sample().sequence;
    for (int i = 0; i < 50; ++i) {
        play({});
        ASSERT_TRUE(base::is_finite(sample().hip));
        ASSERT_TRUE(base::is_finite(sample().velocity));
        ASSERT_EQ(sample().fault, device::Fault::none);
        ASSERT_TRUE(is_inside());
    }
    EXPECT_GT(sample().sequence, before);
}

TEST_F(Device, PushesAsSoonAsItMayAndRampsIn)
{
    SKIP_UNLESS(traits().has_motors);
    open_calibrated();
    const std::size_t first = subject().commands().size();
    // One newton, or the device's largest force. The whole ramp is the governor's own test: on a
    // busy machine a late tick begins it again.
    const double wanted = std::min(1.0, rig_->device().capabilities().force_max_n);
    EXPECT_TRUE(play_until([&] { return felt_.x() > 0.3 * wanted; }, along_x, 30s));
    play_for(5ms, along_x); // the last command may still be on its way
    EXPECT_TRUE(was_pushed_since(first));
    EXPECT_TRUE(subject().commands().back().motors_on);
    EXPECT_LE(felt_.x(), wanted);
}

TEST_F(Device, IsToldNoForceBeforeItIsCalibrated)
{
    SKIP_UNLESS(traits().has_motors && traits().calibrates);
    open();
    play_for(1500ms, along_x);
    EXPECT_FALSE(sample().calibrated);
    EXPECT_FALSE(was_pushed_since(0));
}

TEST_F(Device, IsToldNoForceWhileItsStylusIsDocked)
{
    SKIP_UNLESS(traits().has_motors && traits().docks);
    open_calibrated();
    play_for(1500ms, along_x);
    subject().dock(true);
    ASSERT_TRUE(play_until([&] { return sample().docked; }, along_x));
    play_for(60ms, along_x);
    const std::size_t first = subject().commands().size();
    play_for(300ms, along_x);
    EXPECT_FALSE(was_pushed_since(first));
}

TEST_F(Device, IsToldZeroOfWhatIsNotFinite)
{
    SKIP_UNLESS(traits().has_motors);
    open_calibrated();
    play_for(1500ms, along_x);
    play({{nan, 0.0, 0.0}});
    play({{nan, nan, nan}});
    EXPECT_EQ(felt_, base::Force{});
    subject().pass(5ms);
    play({{nan, 0.0, 0.0}});
    subject().pass(5ms);
    EXPECT_TRUE(last_is_zero());
}

TEST_F(Device, IsNeverToldMoreThanItsPeak)
{
    SKIP_UNLESS(traits().has_motors);
    open_calibrated();
    const double most = rig_->device().capabilities().force_max_n;
    for (int i = 0; i < 300; ++i) {
        play({{0.0, 1e6, 0.0}});
        ASSERT_LE(base::norm(felt_), most * (1.0 + 1e-12));
    }
}

TEST_F(Device, IsLeftAtZeroThreeTimesOverWhenItIsClosedInTheMiddleOfAPush)
{
    SKIP_UNLESS(traits().has_motors);
    open_calibrated();
    play_for(1500ms, along_x);
    ASSERT_TRUE(was_pushed_since(0));
    rig_.reset();
    subject().pass(50ms);
    const auto commands = subject().commands();
    ASSERT_GE(commands.size(), 3U);
    EXPECT_TRUE(std::all_of(commands.end() - 3, commands.end(), [](const Command& command) {
        return command.zero && !command.motors_on;
    }));
}

TEST_F(Device, IsStoppedByAnotherThreadsWord)
{
    SKIP_UNLESS(traits().has_motors);
    open_calibrated();
    play_for(1500ms, along_x);
    rig_->device().halt();
    subject().pass(20ms);
    EXPECT_TRUE(last_is_zero());
}

TEST_F(Device, ThatFallsSilentIsNoticedAndToldZeroWhenItListensAgain)
{
    SKIP_UNLESS(traits().stalls);
    open_calibrated();
    play_for(1500ms, along_x);
    subject().stall(true);
    EXPECT_TRUE(play_until([&] { return sample().fault == device::Fault::timeout; }, along_x, 1s));
    EXPECT_EQ(felt_, base::Force{});
    if (!traits().has_motors) return;
    play_for(200ms, along_x); // after a short stall it may push again, otherwise only on a command
    const std::size_t first = subject().commands().size();
    subject().stall(false);
    play_for(100ms, along_x);
    EXPECT_TRUE(last_is_zero());
    const auto commands = subject().commands();
    // Commands on their way when it fell silent may still arrive, but no later ones.
    const std::size_t on_the_way = std::min(first + 2, commands.size());
    EXPECT_FALSE(was_pushed_since(on_the_way));
}

TEST_F(Device, ThatIsUnpluggedSaysSoAndTheHandFeelsNothing)
{
    SKIP_UNLESS(traits().unplugs);
    open_calibrated();
    play_for(1200ms, along_x);
    subject().unplug();
    EXPECT_TRUE(
        play_until([&] { return sample().fault == device::Fault::disconnected; }, along_x, 1s));
    play(along_x);
    EXPECT_EQ(felt_, base::Force{});
}

TEST_F(Device, ThatWasUnpluggedOpensAgainAtZeroForce)
{
    SKIP_UNLESS(traits().unplugs);
    open_calibrated();
    play_for(1200ms, along_x);
    subject().unplug();
    play_for(100ms, along_x);
    rig_.reset();
    subject().plug_in();
    const std::size_t first = subject().commands().size();
    open();
    play_for(100ms, {});
    EXPECT_EQ(sample().fault, device::Fault::none);
    EXPECT_FALSE(was_pushed_since(first));
}

TEST_F(Device, ThatTalksNonsenseNeverGivesWhatIsNotFiniteNorForce)
{
    SKIP_UNLESS(traits().garbles);
    open_calibrated();
    play_for(1200ms, along_x);
    subject().garble(true);
    const base::TimePoint end = subject().now() + 300ms;
    while (subject().now() < end) {
        play(along_x);
        ASSERT_TRUE(base::is_finite(sample().hip));
        ASSERT_TRUE(base::is_finite(sample().velocity));
    }
    EXPECT_NE(sample().fault, device::Fault::none);
    EXPECT_EQ(felt_, base::Force{});
}

TEST_F(Device, IsNotOpenedTwice)
{
    SKIP_UNLESS(traits().exclusive);
    open();
    const auto second = subject().open();
    ASSERT_FALSE(second.has_value());
    EXPECT_EQ(second.error().fault, device::Fault::in_use);
    EXPECT_FALSE(second.error().message.empty());
    play_for(20ms, {});
    EXPECT_EQ(sample().fault, device::Fault::none);
}

} // namespace
} // namespace hapnet::conformance
