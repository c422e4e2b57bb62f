// SPDX-FileCopyrightText: 2026 The Hapnet authors
// SPDX-License-Identifier: MIT
#pragma once

#include <netinet/in.h>
#include <sys/socket.h>
#include <unistd.h>

namespace hapnet::test {

/// True if programs here can use ::1. Where it is false, tests that need it are skipped for the
/// reason "no IPv6 here".
inline bool has_ipv6()
{
    const int descriptor = socket(AF_INET6, SOCK_DGRAM | SOCK_CLOEXEC, 0);
    if (descriptor < 0) return false;
    sockaddr_in6 loopback{};
    loopback.sin6_family = AF_INET6;
    loopback.sin6_addr = in6addr_loopback;
    const bool is_bound =
        bind(descriptor, reinterpret_cast<const sockaddr*>(&loopback), sizeof loopback) == 0;
    close(descriptor);
    return is_bound;
}

} // namespace hapnet::test
