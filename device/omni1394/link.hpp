// SPDX-FileCopyrightText: 2026 The Hapnet authors
// SPDX-License-Identifier: MIT
#pragma once

#include "device/fault.hpp"
#include "device/omni1394/packet.hpp"
#include "proto/base/time.hpp"

#include <array>
#include <cstddef>
#include <cstdint>
#include <span>

namespace hapnet::device::omni1394 {

/// The two isochronous channels of a device.
struct Channels {
    std::uint8_t to_device = 0;
    std::uint8_t to_host = 0;
};

/// The next event.
enum class Arrival : std::uint8_t {
    nothing,   // no event is waiting
    packet,    // a packet from the device
    bus_reset, // a device was plugged in or out, and all have new addresses
    gone,      // the device has gone
};

/// A packet of the device, as received.
struct ReceivedPacket {
    std::array<std::byte, device_packet_bytes_max> bytes{};
    std::size_t size = 0;
    unsigned cycle = 0; // cycle of the bus, 125 us long: 0 to 7999

    [[nodiscard]] std::span<const std::byte> content() const
    {
        return std::span{bytes}.first(size);
    }
};

/// The connection to one device over the bus. It takes no decisions. Its destructor stops
/// everything that it started, and releases its channels.
class Link {
public:
    Link() = default;
    virtual ~Link() = default;
    Link(const Link&) = delete;
    Link& operator=(const Link&) = delete;

    // These calls are for the start and the end. They wait for an answer, but at most two seconds.

    [[nodiscard]] virtual Opened<Channels> allocate() = 0;
    /// Reads as many bytes as there is room for.
    [[nodiscard]] virtual Opened<std::size_t> read_register(std::uint64_t address,
                                                            std::span<std::byte> bytes) = 0;
    [[nodiscard]] virtual Opened<std::size_t> write_register(std::uint64_t address,
                                                             std::span<const std::byte> bytes) = 0;
    /// Starts listening, and enables sending.
    [[nodiscard]] virtual Opened<Channels> start(const Channels& channels) = 0;
    /// Waits until all sent packets are on the wire, or can no longer be sent.
    virtual void drain() noexcept = 0;

    // These calls are for a tick. None of them waits.

    /// Takes the oldest packet that has not been taken yet.
    [[nodiscard]] virtual Arrival receive(ReceivedPacket& packet) noexcept = 0;
    /// Sends a command for the next millisecond; from any thread. Returns false if it cannot be
    /// sent now because the previous ones are still in transit. A command with force may be dropped
    /// then; one with zero force is always accepted.
    virtual bool send(const HostPacket& packet) noexcept = 0;

    /// Waits until something arrives, and not longer than `most`. Returns true if something has
    /// arrived.
    [[nodiscard]] virtual bool wait(base::Duration most) noexcept = 0;
};

} // namespace hapnet::device::omni1394
