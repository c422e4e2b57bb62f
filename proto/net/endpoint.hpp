// SPDX-FileCopyrightText: 2026 The Hapnet authors
// SPDX-License-Identifier: MIT
#pragma once

#include "proto/base/result.hpp"

#include <array>
#include <cstddef>
#include <cstdint>
#include <string>
#include <string_view>
#include <sys/socket.h>
#include <vector>

namespace hapnet::net {

/// An IPv4 or IPv6 address and a UDP port.
class Endpoint {
public:
    /// Takes the endpoint from a socket address of `length` bytes. Ensures family AF_INET or
    /// AF_INET6.
    Endpoint(const sockaddr_storage& address, socklen_t length);

    [[nodiscard]] const sockaddr* address() const;
    [[nodiscard]] socklen_t length() const { return length_; }
    [[nodiscard]] int family() const { return address_.ss_family; }
    [[nodiscard]] std::uint16_t port() const;
    [[nodiscard]] Endpoint with_port(std::uint16_t port) const;
    [[nodiscard]] bool is_loopback() const;
    [[nodiscard]] bool is_any() const;
    /// True if exactly one host can answer from this address, because it is not a multicast,
    /// broadcast or wildcard address.
    [[nodiscard]] bool is_one_host() const;

    /// True if a datagram to this endpoint reaches a socket of this machine that is bound to
    /// `listen`.
    [[nodiscard]] bool reaches(const Endpoint& listen) const;

    /// The address and port in a fixed number of bytes. They compare in the same way as endpoints.
    using Packed = std::array<std::byte, 18>;
    [[nodiscard]] Packed packed() const;
    /// Returns the endpoint with these bytes, in the family and the IPv6 zone of this one.
    [[nodiscard]] Endpoint unpacked(const Packed& packed) const;

    /// Returns "127.0.0.1:7001" or "[::1]:7001".
    [[nodiscard]] std::string to_text() const;

    friend bool operator==(const Endpoint& a, const Endpoint& b);

private:
    sockaddr_storage address_{};
    socklen_t length_ = 0;
};

/// The two parts of "host:port" or "[v6]:port". The host is not looked up.
struct HostPort {
    std::string host;
    std::uint16_t port = 0;
};
[[nodiscard]] base::Result<HostPort> parse_host_port(std::string_view text);

/// Parses an address to listen on. ":7001" and "7001" mean that port of the loopback address.
[[nodiscard]] base::Result<HostPort> parse_listen_address(std::string_view text);

/// Looks up the addresses of a host in the given family, without duplicates, in the order in which
/// the system would try them. See resolve().
[[nodiscard]] std::vector<Endpoint> resolve_all(const HostPort& where, int family = AF_UNSPEC);

/// Looks up the first address of a host in the given family (AF_UNSPEC: any). For a remote, give
/// the family of the listening address, because a socket sends only in its own family. Throws
/// std::system_error naming the host if the name does not resolve.
[[nodiscard]] Endpoint resolve(const HostPort& where, int family = AF_UNSPEC);

/// Throws std::system_error if this machine has no route to `remote`. Sends nothing.
void require_route(const Endpoint& remote);

/// Throws std::system_error if a socket bound to `listen` cannot send to `remote`, because this
/// machine has no route, or none from that address. Sends nothing.
void require_route(const Endpoint& listen, const Endpoint& remote);

} // namespace hapnet::net
