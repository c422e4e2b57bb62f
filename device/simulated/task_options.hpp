// SPDX-FileCopyrightText: 2026 The Hapnet authors
// SPDX-License-Identifier: MIT
#pragma once

#include "proto/base/describe.hpp"
#include "proto/base/time.hpp"

#include <chrono>
#include <optional>

namespace hapnet::device {

/// The options of a task. For unset options the task's own value is used.
struct TaskOptions {
    /// T3 to T8: the force with which a hand intends to press on a cube that stays where it is; in
    /// T3, T7 and T8 that of the hands on one side together. The defaults are T3 and T7 0.57 N, T4
    /// 0.86 N, T5 0.71 N, T6 0.14 N (the resting hand), T8 0.7 N.
    std::optional<double> squeeze_n{};
    double press_depth_m = 0.004;        // T2: how far each hand aims within the cube
    double press_amplitude_m = 0.0035;   // T2: amplitude of the presser's aim
    std::optional<double> press_hertz{}; // T2: one frequency instead of 0.5, 1 and 2 Hz
    double pace = 0.5;                   // T3, T7: speed along the path; 1: as in P1 and T1
    base::Duration follower_lag{std::chrono::milliseconds{60}}; // T3, T7: delay of B behind A

    friend bool operator==(const TaskOptions&, const TaskOptions&) = default;
};
constexpr auto fields_of(base::Tag<TaskOptions> /*struct*/)
{
    constexpr base::Quantity aim{base::length_kind, 0.0, 0.02};
    return base::fields(
        "task-options",
        base::field(
            "squeeze", &TaskOptions::squeeze_n, base::Quantity{base::force_kind, 0.0, 3.3},
            "T3 to T8: force that a hand, or in T3, T7 and T8 the hands on one side, intend "
            "to press with; without it 0.571 N, 0.86 N, 0.71 N, 0.14 N, 0.571 N, 0.7 N"),
        base::field("press_depth", &TaskOptions::press_depth_m, aim,
                    "T2: how far each hand aims within the cube"),
        base::field("press_amplitude", &TaskOptions::press_amplitude_m, aim,
                    "T2: amplitude of the presser's aim"),
        base::field("press_frequency", &TaskOptions::press_hertz,
                    base::Quantity{base::frequency_kind, 0.1, 10.0},
                    "T2: one instead of 0.5, 1 and 2 Hz; intervals are cut to whole cycles"),
        base::field("pace", &TaskOptions::pace, base::Number{0.1, 2.0},
                    "T3, T7: speed along the path; 1 is that of P1 and T1"),
        base::field("follower_lag", &TaskOptions::follower_lag,
                    base::Time{base::Duration{0}, std::chrono::seconds{1}},
                    "T3, T7: of B behind A"));
}

} // namespace hapnet::device
