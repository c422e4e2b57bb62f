// SPDX-FileCopyrightText: 2026 The Hapnet authors
// SPDX-License-Identifier: MIT
#include "peer/self_test/force_step.hpp"

#include <algorithm>
#include <spdlog/fmt/fmt.h>

namespace hapnet::peer::self_test {

namespace {

// The least share of the peak that must be reached, because the governor ramps at the same time.
constexpr double share_wanted = 0.75;

} // namespace

double ForceStep::wanted_n(base::Duration into)
{
    const base::Duration whole = 2 * ramp + plateau;
    const base::Duration edge = std::min(into, whole - into);
    return peak_n * std::clamp(base::to_seconds(edge) / base::to_seconds(ramp), 0.0, 1.0);
}

void ForceStep::watch(const StepInput& input, bool is_held, base::TimePoint now)
{
    force_most_n_ = std::max(force_most_n_, base::norm(input.applied));
    if (fault_ == device::Fault::none) fault_ = input.sample.fault;
    if (is_held) {
        if (!held_since_) held_since_ = now;
        released_at_.reset();
    } else if (held_since_) {
        held_since_.reset();
        released_at_ = now;
        was_released_ = true;
    }
    const bool is_over = released_at_ && now - *released_at_ > zero_after;
    if (is_over && base::norm(input.applied) > 0.0) outlasted_release_ = true;
}

StepRequest ForceStep::on_tick(const StepInput& input, base::TimePoint now)
{
    if (!start_) start_ = now;
    was_up_ = was_up_ || !input.sample.gripping;
    const bool is_held = dead_man_ == DeadMan::simulated_hand || (was_up_ && input.sample.gripping);
    watch(input, is_held, now);
    const bool is_in_vain = fault_ != device::Fault::none || now - *start_ >= patience;
    if (is_in_vain) return {.is_done = true};
    if (!was_up_ && dead_man_ == DeadMan::person) return {.prompt = Prompt::release_button};
    if (!held_since_) return {.prompt = Prompt::hold_button};
    const base::Duration into = now - *held_since_;
    is_complete_ = into >= 2 * ramp + plateau;
    return {.wanted = {{wanted_n(into), 0.0, 0.0}},
            .permitted = !is_complete_,
            .is_done = is_complete_,
            .prompt = Prompt::keep_button};
}

Outcome ForceStep::outcome() const
{
    Outcome outcome{.step = "force", .verdict = Verdict::failed, .text = {}};
    outcome.force_max_n = force_most_n_;
    if (fault_ != device::Fault::none) {
        outcome.text = device::describe(fault_);
    } else if (outlasted_release_) {
        outcome.text = "the force outlasted the release of the button: do not use this device";
    } else if (!was_up_ && dead_man_ == DeadMan::person) {
        outcome.text =
            "the button was down all the time: do not use this device, because releasing "
            "it would stop nothing";
    } else if (!is_complete_) {
        outcome.verdict = Verdict::skipped;
        outcome.text = "the button was not held to the end of the ramp";
    } else if (force_most_n_ < share_wanted * peak_n) {
        outcome.text =
            fmt::format("the governor let only {:.2f} of {:.2f} N through", force_most_n_, peak_n);
    } else {
        outcome.verdict = Verdict::passed;
        outcome.text = fmt::format("the motors were told up to {:.2f} N{}{}", force_most_n_,
                                   was_released_ ? ", and none after a release" : "",
                                   dead_man_ == DeadMan::person
                                       ? "; check for yourself that it pushed you to the right"
                                       : "");
    }
    return outcome;
}

} // namespace hapnet::peer::self_test
