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

/// The fault for one of the library's error codes.
[[nodiscard]] Fault fault_of(unsigned int code);

/// The calibration step that the library's report asks for, with this style. A Touch has been seen
/// to need an update from its start on, wherever its stylus was: only the inkwell ends that.
/// Encoders are not reset from here: that failed.
[[nodiscard]] CalibrationStep calibration_step(unsigned int status, int style);

/// Returns the calibration style to use among the styles of a device: inkwell before automatic
/// before encoder reset, as the first needs no care by the person. Without a known style: the last.
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
/// those that make no sense; the peak force is then only an Omni's continuous force.
[[nodiscard]] Capabilities capabilities_of(const Properties& properties);

inline constexpr std::size_t text_bytes_max = 200;
/// A text of the library's as it may be shown and stored: "" for null, at most text_bytes_max
/// characters, and in place of every one that is not printable ASCII a question mark.
[[nodiscard]] std::string text_of(const char* text);

/// An error text for a device that does not open, with what to do. `name` is as in the vendor's
/// configuration, "" for the default one; `said` is the library's own text for `code`.
[[nodiscard]] std::string describe_error(const std::string& name, unsigned int code,
                                         const std::string& said);

} // namespace hapnet::device::hdapi
