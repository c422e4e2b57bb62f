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

/// Converts orders to reports, one after the other, as fast as the device accepts them. Only the
/// newest order counts, however many were missed.
///
/// Each axis has an effect of its own. A tick with the motors on costs one Set Constant Force
/// report for each axis, so two. Every tenth tick also starts the effects again. (A single effect
/// with a direction would also cost two, Set Effect and Set Constant Force, and between them the
/// device would push with the old force in the new direction.) A full-speed device accepts at most
/// one report in a millisecond, so each axis is updated 450 times a second.
///
/// To stop, it sends the following three times: stop all effects, disable the actuators, no force
/// on any axis. Then it sends nothing, unless an order requests a check that the device still
/// responds: then it sends once more that the actuators are disabled.
///
/// It only ever writes. If a device does not answer a request (GET_REPORT), the kernel waits for 5
/// s, and every stop has to wait, too.
class PidSender {
public:
    /// `blocks` are the blocks of the effects, one for each axis.
    PidSender(const ForceLayout& layout, std::span<const std::uint32_t> blocks);

    /// Returns the next report for this order; nullopt when all are sent.
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

/// Sends the next report that the newest order requires. Returns false when nothing is left to
/// send.
bool send_next(Mailbox& mailbox, PidSender& sender, Wire& wire);

} // namespace hapnet::device::hid
