// SPDX-FileCopyrightText: 2026 The Hapnet authors
// SPDX-License-Identifier: MIT
#pragma once

#include "proto/net/clock.hpp"
#include "proto/net/udp_socket.hpp"
#include "proto/net/wait.hpp"

#include <array>
#include <chrono>
#include <string_view>
#include <vector>

namespace hapnet::net {

/// Long enough for any machine; a test that passes never waits for it.
constexpr auto patience = std::chrono::seconds{10};

inline Endpoint endpoint(std::string_view text) { return resolve(parse_host_port(text).value()); }

/// A copy of a datagram that UdpSocket::receive() keeps only until its next call.
struct Arrived {
    std::vector<std::byte> bytes;
    Endpoint from;
    base::TimePoint at;
    base::IpMarks marks{};
};

inline std::vector<Arrived> receive(UdpSocket& socket, std::size_t count)
{
    std::vector<Arrived> all;
    const auto deadline = monotonic_now() + patience;
    while (all.size() < count && monotonic_now() < deadline) {
        wait_readable(std::array{socket.descriptor()}, deadline);
        for (const Received& one : socket.receive()) {
            all.push_back({{one.bytes.begin(), one.bytes.end()}, one.from, one.at, one.marks});
        }
    }
    return all;
}

inline std::vector<std::byte> datagram(std::size_t size, int fill)
{
    return std::vector<std::byte>(size, static_cast<std::byte>(fill));
}

} // namespace hapnet::net
