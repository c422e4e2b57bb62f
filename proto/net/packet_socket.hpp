// SPDX-FileCopyrightText: 2026 The Hapnet authors
// SPDX-License-Identifier: MIT
#pragma once

#include "proto/base/time.hpp"
#include "proto/net/batch_sender.hpp"

#include <cstddef>
#include <cstdint>
#include <memory>
#include <span>
#include <string>

namespace hapnet::net {

/// A frame from the kernel, starting with its Ethernet header and including its VLAN tag.
struct ReceivedFrame {
    std::span<std::byte> bytes;  // valid until the next receive()
    base::TimePoint at;          // the kernel's receive stamp
    bool lacks_checksum = false; // the sending kernel left it to hardware that does not exist
};

/// Receives all frames that arrive at a network interface, and sends frames from it (AF_PACKET).
/// Frames that this machine sends there, through this socket or not, are not received.
class PacketSocket {
public:
    static constexpr std::size_t batch_max = 64;

    /// Throws std::system_error naming the interface. Needs CAP_NET_RAW in its network namespace.
    explicit PacketSocket(const std::string& interface);
    ~PacketSocket();
    PacketSocket(const PacketSocket&) = delete;
    PacketSocket& operator=(const PacketSocket&) = delete;

    /// Returns a batch of waiting frames, oldest first; empty if there are none. Never blocks,
    /// never allocates. Stamps are never in the future.
    [[nodiscard]] std::span<const ReceivedFrame> receive();

    /// Sends up to batch_max frames. Returns the outcome of each, in their order; it is valid until
    /// the next call. Never blocks.
    std::span<const SendOutcome> send_batch(std::span<const std::span<const std::byte>> frames);

    [[nodiscard]] int descriptor() const { return descriptor_; }
    /// Returns the errno by which the interface has failed, such as ENETDOWN after it was set down
    /// or deleted; 0 while it works.
    [[nodiscard]] int error() const { return error_; }
    /// Returns the number of frames that the kernel dropped because this socket's buffer was full.
    [[nodiscard]] std::uint64_t overflowed() const;

private:
    struct Inbox;

    void note_error(int error);

    int descriptor_ = -1;
    int error_ = 0;
    std::unique_ptr<Inbox> inbox_;
};

} // namespace hapnet::net
