// SPDX-FileCopyrightText: 2026 The Hapnet authors
// SPDX-License-Identifier: MIT
#pragma once

#include "device/hid/mailbox.hpp"
#include "device/hid/pid_sender.hpp"
#include "device/hid/wire.hpp"

namespace hapnet::device::hid {

/// Sends the next report that the newest order asks for; false: all is said.
bool pump_one(Mailbox& mailbox, PidSender& sender, Wire& wire);

} // namespace hapnet::device::hid
