// SPDX-FileCopyrightText: 2026 The Hapnet authors
// SPDX-License-Identifier: MIT
#include "device/hdapi/mapping.hpp"

#include "device/hdapi/library.hpp"

#include <algorithm>
#include <spdlog/fmt/fmt.h>

namespace hapnet::device::hdapi {

namespace {

// An Omni's data sheet.
constexpr double omni_continuous_n = 0.88;
constexpr double omni_resolution_m = 0.000055;
// From CHAI3D's table of devices: a Touch's figures, which are less than an Omni's 700 and 5.
constexpr double touch_stiffness_n_per_m = 400.0;
constexpr double touch_damping_ns_per_m = 4.0;

// The permitted length of an axis of a workspace. The scene's size follows from it, and from that
// the stiffness at the hand.
constexpr double axis_min_mm = 10.0;
constexpr double axis_max_mm = 10000.0;

// The permitted range of a device's figures, in the library's units.
constexpr double figure_min = 1e-6;
constexpr double figure_max = 1e6;

bool is_sensible(double value) { return value > figure_min && value < figure_max; }
double sensible(double value, double otherwise) { return is_sensible(value) ? value : otherwise; }

} // namespace

Fault fault_of(unsigned int code)
{
    switch (code) {
    case error::none: return Fault::none;
    case error::warm_motors: return Fault::overheat;
    case error::force_too_large:
    case error::impulse_too_large:
    case error::force_error: return Fault::over_force;
    case error::velocity_too_large: return Fault::over_velocity;
    case error::already_open: return Fault::in_use;
    case error::device_fault:
    case error::communication:
    case error::communication_set_up: return Fault::communication;
    case error::timer: return Fault::timeout;
    default: return Fault::internal;
    }
}

CalibrationStep calibration_step(unsigned int status, int style)
{
    if (status == calibration::done) return CalibrationStep::done;
    if (style == calibration::style_encoder_reset) return CalibrationStep::failed;
    switch (status) {
    case calibration::needs_update:
        return style == calibration::style_inkwell ? CalibrationStep::dock_stylus
                                                   : CalibrationStep::busy;
    case calibration::needs_person: return CalibrationStep::dock_stylus;
    default: return CalibrationStep::failed;
    }
}

int preferred_style(int styles)
{
    for (const int style : {calibration::style_inkwell, calibration::style_automatic}) {
        if ((styles & style) != 0) return style;
    }
    return calibration::style_encoder_reset;
}

Capabilities capabilities_of(const Properties& properties)
{
    Capabilities can;
    for (const int axis : {0, 1, 2}) {
        const auto i = static_cast<std::size_t>(axis);
        const double least = properties.workspace_mm[i];
        const double most = properties.workspace_mm[i + 3];
        const double length = most - least; // NaN if one of the two is NaN
        if (!(length >= axis_min_mm && length <= axis_max_mm)) continue;
        can.workspace_min.value[axis] = 1e-3 * least;
        can.workspace_max.value[axis] = 1e-3 * most;
    }
    can.force_max_n = sensible(properties.force_max_n, omni_continuous_n);
    can.force_continuous_n =
        std::min(sensible(properties.force_continuous_n, omni_continuous_n), can.force_max_n);
    can.stiffness_max_n_per_m =
        1e3 * sensible(properties.stiffness_max_n_per_mm, 1e-3 * touch_stiffness_n_per_m);
    can.damping_max_ns_per_m =
        1e3 * sensible(properties.damping_max_ns_per_mm, 1e-3 * touch_damping_ns_per_m);
    can.speed_max_m_per_s = 1e-3 * sensible(properties.velocity_limit_mm_per_s, 1000.0);
    can.rate_hz = sensible(properties.update_rate_hz, 1000.0);
    can.resolution_m = omni_resolution_m;
    can.buttons = 2;
    can.has_holder = (properties.calibration_styles & calibration::style_inkwell) != 0;
    can.pacing = Pacing::device;
    return can;
}

std::string text_of(const char* text)
{
    std::string shown;
    for (; text != nullptr && *text != '\0' && shown.size() < text_bytes_max; ++text) {
        shown += *text >= ' ' && *text <= '~' ? *text : '?';
    }
    return shown;
}

std::string describe_error(const std::string& name, unsigned int code, const std::string& said)
{
    const std::string which =
        name.empty() ? "no default device" : fmt::format("no device '{}'", name);
    if (fault_of(code) == Fault::in_use) {
        return fmt::format("libHD: another program or session uses {} (error 0x{:x}: {}): end that "
                           "one first",
                           name.empty() ? "the default device" : name, code, said);
    }
    return fmt::format(
        "libHD finds {} (error 0x{:x}: {}): is it connected and powered, may you use its port "
        "(/dev/ttyACM*: see hapnet-peer doctor), and has the vendor's set-up "
        "(Touch_HeadlessSetup, or Touch_Setup with a screen) given it this name? Usual names are "
        "'Default Device' and, with older drivers, 'Default PHANToM': --device 'hdapi:Default "
        "Device'",
        which, code, said);
}

} // namespace hapnet::device::hdapi
