// SPDX-FileCopyrightText: 2026 The Hapnet authors
// SPDX-License-Identifier: MIT
#include "device/hdapi/device_cycle.hpp"

#include "device/hdapi/mapping.hpp"

#include <utility>

namespace hapnet::device::hdapi {

ErrorInfo first_error(const Functions& functions)
{
    ErrorInfo first{error::none, 0, no_device};
    for (int i = 0; i < errors_max; ++i) {
        const ErrorInfo latest = functions.get_error();
        if (latest.code == error::none) break;
        first = latest;
    }
    return first;
}

const Report& DeviceCycle::begin()
{
    settle_errors();
    functions_->make_current_device(handle_);
    calibrate();
    if (!motors_on_) switch_motors(false);
    functions_->begin_frame(handle_);
    unsigned char inkwell_switch = 0;
    functions_->get_integers(parameter::buttons, &report_.buttons);
    functions_->get_booleans(parameter::inkwell_switch, &inkwell_switch);
    functions_->get_doubles(parameter::position, report_.position_mm.data());
    functions_->get_doubles(parameter::velocity, report_.velocity_mm_per_s.data());
    report_.inkwell_switch = inkwell_switch != 0;
    ++report_.cycle;
    return report_;
}

void DeviceCycle::end(const Command& command, bool is_new)
{
    stale_cycles_ = is_new ? 0 : stale_cycles_ + 1;
    const bool on = command.motors_on && stale_cycles_ < stale_after_cycles &&
                    report_.calibration == calibration::done;
    const std::array<double, 3> force = on ? command.force_n : std::array<double, 3>{};
    switch_motors(on);
    functions_->set_doubles(parameter::force, force.data());
    functions_->end_frame(handle_);
    silent_frames_ = on ? 0 : silent_frames_ + 1;
}

/// Calibrates in every cycle, as public drivers do (phantom_omni, Geomagic_Touch_ROS_Drivers). An
/// encoder reset is left out, because it makes the arm's current position the origin, and only a
/// person knows where that is.
void DeviceCycle::calibrate()
{
    report_.calibration = functions_->check_calibration();
    const bool needs_update = report_.calibration == calibration::needs_update;
    if (needs_update && style_ != calibration::style_encoder_reset) {
        functions_->update_calibration(static_cast<unsigned int>(style_));
    }
}

void DeviceCycle::switch_motors(bool on)
{
    if (on == motors_on_) return;
    motors_on_ = on;
    (on ? functions_->enable : functions_->disable)(capability::force_output);
}

void DeviceCycle::settle_errors()
{
    const unsigned int happened = std::exchange(happened_, error::none);
    const bool is_of_the_line = fault_of(happened) == Fault::communication;
    report_.failures_in_a_row = is_of_the_line ? report_.failures_in_a_row + 1 : 0;
    if (happened == error::none) return;
    report_.error = happened;
    report_.error_cycle = report_.cycle;
}

} // namespace hapnet::device::hdapi
