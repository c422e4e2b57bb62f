// SPDX-FileCopyrightText: 2026 The Hapnet authors
// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>

namespace hapnet::base {

/// The traffic class and the hop limit of an IP header.
struct IpMarks {
    std::uint8_t traffic_class = 0; // DSCP and ECN: TOS of IPv4 (RFC 2474, RFC 3168)
    std::uint8_t hop_limit = 0;     // TTL of IPv4; 0: not known

    /// The two lower bits of the class (RFC 3168).
    static constexpr std::uint8_t ecn_bits = 0b11;
    static constexpr std::uint8_t congestion_experienced = 0b11;

    /// True if the sender accepts congestion marks in place of losses: ECT(0), ECT(1), or CE if the
    /// packet was marked already.
    [[nodiscard]] constexpr bool is_ecn_capable() const { return (traffic_class & ecn_bits) != 0; }
    [[nodiscard]] constexpr bool is_congested() const
    {
        return (traffic_class & ecn_bits) == congestion_experienced;
    }
    /// Returns these marks with CE set.
    [[nodiscard]] constexpr IpMarks with_congestion() const
    {
        return {static_cast<std::uint8_t>(traffic_class | congestion_experienced), hop_limit};
    }

    friend constexpr bool operator==(const IpMarks&, const IpMarks&) = default;
};

} // namespace hapnet::base
