// SPDX-FileCopyrightText: 2026 The Hapnet authors
// SPDX-License-Identifier: MIT
#pragma once

#include "emulator/core/flow/address.hpp"
#include "emulator/core/frame.hpp"

#include <cstddef>
#include <cstdint>
#include <optional>
#include <span>

namespace hapnet::emulator {

/// The facts about a packet that the filters of flows use.
struct PacketFacts {
    /// A part of an IP packet, or all of it.
    enum class Part : std::uint8_t { whole, first, later };

    std::uint16_t protocol = 0; // IANA protocol number after all extension headers; or `arp`
    std::uint8_t version = 0;   // IP version, 4 or 6; 0: ARP
    std::uint8_t dscp = 0;
    bool has_ports = false;
    Part part = Part::whole;
    std::uint16_t from_port = 0;
    std::uint16_t to_port = 0;
    std::uint32_t bytes = 0;       // size of the IP packet
    std::uint32_t fragment_id = 0; // the identification of the packet that a part belongs to
    Address from{};
    Address to{};

    /// A value beyond the protocol numbers of IANA.
    static constexpr std::uint16_t arp = 256;
};

/// Returns the facts about the packet in the bytes of an Ethernet frame. nullopt: the frame carries
/// neither IP nor ARP, or its headers are truncated, contradict each other, or do not end after
/// eight extension headers.
[[nodiscard]] std::optional<PacketFacts> facts_of(const Frame& frame,
                                                  std::span<const std::byte> bytes);

} // namespace hapnet::emulator
