// SPDX-FileCopyrightText: 2026 The Hapnet authors
// SPDX-License-Identifier: MIT
#pragma once

#include "device/hid/descriptor.hpp"
#include "proto/base/result.hpp"

#include <cstddef>
#include <cstdint>
#include <optional>
#include <vector>

namespace hapnet::device::hid {

/// The place and the length of a report.
struct ReportPlace {
    std::uint8_t id = 0;   // 0: reports have no ID
    std::size_t bytes = 0; // length without the ID
};

/// The report with the position of the grip.
struct InputLayout {
    ReportPlace place{};
    std::vector<Field> axes{};    // X, and Y if effects can act on it
    std::vector<Field> buttons{}; // the first eight buttons
};

/// Fields that select one of several things: the value of an array, or a bit for each.
struct Selector {
    std::vector<Field> fields{}; // all in one report
};

/// The positions in its reports at which a PID device expects the parts of a constant force: USB
/// Device Class Definition for Physical Interface Devices 1.0. Report IDs and positions differ from
/// device to device.
struct ForceLayout {
    struct SetEffect {
        ReportPlace place{};
        Field block{};
        Selector type{};
        Field duration{};
        std::optional<Field> gain{};
        Field direction_enable{};
        Field direction{}; // the first direction: an angle
    } set_effect{};
    struct SetConstantForce {
        ReportPlace place{};
        Field block{};
        Field magnitude{};
    } set_constant_force{};
    struct Operation {
        ReportPlace place{};
        Field block{};
        Selector operation{};
        std::optional<Field> loop_count{};
    } operation{};
    struct Control {
        ReportPlace place{};
        Selector control{};
    } control{};
    struct DeviceGain {
        ReportPlace place{};
        Field gain{};
    };
    std::optional<DeviceGain> device_gain{};
    struct Create { // a feature report
        ReportPlace place{};
        Selector type{};
    } create{};
    struct BlockLoad { // a feature report
        ReportPlace place{};
        Field block{};
        Selector status{};
    } block_load{};
    struct BlockFree {
        ReportPlace place{};
        Field block{};
    };
    std::optional<BlockFree> block_free{};
};

/// The greatest length of a report that a full-speed interrupt pipe transfers at once, with its ID.
inline constexpr std::size_t report_bytes_max = 64;

/// True if the device supports usage page 0x0f: it has a Set Effect report.
[[nodiscard]] bool is_force_device(const Descriptor& descriptor);
/// Returns the report with the axis X, or the error that says why no report fits. An axis Y counts
/// only if effects can act on it: on a steering wheel it is a pedal.
[[nodiscard]] base::Result<InputLayout> find_input(const Descriptor& descriptor);
/// Returns all parts of the layout that a constant force needs, or the error that names a missing
/// part.
[[nodiscard]] base::Result<ForceLayout> find_force(const Descriptor& descriptor);

} // namespace hapnet::device::hid
