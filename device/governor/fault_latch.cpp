// SPDX-FileCopyrightText: 2026 The Hapnet authors
// SPDX-License-Identifier: MIT
#include "device/governor/fault_latch.hpp"

namespace hapnet::device {

bool FaultLatch::close(const Latched& cause)
{
    if (is_closed() || cause.fault == Fault::none) return false;
    latched_ = cause;
    last_.reset();
    was_out_ = false;
    return true;
}

bool FaultLatch::on_sample(const Sample& sample, base::Duration passed)
{
    const std::optional<LastSample> before = last_;
    const bool rests = base::norm(sample.velocity) <= rest_speed_max_m_per_s;
    last_ = LastSample{.pressed = (sample.buttons & 1U) != 0};
    was_out_ = was_out_ || !sample.docked;
    if (!before) return false;
    if (rests) last_->rest = before->rest + passed;
    if (sample.docked) last_->docked = before->docked + passed;
    const bool docks = was_out_ && last_->docked >= dock_needed;
    if (last_->pressed) {
        const bool begins = !before->pressed;
        last_->deliberate = begins ? before->rest >= rest_needed : before->deliberate;
        if (!begins) last_->held = before->held + passed;
    }
    const bool presses = last_->deliberate && last_->held >= press_needed;
    if (!docks && !presses) return false;
    open();
    return true;
}

} // namespace hapnet::device
