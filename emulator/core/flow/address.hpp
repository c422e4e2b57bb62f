// SPDX-FileCopyrightText: 2026 The Hapnet authors
// SPDX-License-Identifier: MIT
#pragma once

#include "proto/base/result.hpp"

#include <array>
#include <cstddef>
#include <cstdint>
#include <span>
#include <string>
#include <string_view>

namespace hapnet::emulator {

/// An IPv6 address as two numbers, or an IPv4 address as ::ffff:a.b.c.d.
struct Address {
    std::uint64_t high = 0;
    std::uint64_t low = 0;

    static constexpr std::uint64_t ipv4_prefix = 0xffff'0000'0000ULL; // `low` of ::ffff:0:0

    friend bool operator==(const Address&, const Address&) = default;
};

/// Returns the address in four bytes (IPv4) or in 16 (IPv6), most significant byte first.
[[nodiscard]] inline Address address_of(std::span<const std::byte> bytes)
{
    const auto number = [&](std::size_t at, std::size_t count) {
        std::uint64_t value = 0;
        for (std::size_t i = 0; i < count; ++i) {
            value = value << 8U | std::to_integer<std::uint64_t>(bytes[at + i]);
        }
        return value;
    };
    if (bytes.size() == 4) return {0, Address::ipv4_prefix | number(0, 4)};
    return {number(0, 8), number(8, 8)};
}

/// All addresses of one IP version with the same first bits.
class Net {
public:
    /// Makes the net of the address :: alone. It contains no address of IP version 4 or 6.
    Net() = default;

    /// Reads "10.0.0.0/8", "fe80::/10", or a single address. The error says what to write.
    [[nodiscard]] static base::Result<Net> parse(std::string_view text);

    /// True if the net contains the address of a packet of this IP version, 4 or 6.
    [[nodiscard]] bool contains(const Address& address, std::uint8_t version) const
    {
        return version == version_ && ((address.high ^ first_.high) & mask_.high) == 0 &&
               ((address.low ^ first_.low) & mask_.low) == 0;
    }
    [[nodiscard]] bool is_single() const { return mask_.low == ~std::uint64_t{0}; }
    /// Returns the text that parse() reads. For a single address it has no length.
    [[nodiscard]] std::string text() const;

    friend bool operator==(const Net&, const Net&) = default;

private:
    Address first_;
    Address mask_{~std::uint64_t{0}, ~std::uint64_t{0}};
    std::uint8_t version_ = 0;
    std::uint8_t bits_ = 128; // length of the mask
};

} // namespace hapnet::emulator
