// SPDX-FileCopyrightText: 2026 The Hapnet authors
// SPDX-License-Identifier: MIT
#pragma once

#include "device/capabilities.hpp"
#include "device/device.hpp"

#include <array>
#include <cstddef>
#include <cstdint>
#include <string>

namespace hapnet::device::hdapi {

/// Returns the fault for one of the library's error codes.
[[nodiscard]] Fault fault_of(unsigned int code);

/// Returns the calibration step that the library's report requires, with this style. A Touch was
/// observed to need an update from its start on, wherever its stylus was: only the inkwell ends
/// that. This program does not reset encoders, because that failed.
[[nodiscard]] CalibrationStep calibration_step(unsigned int status, int style);

/// Returns the calibration style to use among the styles of a device: inkwell before automatic
/// before encoder reset, because the inkwell requires no care of the person. Without a known style:
/// the last one.
[[nodiscard]] int preferred_style(int styles);

/// The abilities of a device as the library states them, in its own units.
struct Properties {
    std::array<double, 6> workspace_mm{};
    double force_max_n = 0.0;
    double force_continuous_n = 0.0;
    double stiffness_max_n_per_mm = 0.0;
    double damping_max_ns_per_mm = 0.0;
    double velocity_limit_mm_per_s = 0.0;
    int update_rate_hz = 0;
    int calibration_styles = 0;
};

/// Returns the abilities in SI units. Values from data sheets of the Omni and the Touch replace
/// implausible ones; the peak force is then only an Omni's continuous force.
[[nodiscard]] Capabilities capabilities_of(const Properties& properties);

inline constexpr std::size_t text_bytes_max = 200;
/// Returns a text of the library that is safe to show and store: "" for null, at most
/// text_bytes_max characters, with a question mark in place of each character that is not printable
/// ASCII.
[[nodiscard]] std::string text_of(const char* text);

/// Returns an error text for a device that does not open, with what to do. `name` is as in the
/// vendor's configuration, "" for the default one; `said` is the library's own text for `code`.
[[nodiscard]] std::string describe_error(const std::string& name, unsigned int code,
                                         const std::string& said);

} // namespace hapnet::device::hdapi
