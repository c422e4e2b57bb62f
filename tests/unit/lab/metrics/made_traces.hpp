// SPDX-FileCopyrightText: 2026 The Hapnet authors
// SPDX-License-Identifier: MIT
#pragma once

#include "device/simulated/press_schedule.hpp"
#include "lab/virtual_time/play.hpp"

#include <cmath>
#include <cstddef>

namespace hapnet::lab::metrics {

/// Both sides rest and touch nothing.
[[nodiscard]] inline virtual_time::Trace resting(device::Task task, std::size_t ticks)
{
    virtual_time::Trace trace{.task = task};
    for (auto& side : trace.sides) side.resize(ticks);
    return trace;
}

/// T2 with hands that press on ideal springs, at the frequency of each press; the resting hand
/// feels the same force as the pressing one.
[[nodiscard]] inline virtual_time::Trace pressing(double left_n_per_m, double right_n_per_m)
{
    virtual_time::Trace trace = resting(device::Task::t2, 27000);
    constexpr double pi = 3.14159265358979323846;
    for (const device::PressInterval& press : device::press_schedule) {
        const std::size_t side = press.left_presses ? 0 : 1;
        const double stiffness = press.left_presses ? left_n_per_m : right_n_per_m;
        const long begin = std::lround(press.begin_s * 1e3);
        for (long i = begin; i < std::lround(press.end_s * 1e3); ++i) {
            const double turns = press.hertz * static_cast<double>(i - begin) * 1e-3;
            const double aim = 0.0035 * std::sin(2.0 * pi * turns);
            virtual_time::Sample& presser = trace.sides[side][static_cast<std::size_t>(i)];
            virtual_time::Sample& holder = trace.sides[1 - side][static_cast<std::size_t>(i)];
            presser.hip.value.x = aim;
            presser.on_hand.value.x = -0.57 - stiffness * aim;
            holder.on_hand.value.x = 0.57 + stiffness * aim;
            for (virtual_time::Sample* sample : {&presser, &holder}) {
                sample->on_body = sample->on_hand;
                sample->touching = true;
            }
        }
    }
    return trace;
}

} // namespace hapnet::lab::metrics
