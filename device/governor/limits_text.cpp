// SPDX-FileCopyrightText: 2026 The Hapnet authors
// SPDX-License-Identifier: MIT
#include "device/governor/limits_text.hpp"

#include "proto/base/ensure.hpp"
#include "proto/base/fields.hpp"

#include <cmath>
#include <spdlog/fmt/fmt.h>

namespace hapnet::device {

namespace {

/// A corner of the workspace, with the coordinates that are limited.
struct WrittenCorner {
    std::optional<double> x_m{};
    std::optional<double> y_m{};
    std::optional<double> z_m{};
};
constexpr auto fields_of(base::Tag<WrittenCorner> /*struct*/)
{
    constexpr base::Quantity place{base::length_kind, -10.0, 10.0};
    return base::fields("corner", base::field("x", &WrittenCorner::x_m, place, "x"),
                        base::field("y", &WrittenCorner::y_m, place, "y"),
                        base::field("z", &WrittenCorner::z_m, place, "z"));
}

/// The torques of an arm's joints, written as forces at an arm of one metre.
struct WrittenTorques {
    std::optional<double> x_nm{};
    std::optional<double> y_nm{};
    std::optional<double> z_nm{};
};
constexpr auto fields_of(base::Tag<WrittenTorques> /*struct*/)
{
    constexpr base::Quantity torque{base::force_kind, 1e-6, 100.0};
    return base::fields("torques", base::field("x", &WrittenTorques::x_nm, torque, "first joint"),
                        base::field("y", &WrittenTorques::y_nm, torque, "second joint"),
                        base::field("z", &WrittenTorques::z_nm, torque, "third joint"));
}

/// Limits in the form of the text, without infinite ones.
struct WrittenLimits {
    GovernorLimits limits{};
    std::optional<double> continuous_n{};
    std::optional<double> speed_m_per_s{};
    double axes = 3.0;
    WrittenCorner low{};
    WrittenCorner high{};
};
constexpr auto fields_of(base::Tag<WrittenLimits> /*struct*/)
{
    return base::fields(
        "limits", base::part(&WrittenLimits::limits),
        base::field("force_continuous", &WrittenLimits::continuous_n,
                    base::Quantity{base::force_kind, 0.0, 1000.0},
                    "force that the motors sustain; without it they do not warm up"),
        base::field(
            "speed_max", &WrittenLimits::speed_m_per_s,
            base::Quantity{base::speed_kind, 1e-3, 1000.0},
            "speed beyond which a sample is not believed; without it any speed is possible"),
        base::field("axes_out", &WrittenLimits::axes, base::Number{0.0, 3.0},
                    "whole number of axes with a motor, in the order x, y, z; 0: no motors"),
        base::field("workspace_min", &WrittenLimits::low, "lower corner of the workspace"),
        base::field("workspace_max", &WrittenLimits::high, "upper corner of the workspace"));
}

std::optional<double> unless_infinite(double value)
{
    if (std::isinf(value)) return std::nullopt;
    return value;
}

WrittenCorner written(const base::Position& corner)
{
    return {unless_infinite(corner.x()), unless_infinite(corner.y()), unless_infinite(corner.z())};
}

/// Returns the corner with the written coordinates. Missing ones stay infinite.
base::Position read_corner(const WrittenCorner& corner, const base::Position& infinite)
{
    return {{corner.x_m.value_or(infinite.x()), corner.y_m.value_or(infinite.y()),
             corner.z_m.value_or(infinite.z())}};
}

/// Returns the joints' limits in the table, or an error text when there are several mechanisms or a
/// value is missing.
base::Result<std::optional<JointLimits>> read_joints(base::TableReader& table,
                                                     std::span<const Mechanism> mechanisms)
{
    std::optional<JointLimits> joints;
    for (const Mechanism& mechanism : mechanisms) {
        const base::Node* node = table.find(mechanism.torque_key);
        if (node == nullptr) continue;
        WrittenTorques torques;
        base::read_table(*node, torques, table.reading());
        if (!table.reading().is_good()) return joints;
        const auto& [x, y, z] = torques;
        if (!x && !y && !z) continue;
        if (!x || !y || !z) {
            return base::fail(fmt::format("{} needs all of x, y and z", mechanism.torque_key));
        }
        if (joints) {
            return base::fail(fmt::format("{} and {}: a device has only one arm",
                                          joints->mechanism.torque_key, mechanism.torque_key));
        }
        joints = JointLimits{mechanism, {*x, *y, *z}};
    }
    return joints;
}

} // namespace

std::vector<base::KeyRow> limit_keys() { return base::key_rows<WrittenLimits>(); }

std::string print_limits(const GovernorLimits& limits)
{
    std::string text =
        base::field_lines(WrittenLimits{.limits = limits,
                                        .continuous_n = unless_infinite(limits.force_continuous_n),
                                        .speed_m_per_s = unless_infinite(limits.speed_max_m_per_s),
                                        .axes = static_cast<double>(limits.axes_out),
                                        .low = written(limits.workspace_min),
                                        .high = written(limits.workspace_max)});
    if (limits.joints) {
        const auto& [mechanism, torque] = *limits.joints;
        base::ensure(!mechanism.torque_key.empty());
        text += base::field_lines(WrittenTorques{torque.x, torque.y, torque.z},
                                  std::string{mechanism.torque_key} + '.');
    }
    return text;
}

base::Result<GovernorLimits> parse_limits(std::string_view text, const std::string& source,
                                          std::span<const Mechanism> mechanisms)
{
    base::Reading reading{source};
    const auto document = base::parse_document(text);
    if (!document) {
        reading.complain(document.error().place, document.error().message);
        return base::fail(*reading.complaint());
    }
    WrittenLimits written;
    const auto* entries = std::get_if<base::Node::Table>(&document->value);
    if (entries == nullptr) return base::fail(source + ": expected a table");
    base::TableReader table{*entries, document->place, reading};
    base::read_fields(table, written);
    const auto joints = read_joints(table, mechanisms);
    table.finish();
    if (!reading.is_good()) return base::fail(*reading.complaint());
    const auto refuse = [&](std::string_view what) {
        return base::fail(fmt::format("{}: {}", source, what));
    };
    if (!joints) return refuse(joints.error().message);
    if (written.axes != std::floor(written.axes)) return refuse("axes_out must be a whole number");

    GovernorLimits limits = written.limits;
    limits.axes_out = static_cast<int>(written.axes);
    if (written.continuous_n) limits.force_continuous_n = *written.continuous_n;
    if (written.speed_m_per_s) limits.speed_max_m_per_s = *written.speed_m_per_s;
    limits.workspace_min = read_corner(written.low, limits.workspace_min);
    limits.workspace_max = read_corner(written.high, limits.workspace_max);
    limits.joints = *joints;
    if (const auto valid = validate(limits); !valid) return refuse(valid.error().message);
    return limits;
}

} // namespace hapnet::device
