// SPDX-FileCopyrightText: 2026 The Hapnet authors
// SPDX-License-Identifier: MIT
#include "device/governor/limits_text.hpp"

#include "device/falcon/kinematics.hpp"
#include "device/omni/geometry.hpp"
#include "device/simulated/keys.hpp"
#include "proto/base/ensure.hpp"
#include "proto/base/reading.hpp"

#include <array>
#include <cmath>

namespace hapnet::device {

namespace {

constexpr Range any_force{base::force_kind, 0.0, 1e6};
constexpr Range any_slew{base::force_rate_kind, 0.0, 1e9};
constexpr Range any_speed{base::speed_kind, 0.0, 1e6};
constexpr Range any_place{base::length_kind, -1e6, 1e6};
constexpr Range any_torque_nm{base::force_kind, 0.0, 1e6}; // at an arm of one metre
constexpr Plain axes_possible{0.0, 3.0};
constexpr base::Duration any_time{std::chrono::hours{1}};

/// Limits as they are written: where there is none, nothing.
struct WrittenLimits {
    GovernorLimits limits;
    double axes = 3.0;
    std::optional<double> continuous_n;
    std::optional<double> speed_m_per_s;
    std::array<std::optional<double>, 3> low_m;
    std::array<std::optional<double>, 3> high_m;
    std::array<std::optional<double>, 3> omni_nm;
    std::array<std::optional<double>, 3> falcon_nm;
};

template <typename Keys, typename Written>
void list_limit_keys(Keys& keys, Written& written)
{
    auto& limits = written.limits;
    keys.value("force_max", limits.force_max_n, any_force);
    keys.value("slew_max", limits.slew_max_n_per_s, any_slew);
    keys.value("slew_ramping", limits.slew_ramping_n_per_s, any_slew);
    keys.value("fade_out", limits.fade_out, any_time);
    keys.value("ramp_in", limits.ramp_in, any_time);
    keys.value("tick", limits.tick, any_time);
    keys.value("stall_max", limits.stall_max, any_time);
    keys.value("fault_after", limits.fault_after, any_time);
    keys.value("heat_time", limits.heat_time, any_time);
    keys.value("force_continuous", written.continuous_n, any_force);
    keys.value("speed_max", written.speed_m_per_s, any_speed);
    keys.value("axes_out", written.axes, axes_possible);
    const auto list_axes = [](auto& axes, const Range& range) {
        return [&axes, &range](auto& inner) {
            inner.value("x", axes[0], range);
            inner.value("y", axes[1], range);
            inner.value("z", axes[2], range);
        };
    };
    keys.group("workspace_min", list_axes(written.low_m, any_place));
    keys.group("workspace_max", list_axes(written.high_m, any_place));
    keys.group("omni_torque_max", list_axes(written.omni_nm, any_torque_nm));
    keys.group("falcon_torque_max", list_axes(written.falcon_nm, any_torque_nm));
}

std::optional<double> unless_infinite(double value)
{
    if (std::isinf(value)) return std::nullopt;
    return value;
}

} // namespace

std::string print_limits(const GovernorLimits& limits)
{
    WrittenLimits written{.limits = limits,
                          .axes = static_cast<double>(limits.axes_out),
                          .continuous_n = unless_infinite(limits.force_continuous_n),
                          .speed_m_per_s = unless_infinite(limits.speed_max_m_per_s),
                          .low_m = {},
                          .high_m = {},
                          .omni_nm = {},
                          .falcon_nm = {}};
    const bool is_falcon = limits.joints && limits.joints->jacobian == falcon::jacobian;
    base::ensure(is_falcon || !limits.joints || limits.joints->jacobian == omni::jacobian_at);
    auto& torque_nm = is_falcon ? written.falcon_nm : written.omni_nm;
    for (const int axis : {0, 1, 2}) {
        const auto i = static_cast<std::size_t>(axis);
        written.low_m[i] = unless_infinite(limits.workspace_min.value[axis]);
        written.high_m[i] = unless_infinite(limits.workspace_max.value[axis]);
        if (limits.joints) torque_nm[i] = limits.joints->torque_max_nm[axis];
    }
    KeyPrinter keys;
    list_limit_keys(keys, std::as_const(written));
    return keys.text();
}

base::Result<GovernorLimits> parse_limits(std::string_view text, const std::string& source)
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
    KeyReader keys{table};
    list_limit_keys(keys, written);
    table.finish();
    if (!reading.is_good()) return base::fail(*reading.complaint());

    GovernorLimits limits = written.limits;
    limits.axes_out = static_cast<int>(written.axes);
    if (written.continuous_n) limits.force_continuous_n = *written.continuous_n;
    if (written.speed_m_per_s) limits.speed_max_m_per_s = *written.speed_m_per_s;
    const bool is_falcon = written.falcon_nm[0].has_value();
    const auto& torque_nm = is_falcon ? written.falcon_nm : written.omni_nm;
    JointLimits joints{.jacobian = is_falcon ? falcon::jacobian : omni::jacobian_at,
                       .torque_max_nm = glm::dvec3{0.0}};
    for (const int axis : {0, 1, 2}) {
        const auto i = static_cast<std::size_t>(axis);
        if (written.low_m[i]) limits.workspace_min.value[axis] = *written.low_m[i];
        if (written.high_m[i]) limits.workspace_max.value[axis] = *written.high_m[i];
        joints.torque_max_nm[axis] = torque_nm[i].value_or(0.0);
    }
    if (torque_nm[0]) limits.joints = joints;
    return limits;
}

} // namespace hapnet::device
