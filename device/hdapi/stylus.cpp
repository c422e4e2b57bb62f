// SPDX-FileCopyrightText: 2026 The Hapnet authors
// SPDX-License-Identifier: MIT
#include "device/hdapi/stylus.hpp"

#include "device/hdapi/mapping.hpp"

namespace hapnet::device::hdapi {

namespace {

glm::dvec3 in_metres(const std::array<double, 3>& millimetres)
{
    return 1e-3 * glm::dvec3{millimetres[0], millimetres[1], millimetres[2]};
}

} // namespace

const Sample& Stylus::read(const Report& report, base::TimePoint now)
{
    if (!heard_) heard_ = now;
    if (report.cycle > sample_.sequence) {
        take(report, now);
    } else if (now - *heard_ > silence_max) {
        sample_.fault = Fault::timeout;
    }
    return sample_;
}

void Stylus::take(const Report& report, base::TimePoint now)
{
    heard_ = now;
    sample_.sequence = report.cycle;
    sample_.calibrated = report.calibration == calibration::done;
    // The switch is open while the stylus rests in the inkwell, as in H3D's HAPI. Other programs
    // interpret it in the opposite way; then there would be no force on a stylus in the hand.
    sample_.docked = style_ == calibration::style_inkwell && !report.inkwell_switch;
    buttons_.update(static_cast<std::uint8_t>(static_cast<unsigned int>(report.buttons) & 0xffU),
                    now);
    buttons_.tell(sample_);
    sample_.fault = fault_of_report(report);
    const glm::dvec3 position = in_metres(report.position_mm);
    const glm::dvec3 velocity = in_metres(report.velocity_mm_per_s);
    if (!base::is_finite(position) || !base::is_finite(velocity)) {
        if (sample_.fault == Fault::none) sample_.fault = Fault::communication;
        return; // the last position stays
    }
    sample_.hip.value = position;
    sample_.velocity.value = velocity;
}

Fault Stylus::fault_of_report(const Report& report)
{
    if (report.failures_in_a_row >= gone_after_cycles) return Fault::disconnected;
    if (report.error_cycle > errors_seen_) {
        errors_seen_ = report.error_cycle;
        return fault_of(report.error);
    }
    const auto step = calibration_step(report.calibration, style_);
    return step == CalibrationStep::failed ? Fault::not_calibrated : Fault::none;
}

} // namespace hapnet::device::hdapi
