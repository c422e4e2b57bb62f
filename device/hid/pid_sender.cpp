// SPDX-FileCopyrightText: 2026 The Hapnet authors
// SPDX-License-Identifier: MIT
#include "device/hid/pid_sender.hpp"

#include "device/hid/pid_reports.hpp"
#include "device/hid/usages.hpp"
#include "proto/base/ensure.hpp"

namespace hapnet::device::hid {

PidSender::PidSender(const ForceLayout& layout, std::span<const std::uint32_t> blocks)
    : layout_{layout}, blocks_{blocks.begin(), blocks.end()}
{
    base::ensure(!blocks.empty() && blocks.size() <= 2);
}

std::optional<Report> PidSender::next(const Order& order)
{
    const bool is_new_stop =
        !order.motors_on && (planned_for_.motors_on || order.stops != planned_for_.stops);
    const bool is_done = steps_done_ == steps_planned_;
    const bool is_new_push =
        order.motors_on && (!planned_for_.motors_on || order.stops != planned_for_.stops ||
                            (is_done && order.number != planned_for_.number));
    if (is_new_stop || is_new_push) plan(order);
    while (steps_done_ < steps_planned_) {
        if (const auto report = report_for(steps_[steps_done_++], order)) return report;
    }
    const bool probes = !order.motors_on && order.probes != planned_for_.probes;
    planned_for_.probes = order.probes;
    return probes ? report_for(Step::disable, order) : std::nullopt;
}

void PidSender::plan(const Order& order)
{
    steps_planned_ = 0;
    steps_done_ = 0;
    if (order.motors_on) {
        plan_push(order);
    } else {
        plan_stop(order);
    }
    planned_for_ = order; // the order's reports also serve as its probe
}

void PidSender::plan_push(const Order& order)
{
    const bool begins = !planned_for_.motors_on || order.stops != planned_for_.stops;
    if (begins) add(Step::enable);
    add_per_axis(Step::level_right, Step::level_away);
    if (begins || ++ticks_since_start_ >= ticks_per_start) {
        add_per_axis(Step::start_right, Step::start_away);
        ticks_since_start_ = 0;
    }
}

void PidSender::plan_stop(const Order& order)
{
    for (int i = 0; i < stops_said; ++i) {
        add(Step::stop_all);
        add(Step::disable);
        add_per_axis(Step::level_right, Step::level_away);
    }
    if (order.is_last) add_per_axis(Step::free_right, Step::free_away);
}

void PidSender::add(Step step) { steps_.at(steps_planned_++) = step; }

void PidSender::add_per_axis(Step right, Step away)
{
    add(right);
    if (blocks_.size() > 1) add(away);
}

std::optional<Report> PidSender::report_for(Step step, const Order& order) const
{
    const auto level = [&](std::size_t axis) {
        const double share = order.motors_on ? order.levels[axis] / Order::level_full : 0.0;
        return level_report(layout_, blocks_[axis], share);
    };
    switch (step) {
    case Step::enable: return control_report(layout_, usage::enable_actuators);
    case Step::level_right: return level(0);
    case Step::level_away: return level(1);
    case Step::start_right: return operation_report(layout_, blocks_[0], usage::effect_start);
    case Step::start_away: return operation_report(layout_, blocks_[1], usage::effect_start);
    case Step::stop_all: return control_report(layout_, usage::stop_all_effects);
    case Step::disable: return control_report(layout_, usage::disable_actuators);
    case Step::free_right: return free_report(layout_, blocks_[0]);
    case Step::free_away: return free_report(layout_, blocks_[1]);
    }
    return std::nullopt;
}

bool send_next(Mailbox& mailbox, PidSender& sender, Wire& wire)
{
    const Order order = mailbox.order();
    const auto report = sender.next(order);
    if (!report) {
        mailbox.say_done(order);
        return false;
    }
    const TransferResult moved = wire.write(report->all());
    if (moved == TransferResult::gone) {
        mailbox.say_gone();
    } else if (moved != TransferResult::yes) {
        mailbox.count_refused();
    } else {
        mailbox.count_sent();
    }
    return true;
}

} // namespace hapnet::device::hid
