// SPDX-FileCopyrightText: 2026 The Hapnet authors
// SPDX-License-Identifier: MIT
#pragma once

#include "proto/base/result.hpp"
#include "proto/net/endpoint.hpp"

#include <array>
#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace hapnet::net {

/// An address pattern as a user types it. Names are not looked up.
///
/// - "10.0.0.1:7000", "[::1]:7000", "host:7000": this port of this host
/// - "10.0.0.1", "[::1]", "host", "host:*": any port of this host
/// - "10.0.0.0/8", "fd00::/8": any port of each host of this network
struct AddressPattern {
    std::string host;
    std::optional<std::uint16_t> port;  // nullopt: any port
    std::optional<unsigned int> prefix; // number of bits that are compared; nullopt: all of them
};
[[nodiscard]] base::Result<AddressPattern> parse_address_pattern(std::string_view text);

/// The endpoints that match some patterns. An IPv4 address and its form as an IPv6 address
/// ("::ffff:10.0.0.1") are equal.
class AddressSet {
public:
    /// Adds a pattern and looks up its host, in the family of the receiving socket (AF_UNSPEC:
    /// any). The error says what is wrong with the pattern. Throws std::system_error if the name
    /// does not resolve.
    base::Result<void> add(const AddressPattern& pattern, int family = AF_UNSPEC);

    /// Adds an address with any port.
    void add_host(const Endpoint& host);

    [[nodiscard]] bool contains(const Endpoint& endpoint) const;
    [[nodiscard]] bool empty() const { return members_.empty(); }

    /// True if every address belongs to this machine.
    [[nodiscard]] bool is_loopback() const;

private:
    using Bytes = std::array<std::uint8_t, 16>; // an address in the form of IPv6
    struct Member {
        Bytes address{};
        unsigned int bits = 0; // number of bits that are compared
        std::optional<std::uint16_t> port;
    };
    static Bytes bytes_of(const Endpoint& endpoint);

    std::vector<Member> members_;
};

/// Returns the addresses that this machine has now.
[[nodiscard]] AddressSet addresses_of_this_machine();

} // namespace hapnet::net
