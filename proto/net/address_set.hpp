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

/// Addresses as a user has typed them; a name is not looked up.
///
/// - "10.0.0.1:7000", "[::1]:7000", "host:7000": this port of this host
/// - "10.0.0.1", "[::1]", "host", "host:*": any port of this host
/// - "10.0.0.0/8", "fd00::/8": any port of each host of this network
struct AddressPattern {
    std::string host;
    std::optional<std::uint16_t> port;  // nullopt: any port
    std::optional<unsigned int> prefix; // bits that are compared; nullopt: all of them
};
[[nodiscard]] base::Result<AddressPattern> parse_address_pattern(std::string_view text);

/// The endpoints that some patterns name. An IPv4 address and the IPv6 address that stands for it
/// ("::ffff:10.0.0.1") are one.
class AddressSet {
public:
    /// Looks up the host, in the family of the socket that hears it (AF_UNSPEC: any). The error
    /// says what is wrong with the pattern; throws std::system_error when the name does not
    /// resolve.
    base::Result<void> add(const AddressPattern& pattern, int family = AF_UNSPEC);

    /// Adds an address with any port.
    void add_host(const Endpoint& host);

    [[nodiscard]] bool contains(const Endpoint& endpoint) const;
    [[nodiscard]] bool empty() const { return members_.empty(); }

    /// True if every address is on this machine.
    [[nodiscard]] bool is_loopback() const;

private:
    using Bytes = std::array<std::uint8_t, 16>; // an address as IPv6
    struct Member {
        Bytes address{};
        unsigned int bits = 0; // number of bits that are compared
        std::optional<std::uint16_t> port;
    };
    static Bytes bytes_of(const Endpoint& endpoint);

    std::vector<Member> members_;
};

/// The addresses of this machine, as they are now.
[[nodiscard]] AddressSet addresses_of_this_machine();

} // namespace hapnet::net
