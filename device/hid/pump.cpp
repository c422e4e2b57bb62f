// SPDX-FileCopyrightText: 2026 The Hapnet authors
// SPDX-License-Identifier: MIT
#include "device/hid/pump.hpp"

namespace hapnet::device::hid {

bool pump_one(Mailbox& mailbox, PidSender& sender, Wire& wire)
{
    const Order order = mailbox.order();
    auto work = sender.next(order);
    if (!work) {
        mailbox.say_done(order);
        return false;
    }
    const Moved moved =
        work->is_question ? wire.get_feature(work->report.all()) : wire.write(work->report.all());
    if (moved == Moved::gone) {
        mailbox.say_gone();
    } else if (moved != Moved::yes) {
        mailbox.count_refused();
    } else if (work->is_question) {
        mailbox.count_answered();
    } else {
        mailbox.count_sent();
    }
    return true;
}

} // namespace hapnet::device::hid
