// SPDX-FileCopyrightText: 2026 The Hapnet authors
// SPDX-License-Identifier: MIT
#pragma once

#include "proto/base/time.hpp"
#include "proto/net/endpoint.hpp"
#include "proto/net/udp_socket.hpp"

#include <chrono>
#include <cstddef>
#include <cstdint>
#include <string_view>
#include <vector>

namespace hapnet::e2e {

/// The endpoint that a "ready" line names under `key`: "a=127.0.0.1:40001".
[[nodiscard]] net::Endpoint endpoint_in(std::string_view ready_line, std::string_view key);

/// The endpoint of "127.0.0.1:7001" or "[::1]:0".
[[nodiscard]] net::Endpoint endpoint_of(std::string_view text);

/// A numbered datagram that has come back.
struct Arrival {
    std::uint64_t number = 0;
    base::Duration delay{}; // from before its send call to the kernel's receive stamp
};

[[nodiscard]] std::vector<std::uint64_t> numbers_of(const std::vector<Arrival>& arrivals);

/// A program that knows nothing of Hapnet, at one end of the network. It sends numbered datagrams
/// with their send time, and records the numbered datagrams that arrive.
class Host {
public:
    explicit Host(std::string_view local = "127.0.0.1:0");

    [[nodiscard]] net::Endpoint endpoint() const { return socket_.local(); }

    void send(const net::Endpoint& to, std::uint64_t number);
    void send_bytes(const net::Endpoint& to, std::span<const std::byte> bytes);

    /// Receives until `count` datagrams have come in all, or nothing came for `quiet`.
    const std::vector<Arrival>& receive(std::size_t count, std::chrono::milliseconds quiet);

    /// Takes what has arrived, without waiting.
    const std::vector<Arrival>& arrivals();

private:
    net::UdpSocket socket_;
    std::vector<Arrival> arrivals_;
};

/// Sends `count` datagrams, numbered from 0, from `from` to `to`, one each `spacing` on an
/// absolute clock.
void stream(Host& from, const net::Endpoint& to, std::uint64_t count, base::Duration spacing);

} // namespace hapnet::e2e
