// SPDX-FileCopyrightText: 2026 The Hapnet authors
// SPDX-License-Identifier: MIT
#pragma once

#include "device/omni1394/link.hpp"
#include "device/omni1394/transport/node.hpp"

#include <atomic>
#include <cstdint>
#include <memory>
#include <string>

namespace hapnet::device::omni1394 {

/// A link over the kernel's <linux/firewire-cdev.h>, without mapped memory: sent data are in the
/// headers of the packets, and received data are in the headers of the events. It has three
/// descriptors, because each may have one isochronous context.
class FirewireLink final : public Link {
public:
    /// Opens `path`, such as /dev/fw1. A second link to the same node is refused.
    [[nodiscard]] static Opened<std::unique_ptr<Link>> open(const std::string& path);
    ~FirewireLink() override;
    FirewireLink(const FirewireLink&) = delete;
    FirewireLink& operator=(const FirewireLink&) = delete;

    [[nodiscard]] Opened<Channels> allocate() override;
    [[nodiscard]] Opened<std::size_t> read_register(std::uint64_t address,
                                                    std::span<std::byte> bytes) override;
    [[nodiscard]] Opened<std::size_t> write_register(std::uint64_t address,
                                                     std::span<const std::byte> bytes) override;
    [[nodiscard]] Opened<Channels> start(const Channels& channels) override;
    void drain() noexcept override;
    [[nodiscard]] Arrival receive(ReceivedPacket& packet) noexcept override;
    bool send(const HostPacket& packet) noexcept override;
    [[nodiscard]] bool wait(base::Duration most) noexcept override;

private:
    FirewireLink(Node node, Node sender, Node receiver);

    [[nodiscard]] Opened<std::uint8_t> allocate_channel(std::uint32_t bytes);
    [[nodiscard]] Opened<std::size_t> transact(std::uint32_t code, std::uint64_t address,
                                               std::span<const std::byte> request,
                                               std::span<std::byte> response);
    [[nodiscard]] int make_context(Node& node, std::uint32_t type, std::uint8_t channel);
    [[nodiscard]] int queue_room(std::size_t packets) noexcept;
    void count_what_was_sent(base::Duration within) noexcept;
    [[nodiscard]] Arrival hear_of(const Node& node) noexcept;
    [[nodiscard]] Arrival next_of_event(ReceivedPacket& packet) noexcept;

    Node node_; // for registers, channels and bus resets
    Node sender_;
    Node receiver_;
    Event event_;                 // last event of node_ or sender_
    Event packets_;               // last event of receiver_
    std::uint64_t requests_ = 0;  // number of requests so far
    std::size_t at_ = 0;          // position in packets_ up to which it was read
    std::atomic<int> sending_{0}; // packets in transit
};

} // namespace hapnet::device::omni1394
