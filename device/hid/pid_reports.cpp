// SPDX-FileCopyrightText: 2026 The Hapnet authors
// SPDX-License-Identifier: MIT
#include "device/hid/pid_reports.hpp"

#include "device/hid/field.hpp"
#include "device/hid/usages.hpp"

#include <algorithm>
#include <cmath>

namespace hapnet::device::hid {

namespace {

constexpr std::uint32_t si_seconds = 0x1001; // a unit code of USB HID 1.11, section 6.2.2.7
constexpr std::uint32_t english_seconds = 0x1003;

void select(const Selector& selector, Usage choice, std::span<std::byte> data)
{
    for (const Field& field : selector.fields) {
        if (const auto value = value_of(field, choice)) {
            pack(field, *value, data);
            return;
        }
    }
    for (const Field& field : selector.fields) {
        if (!field.is_array) pack_bits(field, is_variable_of(field, choice) ? 1 : 0, data);
    }
}

bool is_selected(const Selector& selector, Usage choice, std::span<const std::byte> data)
{
    return std::any_of(selector.fields.begin(), selector.fields.end(), [&](const Field& field) {
        const auto value = unpack(field, data);
        if (!value) return false;
        if (field.is_array) return value == value_of(field, choice);
        return is_variable_of(field, choice) && *value != 0;
    });
}

void pack_limited(const Field& field, std::int64_t value, std::span<std::byte> data)
{
    pack(field, std::clamp(value, field.logical_min, field.logical_max), data);
}

/// Returns a time in the field's own steps. If the field has no unit of time, the steps are
/// milliseconds, as devices without a unit mean.
std::int64_t steps_of(const Field& field, base::Duration time)
{
    const bool has_unit = field.unit == si_seconds || field.unit == english_seconds;
    const int exponent = has_unit ? field.unit_exponent : -3;
    const double physical = base::to_seconds(time) / std::pow(10.0, exponent);
    const auto physical_range = static_cast<double>(field.physical_max - field.physical_min);
    const auto logical_range = static_cast<double>(field.logical_max - field.logical_min);
    if (physical_range <= 0.0) return std::llround(std::min(physical, logical_range));
    const double share = (physical - static_cast<double>(field.physical_min)) / physical_range;
    return field.logical_min + std::llround(std::clamp(share, 0.0, 1.0) * logical_range);
}

/// Returns a share of a full turn.
std::int64_t angle(const Field& field, double turns)
{
    const auto range = static_cast<double>(field.logical_max - field.logical_min);
    return field.logical_min + std::llround(turns * range);
}

} // namespace

Report set_effect_report(const ForceLayout& layout, std::uint32_t block, Axis axis)
{
    const ForceLayout::SetEffect& place = layout.set_effect;
    Report report{place.place};
    pack_bits(place.block, block, report.data());
    select(place.type, usage::constant_force, report.data());
    pack_limited(place.duration, steps_of(place.duration, effect_lasts), report.data());
    if (place.gain) pack(*place.gain, place.gain->logical_max, report.data());
    pack_bits(place.direction_enable, 1, report.data());
    pack(place.direction, angle(place.direction, axis == Axis::right ? 0.75 : 0.5), report.data());
    return report;
}

Report level_report(const ForceLayout& layout, std::uint32_t block, double share)
{
    const ForceLayout::SetConstantForce& place = layout.set_constant_force;
    Report report{place.place};
    pack_bits(place.block, block, report.data());
    pack(place.magnitude, scaled(place.magnitude, share), report.data());
    return report;
}

Report operation_report(const ForceLayout& layout, std::uint32_t block, Usage operation)
{
    const ForceLayout::Operation& place = layout.operation;
    Report report{place.place};
    pack_bits(place.block, block, report.data());
    select(place.operation, operation, report.data());
    if (place.loop_count) pack_limited(*place.loop_count, 1, report.data());
    return report;
}

Report control_report(const ForceLayout& layout, Usage control)
{
    Report report{layout.control.place};
    select(layout.control.control, control, report.data());
    return report;
}

std::optional<Report> gain_report(const ForceLayout& layout)
{
    if (!layout.device_gain) return std::nullopt;
    Report report{layout.device_gain->place};
    pack(layout.device_gain->gain, layout.device_gain->gain.logical_max, report.data());
    return report;
}

Report create_report(const ForceLayout& layout)
{
    Report report{layout.create.place};
    select(layout.create.type, usage::constant_force, report.data());
    return report;
}

std::optional<Report> free_report(const ForceLayout& layout, std::uint32_t block)
{
    if (!layout.block_free) return std::nullopt;
    Report report{layout.block_free->place};
    pack_bits(layout.block_free->block, block, report.data());
    return report;
}

BlockLoadResult read_block_load(const ForceLayout& layout, const Report& report)
{
    const ForceLayout::BlockLoad& place = layout.block_load;
    if (is_selected(place.status, usage::load_full, report.data())) return {.load = Load::full};
    const auto block = unpack(place.block, report.data());
    if (!is_selected(place.status, usage::load_success, report.data()) || !block || *block < 1) {
        return {.load = Load::error};
    }
    return {.load = Load::success, .block = static_cast<std::uint32_t>(*block)};
}

} // namespace hapnet::device::hid
