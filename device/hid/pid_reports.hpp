// SPDX-FileCopyrightText: 2026 The Hapnet authors
// SPDX-License-Identifier: MIT
#pragma once

#include "device/hid/pid_layout.hpp"
#include "device/hid/report.hpp"
#include "proto/base/time.hpp"

#include <chrono>
#include <cstdint>
#include <optional>

namespace hapnet::device::hid {

/// The duration of an effect after its last start. While the host runs, it starts the effect again
/// and again. If the host dies in the middle of a push, the force ends by itself.
inline constexpr base::Duration effect_lasts = std::chrono::milliseconds{100};

/// The direction along an axis in which positive forces push. A PID direction is where a force
/// comes from, clockwise from straight ahead: a force that pushes right comes from 270 degrees, and
/// one that pushes away from the user from 180.
enum class Axis : std::uint8_t { right, away };

/// Returns the report that sets a constant force along an axis, at full gain, for effect_lasts
/// after each start. `block` must be one that the device has allocated.
[[nodiscard]] Report set_effect_report(const ForceLayout& layout, std::uint32_t block, Axis axis);
/// Returns the report that sets the level of an effect: `share` of full scale, -1 to 1.
[[nodiscard]] Report level_report(const ForceLayout& layout, std::uint32_t block, double share);
/// Returns the report that starts or stops an effect: usage::effect_start or usage::effect_stop.
[[nodiscard]] Report operation_report(const ForceLayout& layout, std::uint32_t block,
                                      Usage operation);
/// Returns the report that controls the whole device: usage::enable_actuators, disable_actuators,
/// stop_all_effects or device_reset.
[[nodiscard]] Report control_report(const ForceLayout& layout, Usage control);
/// Returns the report that sets the gain of the device to full scale; nullopt if the device has no
/// gain.
[[nodiscard]] std::optional<Report> gain_report(const ForceLayout& layout);
/// Returns the feature report that requests a block for another constant force.
[[nodiscard]] Report create_report(const ForceLayout& layout);
/// Returns the report that frees the block of an effect; nullopt if the device cannot.
[[nodiscard]] std::optional<Report> free_report(const ForceLayout& layout, std::uint32_t block);

enum class Load : std::uint8_t { success, full, error };

/// The answer in a Block Load report to the last request for an effect.
struct BlockLoadResult {
    Load load = Load::error;
    std::uint32_t block = 0; // block of the effect, after a success
};
[[nodiscard]] BlockLoadResult read_block_load(const ForceLayout& layout, const Report& report);

} // namespace hapnet::device::hid
