// SPDX-FileCopyrightText: 2026 The Hapnet authors
// SPDX-License-Identifier: MIT
#pragma once

#include "proto/base/ip_marks.hpp"
#include "proto/base/time.hpp"
#include "proto/net/batch_sender.hpp"
#include "proto/net/endpoint.hpp"

#include <cstddef>
#include <cstdint>
#include <memory>
#include <span>

namespace hapnet::net {

/// A datagram from the kernel.
struct Received {
    std::span<const std::byte> bytes; // valid until the next receive()
    Endpoint from;
    base::TimePoint at;    // the kernel's receive stamp
    base::IpMarks marks{}; // with Load::bulk only; unknown with Load::stream
};

/// The expected load of a socket.
enum class Load : std::uint8_t {
    stream, // one sender at a few thousand datagrams a second
    bulk,   // as many datagrams as possible: the kernel may pass on neighbours of one size
            // together (UDP_GRO), a privileged program gets the receive buffer that it requests,
            // and each datagram has its marks
};

/// A bound, non-blocking UDP socket with kernel receive stamps. Sends and receives; makes no
/// decisions.
class UdpSocket {
public:
    /// The number of messages per receive(). With Load::stream each message is a datagram. With
    /// Load::bulk one may hold many, so receive() asks for fewer.
    static constexpr std::size_t batch_max = 64;
    static constexpr std::size_t payload_bytes_max = 65535;

    /// Binds to `local` (port 0: any free port). Throws std::system_error naming the address.
    explicit UdpSocket(const Endpoint& local, Load load = Load::stream);
    /// Binds another socket to the address of `first`. All datagrams of one sender arrive at the
    /// same one of the two. No other program can share the address, because `first` was bound
    /// exclusively.
    [[nodiscard]] static UdpSocket beside(UdpSocket& first, Load load);
    ~UdpSocket();
    UdpSocket(UdpSocket&& other) noexcept;
    UdpSocket& operator=(UdpSocket&&) = delete;
    UdpSocket(const UdpSocket&) = delete;
    UdpSocket& operator=(const UdpSocket&) = delete;

    /// Returns a batch of waiting datagrams, oldest first; empty if there are none. Never blocks,
    /// never allocates. Stamps are converted from the kernel's real-time clock with an offset that
    /// is read at each call. So a step of the wall clock affects at most one batch, and stamps are
    /// never in the future. Datagrams that the kernel passed on together have one stamp.
    [[nodiscard]] std::span<const Received> receive();

    /// Sends one datagram. Never blocks.
    SendOutcome send(const Endpoint& to, std::span<const std::byte> bytes);

    /// Sends up to BatchSender::batch_max datagrams, merged if the kernel supports that. Returns
    /// the outcome of each, in their order, valid until the next call. Never blocks. `marks` are
    /// those of each datagram; if it is empty, all get those of the socket.
    std::span<const SendOutcome> send_batch(const Endpoint& to,
                                            std::span<const std::span<const std::byte>> datagrams,
                                            std::span<const base::IpMarks> marks = {});

    [[nodiscard]] Endpoint local() const;
    [[nodiscard]] int descriptor() const { return descriptor_; }

    /// Returns the number of datagrams that the kernel dropped because this socket's buffer was
    /// full (SO_RXQ_OVFL). With Load::bulk, merged neighbours count as one, because the kernel does
    /// not say how many they are.
    [[nodiscard]] std::uint64_t overflowed() const;

    /// Returns the number of answers that no program listens where datagrams were sent (ICMP, "port
    /// unreachable"), as far as receive() and sending have found them. For Load::bulk.
    [[nodiscard]] std::uint64_t unreachable() const;

private:
    struct Inbox;
    enum class Place : std::uint8_t { alone, shared };
    UdpSocket(const Endpoint& local, Load load, Place place);

    int descriptor_ = -1;
    std::unique_ptr<Inbox> inbox_;
    std::unique_ptr<BatchSender> sender_;
};

} // namespace hapnet::net
