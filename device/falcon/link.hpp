// SPDX-FileCopyrightText: 2026 The Hapnet authors
// SPDX-License-Identifier: MIT
#pragma once

#include "device/falcon/packet.hpp"

#include <cstddef>
#include <cstdint>
#include <span>

namespace hapnet::device::falcon {

/// Carries packets to a Falcon whose firmware runs, and bytes back. It takes no decisions. One
/// thread calls all functions but interrupt(). None throws.
class Link {
public:
    Link() = default;
    virtual ~Link() = default;
    Link(const Link&) = delete;
    Link& operator=(const Link&) = delete;

    /// Begins to send a packet. Returns false if the previous packet has not left yet, or the
    /// device has gone.
    [[nodiscard]] virtual bool send(const Packet& packet) noexcept = 0;

    enum class Wait : std::uint8_t { no, briefly }; // briefly: at most 2 ms, usually 1 ms
    /// Returns the bytes since the last call, which are valid until the next call. Empty: none.
    [[nodiscard]] virtual std::span<const std::byte> receive(Wait wait) noexcept = 0;

    /// True once the device has been unplugged. It does not return to false.
    [[nodiscard]] virtual bool is_gone() const noexcept = 0;

    /// Sends a packet after the packets in transit; from any thread. It has no effect while an
    /// earlier packet of interrupt() is still waiting to leave: call it again then.
    virtual void interrupt(const Packet& packet) noexcept = 0;

    /// Sends a packet, and waits at most 50 ms until it has left.
    virtual void send_now(const Packet& packet) noexcept = 0;
};

} // namespace hapnet::device::falcon
