// SPDX-FileCopyrightText: 2026 The Hapnet authors
// SPDX-License-Identifier: MIT
#include "device/governor/limits_text.hpp"

#include "device/falcon/kinematics.hpp"
#include "device/omni/geometry.hpp"
#include "device/simulated/keys.hpp"
#include "proto/base/ensure.hpp"
#include "proto/base/reading.hpp"

#include <array>
#include <chrono>
#include <cmath>
#include <spdlog/fmt/fmt.h>

namespace hapnet::device {

namespace {

using namespace std::chrono_literals;

// Outside of these a rule would never act, act always, or do harm: a slow slew, for one, holds a
// force that should go. Zero force and no motors are possible; --force-limit says as much as the
// first one's end.
constexpr Range peak_bounds{base::force_kind, 0.0, 40.0};
constexpr Range continuous_bounds{base::force_kind, 0.0, 1000.0};
constexpr Range slew_bounds{base::force_rate_kind, 100.0,
                            40'000.0}; // at more the peak comes in a tick
constexpr Range slew_ramping_bounds{base::force_rate_kind, 1.0, 40'000.0};
constexpr Range speed_bounds{base::speed_kind, 1e-3, 1000.0};
constexpr Range place_bounds{base::length_kind, -10.0, 10.0};
constexpr Range torque_nm_bounds{base::force_kind, 1e-6, 100.0}; // at an arm of one metre
constexpr Times fading_bounds{1ms, 1s};
constexpr Times ramping_bounds{100ms, 1min};
constexpr Times ticking_bounds{100us, 10ms};
constexpr Times stalling_bounds{2ms, 100ms};
constexpr Times failing_bounds{2ms, 1s};
constexpr Times heating_bounds{1s, 10min};
constexpr double axes_most = 3.0;

using Axes = std::array<std::optional<double>, 3>;

/// Limits as they are written: where there is none, nothing.
struct WrittenLimits {
    GovernorLimits limits;
    double axes = 3.0;
    std::optional<double> continuous_n;
    std::optional<double> speed_m_per_s;
    Axes low_m;
    Axes high_m;
    Axes omni_nm;
    Axes falcon_nm;
};

template <typename Keys, typename Written>
void list_limit_keys(Keys& keys, Written& written)
{
    auto& limits = written.limits;
    keys.value("force_max", limits.force_max_n, peak_bounds);
    keys.value("slew_max", limits.slew_max_n_per_s, slew_bounds);
    keys.value("slew_ramping", limits.slew_ramping_n_per_s, slew_ramping_bounds);
    keys.value("fade_out", limits.fade_out, fading_bounds);
    keys.value("ramp_in", limits.ramp_in, ramping_bounds);
    keys.value("tick", limits.tick, ticking_bounds);
    keys.value("stall_max", limits.stall_max, stalling_bounds);
    keys.value("fault_after", limits.fault_after, failing_bounds);
    keys.value("heat_time", limits.heat_time, heating_bounds);
    keys.value("force_continuous", written.continuous_n, continuous_bounds);
    keys.value("speed_max", written.speed_m_per_s, speed_bounds);
    keys.value("axes_out", written.axes, Plain{0.0, axes_most});
    const auto list_axes = [](auto& axes, const Range& range) {
        return [&axes, &range](auto& inner) {
            inner.value("x", axes[0], range);
            inner.value("y", axes[1], range);
            inner.value("z", axes[2], range);
        };
    };
    keys.group("workspace_min", list_axes(written.low_m, place_bounds));
    keys.group("workspace_max", list_axes(written.high_m, place_bounds));
    keys.group("omni_torque_max", list_axes(written.omni_nm, torque_nm_bounds));
    keys.group("falcon_torque_max", list_axes(written.falcon_nm, torque_nm_bounds));
}

bool has_any(const Axes& axes) { return axes[0] || axes[1] || axes[2]; }
bool has_all(const Axes& axes) { return axes[0] && axes[1] && axes[2]; }

/// What cannot be so, of what no key alone can tell; "" for nothing.
std::string_view objection_to(const WrittenLimits& written)
{
    if (written.axes != std::floor(written.axes)) return "axes_out is a whole number";
    if (has_any(written.omni_nm) && has_any(written.falcon_nm)) {
        return "omni_torque_max and falcon_torque_max: a device has but one arm";
    }
    for (const Axes& arm : {written.omni_nm, written.falcon_nm}) {
        if (has_any(arm) && !has_all(arm)) return "an arm's torque_max needs all of x, y and z";
    }
    return "";
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
    Axes& arm_nm = is_falcon ? written.falcon_nm : written.omni_nm;
    for (const int axis : {0, 1, 2}) {
        const auto i = static_cast<std::size_t>(axis);
        written.low_m[i] = unless_infinite(limits.workspace_min.value[axis]);
        written.high_m[i] = unless_infinite(limits.workspace_max.value[axis]);
        if (limits.joints) arm_nm[i] = limits.joints->torque_max_nm[axis];
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
    const auto refuse = [&](std::string_view what) {
        return base::fail(fmt::format("{}: {}", source, what));
    };
    if (const auto what = objection_to(written); !what.empty()) return refuse(what);

    GovernorLimits limits = written.limits;
    limits.axes_out = static_cast<int>(written.axes);
    if (written.continuous_n) limits.force_continuous_n = *written.continuous_n;
    if (written.speed_m_per_s) limits.speed_max_m_per_s = *written.speed_m_per_s;
    const bool is_falcon = has_all(written.falcon_nm);
    const Axes& arm_nm = is_falcon ? written.falcon_nm : written.omni_nm;
    JointLimits joints{.jacobian = is_falcon ? falcon::jacobian : omni::jacobian_at,
                       .torque_max_nm = glm::dvec3{0.0}};
    for (const int axis : {0, 1, 2}) {
        const auto i = static_cast<std::size_t>(axis);
        if (written.low_m[i]) limits.workspace_min.value[axis] = *written.low_m[i];
        if (written.high_m[i]) limits.workspace_max.value[axis] = *written.high_m[i];
        joints.torque_max_nm[axis] = arm_nm[i].value_or(0.0);
    }
    if (has_all(arm_nm)) limits.joints = joints;
    if (const auto valid = validate(limits); !valid) return refuse(valid.error().message);
    return limits;
}

} // namespace hapnet::device
