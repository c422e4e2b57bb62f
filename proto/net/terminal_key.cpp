// SPDX-FileCopyrightText: 2026 The Hapnet authors
// SPDX-License-Identifier: MIT
#include "proto/net/terminal_key.hpp"

#include <array>
#include <poll.h>
#include <unistd.h>

namespace hapnet::net {

TerminalKey::TerminalKey(int descriptor) : descriptor_{isatty(descriptor) != 0 ? descriptor : -1} {}

bool TerminalKey::was_pressed() const
{
    if (descriptor_ < 0 || tcgetpgrp(descriptor_) != getpgrp()) return false;
    pollfd polled{descriptor_, POLLIN, 0};
    if (poll(&polled, 1, 0) <= 0 || (polled.revents & POLLIN) == 0) return false;
    // A terminal returns one line at a time, which is available here.
    std::array<char, 256> line; // NOLINT(*-member-init): what it says does not matter
    return read(descriptor_, line.data(), line.size()) > 0;
}

} // namespace hapnet::net
