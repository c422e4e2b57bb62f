// SPDX-FileCopyrightText: 2026 The Hapnet authors
// SPDX-License-Identifier: MIT
#include "peer/self_test/calibrate_step.hpp"

#include <spdlog/fmt/fmt.h>

namespace hapnet::peer::self_test {

namespace {

Prompt prompt_for(const StepInput& input)
{
    if (input.sample.calibrated) {
        return input.sample.docked ? Prompt::undock : Prompt::nothing;
    }
    switch (input.calibration) {
    case device::CalibrationStep::dock_stylus: return Prompt::dock;
    case device::CalibrationStep::sweep_joints: return Prompt::sweep;
    default: return Prompt::wait;
    }
}

} // namespace

StepRequest CalibrateStep::on_tick(const StepInput& input, base::TimePoint now)
{
    if (!start_) start_ = now;
    took_ = now - *start_;
    prompt_ = prompt_for(input);
    has_failed_ = input.calibration == device::CalibrationStep::failed;
    const bool is_in_vain = has_failed_ || input.sample.fault == device::Fault::disconnected;
    return {.is_done = prompt_ == Prompt::nothing || is_in_vain || took_ >= patience,
            .prompt = prompt_};
}

Outcome CalibrateStep::outcome() const
{
    Outcome outcome{.step = "calibrate", .verdict = Verdict::passed, .text = {}};
    outcome.took = took_;
    outcome.text = "the device is calibrated, and in a hand";
    if (prompt_ == Prompt::nothing) return outcome;
    outcome.verdict = Verdict::failed;
    outcome.text = has_failed_ ? std::string{device::describe(device::CalibrationStep::failed)}
                               : fmt::format("not done after {:.0f} s; the last step was: {}",
                                             base::to_seconds(took_), describe(prompt_));
    return outcome;
}

} // namespace hapnet::peer::self_test
