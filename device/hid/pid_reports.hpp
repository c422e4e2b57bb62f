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

/// An effect plays this long after its last start, so that a device whose host died in the middle
/// of a push lets go by itself; while the host lives, it starts the effect again and again.
inline constexpr base::Duration effect_lasts = std::chrono::milliseconds{100};

/// The way along an axis that positive forces push. A PID direction is where a force comes from,
/// clockwise from straight ahead: what pushes right comes from 270 degrees, what pushes away from
/// the user from 180.
enum class Axis : std::uint8_t { right, away };

/// A constant force along an axis, at full gain, for effect_lasts after each start. The place has
/// to be one that the device gave.
[[nodiscard]] Report set_effect_report(const ForceLayout& layout, std::uint32_t block, Axis axis);
/// Sets the level of an effect: `share` of full scale, -1 to 1.
[[nodiscard]] Report level_report(const ForceLayout& layout, std::uint32_t block, double share);
/// Starts or stops an effect: usage::effect_start or usage::effect_stop.
[[nodiscard]] Report operation_report(const ForceLayout& layout, std::uint32_t block,
                                      Usage operation);
/// Controls the whole device: usage::enable_actuators, disable_actuators, stop_all_effects or
/// device_reset.
[[nodiscard]] Report control_report(const ForceLayout& layout, Usage control);
/// Sets the gain of the device to full scale; nullopt where the device has no gain.
[[nodiscard]] std::optional<Report> gain_report(const ForceLayout& layout);
/// A feature report that asks for a place for another constant force.
[[nodiscard]] Report create_report(const ForceLayout& layout);
/// Gives the place of an effect back; nullopt where the device cannot.
[[nodiscard]] std::optional<Report> free_report(const ForceLayout& layout, std::uint32_t block);

enum class Load : std::uint8_t { success, full, error };

/// The answer in a Block Load report to the last request for an effect.
struct BlockLoadResult {
    Load load = Load::error;
    std::uint32_t block = 0; // place of the effect, after a success
};
[[nodiscard]] BlockLoadResult read_block_load(const ForceLayout& layout, const Report& report);

} // namespace hapnet::device::hid
