// SPDX-FileCopyrightText: 2026 The Hapnet authors
// SPDX-License-Identifier: MIT
#pragma once

#include <string>
#include <sys/types.h>

namespace hapnet::net {

/// Throws std::system_error whose text has named the cure.
[[noreturn]] void deny_network(int error, const std::string& what);

/// Moves the process into a network namespace of its own. Root does it as root; others get a user
/// namespace first, in which they are themselves and may administrate that network. Interfaces made
/// there have no IPv6 address of their own accord, and say nothing. The process must have one
/// thread. Throws std::system_error whose text names the cure.
void enter_own_network();

/// Moves the process into one more network namespace, that of a command: its addresses are usable
/// at once, and ping and the ports below 1024 need no capability there. Throws std::system_error.
void open_command_network();

/// True if a TCP socket listens, or a UDP socket is bound, in the network of that process. False,
/// too, where the kernel cannot tell. Takes some 0.1 ms, as /proc/net/tcp would take 5 ms; the
/// calling thread is in that network for a moment.
[[nodiscard]] bool has_listener(pid_t process);

} // namespace hapnet::net
