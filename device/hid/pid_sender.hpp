// SPDX-FileCopyrightText: 2026 The Hapnet authors
// SPDX-License-Identifier: MIT
#pragma once

#include "device/hid/mailbox.hpp"
#include "device/hid/pid_layout.hpp"
#include "device/hid/report.hpp"
#include "device/hid/wire.hpp"

#include <array>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <span>
#include <vector>

namespace hapnet::device::hid {

/// Turns orders into reports, one after the other, as fast as the device takes them. Only the
/// newest order counts, however many were missed.
///
/// Each axis has an effect of its own. A tick with the motors on costs one Set Constant Force
/// report an axis, so two; every tenth starts the effects again, too. (A single effect with a
/// direction would cost two as well, Set Effect and Set Constant Force, and between them the device
/// would push the old force in the new direction.) A full-speed device takes a report every
/// millisecond at most, and so hears of each axis 450 times a second.
///
/// To stop, it says three times over: stop all effects, disable the actuators, no force on any
/// axis. Then it is silent, but for an order that wants to hear whether the device lives: then it
/// says once more that the actuators are disabled.
///
/// It only ever writes: a question (GET_REPORT) that a device leaves open holds the kernel up for 5
/// s, and with it every stop behind it.
class PidSender {
public:
    /// `blocks`: the places of the effects, an axis each.
    PidSender(const ForceLayout& layout, std::span<const std::uint32_t> blocks);

    /// The next report for this order; nullopt when all are sent.
    [[nodiscard]] std::optional<Report> next(const Order& order);

    static constexpr int ticks_per_start = 10;
    static constexpr int stops_said = 3;

private:
    enum class Step : std::uint8_t {
        enable,
        level_right,
        level_away,
        start_right,
        start_away,
        stop_all,
        disable,
        free_right,
        free_away,
    };
    static constexpr std::size_t steps_max = 16;

    void plan(const Order& order);
    void plan_push(const Order& order);
    void plan_stop(const Order& order);
    void add(Step step);
    void add_per_axis(Step right, Step away);
    [[nodiscard]] std::optional<Report> report_for(Step step, const Order& order) const;

    ForceLayout layout_;
    std::vector<std::uint32_t> blocks_;
    std::array<Step, steps_max> steps_{};
    std::size_t steps_planned_ = 0;
    std::size_t steps_done_ = 0;
    Order planned_for_{};
    int ticks_since_start_ = 0;
};

/// Sends the next report that the newest order asks for; false when nothing is left to send.
bool send_next(Mailbox& mailbox, PidSender& sender, Wire& wire);

} // namespace hapnet::device::hid
