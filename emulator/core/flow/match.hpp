// SPDX-FileCopyrightText: 2026 The Hapnet authors
// SPDX-License-Identifier: MIT
#pragma once

#include "emulator/core/flow/address.hpp"
#include "proto/base/describe.hpp"
#include "proto/base/formats.hpp"
#include "proto/base/result.hpp"

#include <cstdint>
#include <limits>
#include <optional>
#include <string>

namespace hapnet::emulator {

/// The whole numbers from `first` to `last`.
struct NumberRange {
    std::uint16_t first = 0;
    std::uint16_t last = std::numeric_limits<std::uint16_t>::max();

    [[nodiscard]] bool contains(std::uint32_t number) const
    {
        return first <= number && number <= last;
    }

    friend bool operator==(const NumberRange&, const NumberRange&) = default;
};

// Notation of the values of a match.

/// A name such as "udp", or a protocol number of IANA.
struct ProtocolFormat {
    void read(const base::Node& node, std::uint16_t& target, base::Reading& reading) const;
    [[nodiscard]] std::string print(std::uint16_t value) const;
    [[nodiscard]] std::string describe() const;
};

/// A port, or a range of ports: 5004, "5000-5100".
struct PortsFormat {
    void read(const base::Node& node, NumberRange& target, base::Reading& reading) const;
    [[nodiscard]] std::string print(const NumberRange& value) const;
    [[nodiscard]] std::string describe() const { return "a port, or ports such as 5000-5100"; }
};

/// Numbers of bytes: 100, "..100", "100..", "100..200".
struct SizesFormat {
    void read(const base::Node& node, NumberRange& target, base::Reading& reading) const;
    [[nodiscard]] std::string print(const NumberRange& value) const;
    [[nodiscard]] std::string describe() const { return "bytes, such as ..100 or 1000..1500"; }
};

/// A name such as "ef", or a number from 0 to 63.
struct DscpFormat {
    void read(const base::Node& node, std::uint8_t& target, base::Reading& reading) const;
    [[nodiscard]] std::string print(std::uint8_t value) const;
    [[nodiscard]] std::string describe() const { return "a name such as ef, or a number to 63"; }
};

struct IpVersionFormat {
    void read(const base::Node& node, std::uint8_t& target, base::Reading& reading) const;
    [[nodiscard]] std::string print(std::uint8_t value) const;
    [[nodiscard]] std::string describe() const { return "4 or 6"; }
};

/// A single address.
struct HostFormat {
    void read(const base::Node& node, Net& target, base::Reading& reading) const;
    [[nodiscard]] std::string print(const Net& value) const;
    [[nodiscard]] std::string describe() const { return "an address such as 10.0.0.1"; }
};

struct NetFormat {
    void read(const base::Node& node, Net& target, base::Reading& reading) const;
    [[nodiscard]] std::string print(const Net& value) const;
    [[nodiscard]] std::string describe() const { return "a network such as 10.0.0.0/8"; }
};

/// The packets that belong to a flow: those that meet every condition that is set.
struct Match {
    std::optional<std::uint16_t> protocol{}; // PacketFacts::arp or a number of IANA
    std::optional<NumberRange> port{};
    std::optional<NumberRange> ports{};
    std::optional<NumberRange> to_port{};
    std::optional<NumberRange> from_port{};
    std::optional<Net> host{};
    std::optional<Net> net{};
    std::optional<Net> to_net{};
    std::optional<Net> from_net{};
    std::optional<std::uint8_t> dscp{};
    std::optional<std::uint8_t> ip{};
    std::optional<NumberRange> size{};

    friend bool operator==(const Match&, const Match&) = default;
};
constexpr auto fields_of(base::Tag<Match>)
{
    using M = Match;
    return base::fields(
        "match",
        base::field("protocol", &M::protocol, ProtocolFormat{},
                    "what the IP packet carries, behind IPv6 extension headers; `arp` with "
                    "`--all-frames`"),
        base::field("port", &M::port, PortsFormat{}, "port of either end"),
        base::field("ports", &M::ports, PortsFormat{}, "the same, for a range"),
        base::field("to_port", &M::to_port, PortsFormat{}, "port of the receiver"),
        base::field("from_port", &M::from_port, PortsFormat{}, "port of the sender"),
        base::field("host", &M::host, HostFormat{}, "address of either end"),
        base::field("net", &M::net, NetFormat{}, "network of either end"),
        base::field("to_net", &M::to_net, NetFormat{}, "network of the receiver"),
        base::field("from_net", &M::from_net, NetFormat{}, "network of the sender"),
        base::field("dscp", &M::dscp, DscpFormat{}, "differentiated services code point"),
        base::field("ip", &M::ip, IpVersionFormat{}, "version of IP"),
        base::field("size", &M::size, SizesFormat{}, "bytes of the IP packet"));
}

/// Refuses a match without conditions, or with conditions that no packet can meet.
[[nodiscard]] base::Result<void> validate(const Match& match);

} // namespace hapnet::emulator
