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

/// A frame as the kernel handed it over, from its Ethernet header on, with its VLAN tag.
struct ReceivedFrame {
    std::span<std::byte> bytes;  // valid until the next receive()
    base::TimePoint at;          // the kernel's receive stamp
    bool lacks_checksum = false; // the sender's kernel left it to hardware that does not exist
};

/// All frames that arrive at a network interface, and a way to send frames from it: AF_PACKET.
/// Frames that the machine itself sends there, through this socket or not, are not received.
class PacketSocket {
public:
    static constexpr std::size_t batch_max = 64;

    /// Throws std::system_error naming the interface. Needs CAP_NET_RAW in its network namespace.
    explicit PacketSocket(const std::string& interface);
    ~PacketSocket();
    PacketSocket(const PacketSocket&) = delete;
    PacketSocket& operator=(const PacketSocket&) = delete;

    /// A batch of waiting frames, oldest first; empty when there are none. Never blocks, never
    /// allocates. Stamps never lie in the future.
    [[nodiscard]] std::span<const ReceivedFrame> receive();

    /// Sends up to batch_max frames. Returns the outcome of each, in their order; it is valid until
    /// the next call. Never blocks.
    std::span<const SendOutcome> send_batch(std::span<const std::span<const std::byte>> frames);

    [[nodiscard]] int descriptor() const { return descriptor_; }
    /// The errno by which the interface has failed, such as ENETDOWN when it was set down or
    /// deleted; 0 while it works.
    [[nodiscard]] int error() const { return error_; }
    /// Frames that the kernel dropped because this socket's buffer was full.
    [[nodiscard]] std::uint64_t overflowed() const;

private:
    struct Inbox;

    void note_error(int error);

    int descriptor_ = -1;
    int error_ = 0;
    std::unique_ptr<Inbox> inbox_;
};

} // namespace hapnet::net
