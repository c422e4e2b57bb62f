// SPDX-FileCopyrightText: 2026 The Hapnet authors
// SPDX-License-Identifier: MIT
#pragma once

#include "proto/base/time.hpp"
#include "proto/net/endpoint.hpp"

#include <cstddef>
#include <cstdint>
#include <memory>
#include <span>

namespace hapnet::net {

/// A datagram as the kernel handed it over.
struct Received {
    std::span<const std::byte> bytes; // valid until the next receive()
    Endpoint from;
    base::TimePoint at; // the kernel's receive stamp, on CLOCK_MONOTONIC
};

enum class SendOutcome : std::uint8_t { sent, buffer_full, no_route, too_big, refused, failed };

/// A bound, non-blocking UDP socket with kernel receive stamps. Sends and receives; decides
/// nothing.
class UdpSocket {
public:
    static constexpr std::size_t batch_max = 32; // datagrams per receive()
    static constexpr std::size_t payload_bytes_max = 65535;

    /// Binds to `local` (port 0: any free port). Throws std::system_error naming the address.
    explicit UdpSocket(const Endpoint& local);
    ~UdpSocket();
    UdpSocket(UdpSocket&& other) noexcept;
    UdpSocket& operator=(UdpSocket&&) = delete;
    UdpSocket(const UdpSocket&) = delete;
    UdpSocket& operator=(const UdpSocket&) = delete;

    /// Up to batch_max waiting datagrams, oldest first; empty when there are none. Never blocks,
    /// never allocates. Stamps are converted from the kernel's real-time clock with an offset
    /// read at each call, so a step of the wall clock hurts one batch at most, and never lie in the
    /// future.
    [[nodiscard]] std::span<const Received> receive();

    /// Sends one datagram. Never blocks.
    SendOutcome send(const Endpoint& to, std::span<const std::byte> bytes);

    [[nodiscard]] Endpoint local() const;
    [[nodiscard]] int descriptor() const { return descriptor_; }

    /// Datagrams that the kernel dropped because this socket's buffer was full (SO_RXQ_OVFL).
    [[nodiscard]] std::uint64_t overflowed() const;

private:
    struct Buffers;

    int descriptor_ = -1;
    std::unique_ptr<Buffers> buffers_;
};

} // namespace hapnet::net
