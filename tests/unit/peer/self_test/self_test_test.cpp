// SPDX-FileCopyrightText: 2026 The Hapnet authors
// SPDX-License-Identifier: MIT
#include "peer/self_test/report.hpp"
#include "peer/self_test/self_test.hpp"

#include <chrono>
#include <gtest/gtest.h>

namespace hapnet::peer::self_test {
namespace {

using namespace std::chrono_literals;

constexpr base::TimePoint start{1000s};
const std::vector<std::string> all_steps{"read", "calibrate", "force", "cable"};

std::vector<std::string> all_but(const std::string& step)
{
    std::vector<std::string> others = all_steps;
    std::erase(others, step);
    return others;
}

device::Capabilities an_omni()
{
    device::Capabilities can;
    can.force_max_n = 3.3;
    can.force_continuous_n = 0.88;
    return can;
}

/// A test of one step, in virtual time at 1 kHz. Its device applies each force at once.
class Played {
public:
    explicit Played(const std::string& step, bool is_real = true)
        : test_{{.capabilities = an_omni(),
                 .is_real = is_real,
                 .read_for = 1s,
                 .skip = all_but(step)}},
          step_{step}
    {
        input.sample.sequence = 1;
    }

    void play(base::Duration duration)
    {
        for (base::Duration t{}; t < duration && !request.is_done; t += 1ms) {
            now_ += 1ms;
            if (!is_mute) ++input.sample.sequence;
            request = test_.on_tick(input, now_);
            if (!ignores_forces) input.applied = request.permitted ? request.wanted : base::Force{};
            most_n = std::max(most_n, base::norm(request.wanted));
        }
    }
    /// Returns the outcome of the step, after its end.
    [[nodiscard]] Outcome outcome()
    {
        test_.stop();
        for (const Outcome& one : test_.outcomes()) {
            if (one.step == step_) return one;
        }
        return {};
    }

    StepInput input;
    StepRequest request;
    double most_n = 0.0;
    bool is_mute = false;
    bool ignores_forces = false;

private:
    SelfTest test_;
    std::string step_;
    base::TimePoint now_ = start;
};

} // namespace

TEST(SelfTest, MeasuresTheRateAtWhichADeviceSpeaks)
{
    Played read{"read"};
    read.play(2s);
    EXPECT_TRUE(read.request.is_done);
    EXPECT_EQ(read.most_n, 0.0);
    const Outcome outcome = read.outcome();
    EXPECT_EQ(outcome.verdict, Verdict::passed) << outcome.text;
    EXPECT_DOUBLE_EQ(outcome.rate_hz.value(), 1000.0);
    EXPECT_EQ(outcome.gap_max, 1ms);
    EXPECT_NE(outcome.drawing.find("0.9 to 1.1 ms    1000  ####"), std::string::npos)
        << outcome.drawing;
}

TEST(SelfTest, CountsTheWordsOfADeviceAndNotItsOwnTicks)
{
    Played read{"read"};
    read.play(500ms);
    read.is_mute = true;
    read.play(100ms);
    read.is_mute = false;
    read.play(2s);
    EXPECT_EQ(read.outcome().gap_max, 101ms);
}

TEST(SelfTest, PassesADeviceThatRestsWhileNothingMoves)
{
    Played read{"read"};
    read.play(200ms);
    read.is_mute = true;
    for (int i = 0; i < 101; ++i) {
        ++read.input.sample.sequence;
        read.play(8ms);
    }
    EXPECT_EQ(read.outcome().verdict, Verdict::passed) << read.outcome().text;
}

TEST(SelfTest, FailsADeviceThatIsMuteOrSlowOrAtFault)
{
    Played mute{"read"};
    mute.is_mute = true;
    mute.play(2s);
    EXPECT_EQ(mute.outcome().verdict, Verdict::failed);

    Played slow{"read"};
    slow.is_mute = true;
    for (int i = 0; i < 400; ++i) {
        ++slow.input.sample.sequence;
        slow.play(3ms);
    }
    EXPECT_EQ(slow.outcome().verdict, Verdict::failed);
    EXPECT_NE(slow.outcome().text.find("1000 a second are nominal"), std::string::npos);

    Played faulty{"read"};
    faulty.input.sample.fault = device::Fault::overheat;
    faulty.play(1ms);
    faulty.input.sample.fault = device::Fault::none;
    faulty.play(2s);
    EXPECT_EQ(faulty.outcome().verdict, Verdict::failed);
}

TEST(SelfTest, TellsAPersonStepByStepHowToCalibrate)
{
    Played calibration{"calibrate"};
    calibration.input.sample.calibrated = false;
    calibration.input.calibration = device::CalibrationStep::dock_stylus;
    calibration.play(10ms);
    EXPECT_EQ(calibration.request.prompt, Prompt::dock);
    calibration.input.sample.calibrated = true;
    calibration.input.sample.docked = true;
    calibration.play(10ms);
    EXPECT_EQ(calibration.request.prompt, Prompt::undock);
    EXPECT_FALSE(calibration.request.is_done);
    calibration.input.sample.docked = false;
    calibration.play(10ms);
    EXPECT_TRUE(calibration.request.is_done);
    EXPECT_EQ(calibration.outcome().verdict, Verdict::passed);
}

TEST(SelfTest, SaysWhatHelpsWhenTheDeviceSaysThatItsCalibrationFailed)
{
    Played calibration{"calibrate"};
    calibration.input.sample.calibrated = false;
    calibration.input.calibration = device::CalibrationStep::failed;
    calibration.play(10ms);
    EXPECT_TRUE(calibration.request.is_done);
    EXPECT_EQ(calibration.outcome().verdict, Verdict::failed);
    EXPECT_EQ(calibration.outcome().text, device::describe(device::CalibrationStep::failed));
}

TEST(SelfTest, GivesUpACalibrationThatTakesAMinute)
{
    Played calibration{"calibrate"};
    calibration.input.sample.calibrated = false;
    calibration.play(61s);
    EXPECT_TRUE(calibration.request.is_done);
    EXPECT_EQ(calibration.outcome().verdict, Verdict::failed);
}

TEST(SelfTest, PushesOnlyWhileTheButtonIsHeldAndNeverWithMoreThanAFifthOfANewton)
{
    Played force{"force"};
    force.play(1s);
    EXPECT_EQ(force.most_n, 0.0);
    EXPECT_EQ(force.request.prompt, Prompt::hold_button);
    force.input.sample.gripping = true;
    force.play(1s);
    EXPECT_NEAR(force.request.wanted.x(), 0.1, 1e-3);
    force.input.sample.gripping = false;
    force.play(1ms);
    EXPECT_EQ(force.request.wanted, base::Force{});
    EXPECT_FALSE(force.request.permitted);
    force.play(1s);
    EXPECT_FALSE(force.request.is_done);
    force.input.sample.gripping = true; // from zero again
    force.play(1ms);
    EXPECT_LT(base::norm(force.request.wanted), 1e-3);
    force.play(10s);
    EXPECT_TRUE(force.request.is_done);
    EXPECT_DOUBLE_EQ(force.most_n, 0.2);
    EXPECT_EQ(force.outcome().verdict, Verdict::passed) << force.outcome().text;
}

TEST(SelfTest, NeverPushesWithAButtonThatWasNeverSeenUp)
{
    Played force{"force"};
    force.input.sample.gripping = true;
    force.play(30s);
    EXPECT_EQ(force.request.prompt, Prompt::release_button);
    EXPECT_FALSE(force.request.permitted);
    EXPECT_EQ(force.most_n, 0.0);
    force.play(31s);
    EXPECT_EQ(force.outcome().verdict, Verdict::failed);
    EXPECT_NE(force.outcome().text.find("down all the time"), std::string::npos);
}

TEST(SelfTest, FailsAForceThatOutlastsTheButton)
{
    Played force{"force"};
    force.play(1ms);
    force.input.sample.gripping = true;
    force.play(1s);
    force.ignores_forces = true; // the force stays
    force.input.sample.gripping = false;
    force.play(200ms);
    force.input.sample.gripping = true;
    force.play(10s);
    EXPECT_EQ(force.outcome().verdict, Verdict::failed);
    EXPECT_NE(force.outcome().text.find("outlasted"), std::string::npos);
}

TEST(SelfTest, FailsAForceThatDoesNotCome)
{
    Played force{"force"};
    force.ignores_forces = true;
    force.play(1ms);
    force.input.sample.gripping = true;
    force.play(10s);
    EXPECT_EQ(force.outcome().verdict, Verdict::failed);
}

TEST(SelfTest, StopsPushingAtAFault)
{
    Played force{"force"};
    force.play(1ms);
    force.input.sample.gripping = true;
    force.play(2s);
    force.input.sample.fault = device::Fault::timeout;
    force.play(1ms);
    EXPECT_TRUE(force.request.is_done);
    EXPECT_FALSE(force.request.permitted);
    EXPECT_EQ(force.outcome().verdict, Verdict::failed);
}

TEST(SelfTest, DoesNotPushWhatHasNoMotorsOrNoButton)
{
    device::Capabilities mouse = an_omni();
    mouse.axes_out = 0;
    device::Capabilities buttonless = an_omni();
    buttonless.buttons = 0;
    for (const auto& can : {mouse, buttonless}) {
        SelfTest test{{.capabilities = can, .is_real = true, .skip = all_but("force")}};
        EXPECT_TRUE(test.on_tick({}, start).is_done);
        EXPECT_EQ(test.outcomes().at(2).verdict, Verdict::skipped);
    }
}

TEST(SelfTest, SeesACableBeingPulledAndHowLongThatTook)
{
    Played cable{"cable"};
    cable.play(3s);
    EXPECT_EQ(cable.request.prompt, Prompt::pull_cable);
    cable.is_mute = true;
    cable.play(21ms);
    cable.input.sample.fault = device::Fault::timeout;
    cable.play(1ms);
    EXPECT_TRUE(cable.request.is_done);
    EXPECT_EQ(cable.outcome().verdict, Verdict::passed);
    EXPECT_EQ(cable.outcome().noticed_after, 22ms);
}

TEST(SelfTest, CallsNoCablePulledThatWasLostBefore)
{
    Played cable{"cable"};
    cable.input.sample.fault = device::Fault::timeout;
    cable.play(1ms);
    EXPECT_TRUE(cable.request.is_done);
    EXPECT_EQ(cable.outcome().verdict, Verdict::failed) << cable.outcome().text;
}

TEST(SelfTest, IsOverAndNotPassedWhenTheDeviceGoesInTheMiddle)
{
    for (const base::Duration lost_after : {0ms, 500ms, 1500ms}) { // while it reads, and pushes
        SelfTest test{{.capabilities = an_omni(), .read_for = 1s, .skip = {"calibrate"}}};
        StepInput input;
        StepRequest request;
        base::Duration t{};
        for (; t < 3s && !request.is_done; t += 1ms) {
            input.sample.sequence += 1;
            if (t >= lost_after) input.sample.fault = device::Fault::disconnected;
            request = test.on_tick(input, start + t);
        }
        EXPECT_LE(t, lost_after + 1ms);
        EXPECT_FALSE(request.permitted);
        EXPECT_FALSE(test.is_finished());
        EXPECT_FALSE(has_passed(test));
        const std::size_t failed = lost_after < 1s ? 0 : 2;
        ASSERT_EQ(test.outcomes().size(), 4U);
        EXPECT_EQ(test.outcomes()[failed].verdict, Verdict::failed);
        EXPECT_EQ(test.outcomes()[1].text, "left out by --skip");
        EXPECT_EQ(test.outcomes()[3].text, "the device has gone");
    }
}

TEST(SelfTest, IsNotPassedWhenItWasBrokenOff)
{
    SelfTest broken_off{{.capabilities = an_omni(), .is_real = false, .read_for = 1s}};
    EXPECT_FALSE(broken_off.on_tick({}, start).is_done);
    broken_off.stop();
    EXPECT_FALSE(broken_off.is_finished());
    EXPECT_FALSE(has_passed(broken_off));

    SelfTest whole{{.capabilities = an_omni(), .is_real = false, .skip = all_but("calibrate")}};
    EXPECT_TRUE(whole.on_tick({}, start).is_done);
    whole.stop(); // too late
    EXPECT_TRUE(whole.is_finished());
    EXPECT_TRUE(has_passed(whole));
}

TEST(SelfTest, LeavesTheCableOfASimulatedDeviceAloneAndWhatIsSkippedToo)
{
    SelfTest test{{.capabilities = an_omni(), .is_real = false, .skip = all_but("cable")}};
    EXPECT_TRUE(test.on_tick({}, start).is_done);
    ASSERT_EQ(test.outcomes().size(), 4U);
    for (const Outcome& one : test.outcomes()) EXPECT_EQ(one.verdict, Verdict::skipped);
}

} // namespace hapnet::peer::self_test
