// SPDX-FileCopyrightText: 2026 The Hapnet authors
// SPDX-License-Identifier: MIT
// The actions of a simulated person after a latched fault.
#include "device/rig.hpp"
#include "device/simulated/omni.hpp"

#include <chrono>
#include <gtest/gtest.h>
#include <memory>
#include <optional>

namespace hapnet::device {
namespace {

using namespace std::chrono_literals;

constexpr base::TimePoint session{1h};
constexpr Latched stall{Fault::timeout, Trip::loop};

/// A session of a simulated person, without a scene: at 1 kHz, with a force that may be felt.
class Played {
public:
    explicit Played(std::unique_ptr<Device> device) : rig_{std::move(device), GovernorLimits{}}
    {
        rig_.device().on_cue({session, 30s, base::Seed{7}, 1, true});
    }

    void play(base::Duration length)
    {
        for (const base::TimePoint end = now_ + length; now_ < end; now_ += 1ms) {
            const base::Position before = sample.hip;
            sample = rig_.read(now_);
            step_most_m = std::max(step_most_m, base::norm(sample.hip - before));
            if (sample.gripping) ++ticks_pressed;
            std::ignore = rig_.apply({{0.1, 0.0, 0.0}}, true, now_);
        }
    }
    [[nodiscard]] Governor& governor() { return rig_.governor(); }

    Sample sample;
    double step_most_m = 0.0;
    int ticks_pressed = 0;

private:
    Rig rig_;
    base::TimePoint now_ = session;
};

std::unique_ptr<Device> an_omni(Task task)
{
    return std::make_unique<SimulatedOmni>(Performer{.task = task});
}

/// An Omni whose motors are hot for some time.
class HotOmni final : public Device {
public:
    HotOmni(base::TimePoint from, base::TimePoint to) : from_{from}, to_{to} {}

    [[nodiscard]] const Identity& identity() const override { return omni_->identity(); }
    [[nodiscard]] const Capabilities& capabilities() const override
    {
        return omni_->capabilities();
    }
    [[nodiscard]] Sample read(base::TimePoint now) override
    {
        Sample sample = omni_->read(now);
        if (now >= from_ && now < to_) sample.fault = Fault::overheat;
        return sample;
    }
    void apply(const GovernedForce& force) override { omni_->apply(force); }
    void halt() noexcept override { omni_->halt(); }
    void on_cue(const Cue& cue) override { omni_->on_cue(cue); }
    void on_fault(bool is_latched) override { omni_->on_fault(is_latched); }

private:
    std::unique_ptr<Device> omni_ = an_omni(Task::t3);
    base::TimePoint from_;
    base::TimePoint to_;
};

/// When a hand of T2 first feels a body that begins 20 mm beyond the task's place, and for how long
/// within ten seconds.
struct Found {
    std::optional<base::Duration> first{};
    int ticks = 0;
};
Found found_by(double search_speed_m_per_s)
{
    Operator person;
    person.wander.amplitude_m = person.tremor.amplitude_m = 0.0;
    person.search.speed_m_per_s = search_speed_m_per_s;
    Performer performer{.task = Task::t2, .person = person};
    performer.options.press_amplitude_m = 0.0;
    Rig rig{std::make_unique<SimulatedOmni>(performer), GovernorLimits{}};
    rig.device().on_cue({session, 27s, base::Seed{7}, 1, true});
    Found found;
    for (base::Duration t{}; t < 10s; t += 1ms) {
        const double depth = rig.read(session + t).hip.x() + 0.001; // its aim is at -21 mm
        const bool touching = t >= 2s && depth > 0.0;               // until then it is on its way
        const double force_n = touching ? -500.0 * depth : 0.0;
        std::ignore = rig.apply({{force_n, 0.0, 0.0}}, touching, session + t);
        if (touching && !found.first) found.first = t;
        found.ticks += touching ? 1 : 0;
    }
    return found;
}

TEST(SimulatedPerson, LooksForABodyThatIsNotWhereItsTaskHasIt)
{
    EXPECT_FALSE(found_by(0.0).first);
    const Found found = found_by(0.05);
    ASSERT_TRUE(found.first);
    // From 2 s on it means to touch. It begins to search 0.4 s later, and 20 mm take 0.4 s.
    EXPECT_GT(*found.first, 2s + 400ms + 350ms);
    EXPECT_LT(*found.first, 2s + 400ms + 600ms);
    EXPECT_GT(found.ticks, 6900) << "and stays there";
}

TEST(SimulatedPerson, EndsAFaultLikeAPersonWouldAndGoesBackToItsPart)
{
    for (const Task task : {Task::t3, Task::t6}) {
        Played played{an_omni(task)};
        Played undisturbed{an_omni(task)};
        played.play(5s);
        undisturbed.play(5s);
        ASSERT_EQ(played.governor().state(), GovernorState::active);
        played.governor().latch(stall);
        played.play(1400ms);
        EXPECT_EQ(played.governor().state(), GovernorState::fault);
        EXPECT_EQ(played.ticks_pressed, 0);
        const base::Position rest = played.sample.hip;
        played.play(50ms);
        EXPECT_EQ(played.sample.hip, rest); // it holds still
        played.play(450ms);                 // it presses for longer than the 0.3 s that count
        EXPECT_EQ(played.governor().counters().resets, 1U);
        EXPECT_EQ(played.governor().fault().fault, Fault::none);
        played.step_most_m = 0.0;
        played.play(2s);
        EXPECT_LT(played.step_most_m, 1e-3); // 1 m/s: no jump on its way back
        EXPECT_EQ(played.governor().state(), GovernorState::active);
        undisturbed.play(3900ms);
        EXPECT_LT(base::norm(played.sample.hip - undisturbed.sample.hip), 2e-3);
        EXPECT_LE(played.ticks_pressed, 302);
    }
}

TEST(SimulatedPerson, LetsGoOfTheButtonThatItHoldsToPressItAgain)
{
    Played played{an_omni(Task::p1)};
    played.play(5s);
    ASSERT_TRUE(played.sample.gripping);
    played.governor().latch(stall);
    played.play(1s);
    EXPECT_FALSE(played.sample.gripping);
    played.play(3s);
    EXPECT_EQ(played.governor().counters().resets, 1U);
    EXPECT_TRUE(played.sample.gripping);
    EXPECT_EQ(played.governor().state(), GovernorState::active);
}

TEST(SimulatedPerson, PressesAgainAsLongAsTheDeviceIsStillAtFault)
{
    Played played{std::make_unique<HotOmni>(session + 6s, session + 11s)};
    played.play(10s);
    EXPECT_EQ(played.governor().state(), GovernorState::fault);
    EXPECT_EQ(played.governor().fault().fault, Fault::overheat);
    EXPECT_EQ(played.governor().counters().resets, 0U);
    EXPECT_EQ(played.ticks_pressed, 800); // twice, in vain
    played.play(7s);
    EXPECT_EQ(played.governor().counters().resets, 1U);
    EXPECT_EQ(played.governor().state(), GovernorState::active);
}

TEST(SimulatedPerson, DoesNothingOfTheKindBeforeItsCue)
{
    SimulatedOmni omni{Performer{.task = Task::t3}};
    omni.on_fault(true);
    for (int ms = 0; ms < 5000; ++ms) EXPECT_FALSE(omni.read(session + ms * 1ms).gripping);
}

} // namespace
} // namespace hapnet::device
