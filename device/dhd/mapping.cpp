// SPDX-FileCopyrightText: 2026 The Hapnet authors
// SPDX-License-Identifier: MIT
#include "device/dhd/mapping.hpp"

#include <spdlog/fmt/fmt.h>

namespace hapnet::device::dhd {

namespace {

// An Omni's data sheet, and its stiffness in CHAI3D's table of devices.
constexpr double omni_force_n = 3.3;
constexpr double omni_continuous_n = 0.88;
constexpr double omni_stiffness_n_per_m = 700.0;
constexpr double half_edge_m = 0.04;

bool is_of_the_line(Fault fault)
{
    return fault == Fault::communication || fault == Fault::timeout ||
           fault == Fault::disconnected || fault == Fault::not_found;
}

} // namespace

Fault fault_of(int code)
{
    switch (code) {
    case error::none: return Fault::none;
    case error::communication:
    case error::redundancy_failed: return Fault::communication;
    case error::busy:
    case error::in_use: return Fault::in_use;
    case error::no_driver: return Fault::permission;
    case error::no_device:
    case error::not_available: return Fault::not_found;
    case error::timeout: return Fault::timeout;
    case error::not_ready: return Fault::not_calibrated;
    default: return Fault::internal;
    }
}

Capabilities capabilities()
{
    Capabilities can;
    can.workspace_min.value = glm::dvec3{-half_edge_m};
    can.workspace_max.value = glm::dvec3{half_edge_m};
    can.force_max_n = omni_force_n;
    can.force_continuous_n = omni_continuous_n;
    can.stiffness_max_n_per_m = omni_stiffness_n_per_m;
    can.resolution_m = 5.5e-5; // resolution of an Omni; that of these devices is finer
    can.speed_max_m_per_s = 1.0;
    return can;
}

polled::Report Interpreter::report_of(const Reading& reading, bool wants_force)
{
    polled::Report report;
    if (reading.result < 0) {
        report.fault = fault_of(reading.error);
        if (report.fault == Fault::none) report.fault = Fault::internal;
        failures_ = is_of_the_line(report.fault) ? failures_ + 1 : 0;
        if (failures_ >= gone_after) report.fault = Fault::disconnected;
        had_force_ = false;
        return report;
    }
    failures_ = 0;
    report.hip.value = from_library(reading.position);
    report.velocity.value = from_library(reading.velocity);
    report.buttons = reading.buttons;
    report.calibrated = reading.status[status::needs_calibration] == 0;
    report.fault = fault_of_status(reading.status, wants_force);
    return report;
}

Fault Interpreter::fault_of_status(const Status& status, bool wants_force)
{
    const bool has_force = status[status::force] != 0;
    const bool lost_force = had_force_ && wants_force && !has_force;
    had_force_ = has_force && wants_force;
    if (status[status::connected] == 0 || status[status::power] == 0) return Fault::disconnected;
    if (status[status::error] != 0) return Fault::internal;
    if (lost_force && status[status::force_off_cause] == force_off::velocity) {
        return Fault::over_velocity;
    }
    return Fault::none;
}

std::string describe_error(const std::string& serial, int code)
{
    const std::string which = serial.empty() ? "no device" : fmt::format("no device {}", serial);
    if (fault_of(code) == Fault::in_use) {
        return fmt::format("libdhd: another program uses the device (error {}): end that one first",
                           code);
    }
    return fmt::format("libdhd finds {} (error {}): is it connected and powered, and may you use "
                       "its USB port (see hapnet-peer doctor)?",
                       which, code);
}

} // namespace hapnet::device::dhd
