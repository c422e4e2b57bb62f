// SPDX-FileCopyrightText: 2026 The Hapnet authors
// SPDX-License-Identifier: MIT
#include "device/hid/pump.hpp"

namespace hapnet::device::hid {

bool pump_one(Mailbox& mailbox, PidSender& sender, Wire& wire)
{
    const Order order = mailbox.order();
    const auto report = sender.next(order);
    if (!report) {
        mailbox.say_done(order);
        return false;
    }
    const Moved moved = wire.write(report->all());
    if (moved == Moved::gone) {
        mailbox.say_gone();
    } else if (moved != Moved::yes) {
        mailbox.count_refused();
    } else {
        mailbox.count_sent();
    }
    return true;
}

} // namespace hapnet::device::hid
