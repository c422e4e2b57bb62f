// SPDX-FileCopyrightText: 2026 The Hapnet authors
// SPDX-License-Identifier: MIT
#pragma once

#include <string>
#include <sys/types.h>

namespace hapnet::net {

/// Throws std::system_error whose text includes the cure.
[[noreturn]] void deny_network(int error, const std::string& what);

/// Moves the process into a new network namespace. Root needs nothing else. Other users first get a
/// user namespace, in which they keep their identity and may administrate that network. Interfaces
/// created there have no automatic IPv6 address and send nothing on their own. The process must
/// have only one thread. Throws std::system_error whose text includes the cure.
void enter_own_network();

/// Moves the process into another new network namespace, for a command. Addresses are usable there
/// at once, and ping and ports below 1024 need no capability. Throws std::system_error.
void open_command_network();

/// True if a TCP socket listens, or a UDP socket is bound, in the network of that process. Also
/// false if the kernel cannot tell. Takes about 0.1 ms, while reading /proc/net/tcp would take 5
/// ms. The calling thread is briefly in that network.
[[nodiscard]] bool has_listener(pid_t process);

} // namespace hapnet::net
