// SPDX-FileCopyrightText: 2026 The Hapnet authors
// SPDX-License-Identifier: MIT
#include "peer/self_test/calibrate_step.hpp"

#include <spdlog/fmt/fmt.h>

namespace hapnet::peer::self_test {

namespace {

Prompt prompt_for(const Feeling& feeling)
{
    if (feeling.sample.calibrated) {
        return feeling.sample.docked ? Prompt::undock : Prompt::nothing;
    }
    switch (feeling.calibration) {
    case device::CalibrationStep::dock_stylus: return Prompt::dock;
    case device::CalibrationStep::sweep_joints: return Prompt::sweep;
    default: return Prompt::wait;
    }
}

} // namespace

Turn CalibrateStep::on_tick(const Feeling& feeling, base::TimePoint now)
{
    if (!start_) start_ = now;
    took_ = now - *start_;
    prompt_ = prompt_for(feeling);
    has_failed_ = feeling.calibration == device::CalibrationStep::failed;
    const bool is_in_vain = has_failed_ || feeling.sample.fault == device::Fault::disconnected;
    return {.is_done = prompt_ == Prompt::nothing || is_in_vain || took_ >= patience,
            .prompt = prompt_};
}

Outcome CalibrateStep::outcome() const
{
    Outcome outcome{.step = "calibrate", .verdict = Verdict::passed, .text = {}};
    outcome.figures = {{"took_s", base::to_seconds(took_)}};
    outcome.text = "the device is calibrated, and in a hand";
    if (prompt_ == Prompt::nothing) return outcome;
    outcome.verdict = Verdict::failed;
    outcome.text = has_failed_ ? std::string{device::words_for(device::CalibrationStep::failed)}
                               : fmt::format("not done after {:.0f} s; last it was: {}",
                                             base::to_seconds(took_), words_for(prompt_));
    return outcome;
}

} // namespace hapnet::peer::self_test
