// SPDX-FileCopyrightText: 2026 The Hapnet authors
// SPDX-License-Identifier: MIT
#include "proto/net/endpoint.hpp"

#include "proto/net/cure.hpp"

#include "proto/base/ensure.hpp"
#include "proto/base/text.hpp"

#include <algorithm>
#include <arpa/inet.h>
#include <array>
#include <cerrno>
#include <cstring>
#include <netdb.h>
#include <netinet/in.h>
#include <optional>
#include <spdlog/fmt/fmt.h>
#include <system_error>
#include <tuple>
#include <unistd.h>

namespace hapnet::net {

namespace {

/// The errors of getaddrinfo, which are not errno values.
class NameLookupCategory : public std::error_category {
public:
    [[nodiscard]] const char* name() const noexcept override { return "name lookup"; }
    [[nodiscard]] std::string message(int code) const override { return gai_strerror(code); }
};

const std::error_category& name_lookup()
{
    static const NameLookupCategory category;
    return category;
}

constexpr std::size_t host_bytes_max = 16; // length of an IPv6 address
static_assert(std::tuple_size_v<Endpoint::Packed> == host_bytes_max + sizeof(in_port_t));

template <typename SocketAddress>
SocketAddress address_as(const sockaddr_storage& storage)
{
    SocketAddress address{};
    std::memcpy(&address, &storage, sizeof address);
    return address;
}

} // namespace

Endpoint::Endpoint(const sockaddr_storage& address, socklen_t length)
    : address_{address}, length_{length}
{
    base::ensure(address.ss_family == AF_INET || address.ss_family == AF_INET6);
}

const sockaddr* Endpoint::address() const
{
    return reinterpret_cast<const sockaddr*>(&address_); // the socket API's own idiom
}

std::uint16_t Endpoint::port() const
{
    return family() == AF_INET ? ntohs(address_as<sockaddr_in>(address_).sin_port)
                               : ntohs(address_as<sockaddr_in6>(address_).sin6_port);
}

bool Endpoint::is_loopback() const
{
    if (family() == AF_INET) {
        const auto host = ntohl(address_as<sockaddr_in>(address_).sin_addr.s_addr);
        return (host >> 24) == IN_LOOPBACKNET;
    }
    const auto host = address_as<sockaddr_in6>(address_).sin6_addr;
    const bool mapped_loopback = IN6_IS_ADDR_V4MAPPED(&host) && host.s6_addr[12] == IN_LOOPBACKNET;
    return IN6_IS_ADDR_LOOPBACK(&host) || mapped_loopback;
}

bool Endpoint::reaches(const Endpoint& listen) const
{
    return *this == listen || (listen.is_any() && is_loopback() && port() == listen.port() &&
                               family() == listen.family());
}

bool Endpoint::is_any() const
{
    if (family() == AF_INET) {
        return address_as<sockaddr_in>(address_).sin_addr.s_addr == htonl(INADDR_ANY);
    }
    const auto host = address_as<sockaddr_in6>(address_).sin6_addr;
    return IN6_IS_ADDR_UNSPECIFIED(&host);
}

Endpoint Endpoint::with_port(std::uint16_t port) const
{
    Endpoint other = *this;
    if (family() == AF_INET) {
        auto address = address_as<sockaddr_in>(address_);
        address.sin_port = htons(port);
        std::memcpy(&other.address_, &address, sizeof address);
    } else {
        auto address = address_as<sockaddr_in6>(address_);
        address.sin6_port = htons(port);
        std::memcpy(&other.address_, &address, sizeof address);
    }
    return other;
}

bool Endpoint::is_one_host() const
{
    if (is_any()) return false;
    if (family() == AF_INET) {
        const auto host = ntohl(address_as<sockaddr_in>(address_).sin_addr.s_addr);
        return !IN_MULTICAST(host) && host != INADDR_BROADCAST;
    }
    const auto host = address_as<sockaddr_in6>(address_).sin6_addr;
    return !IN6_IS_ADDR_MULTICAST(&host);
}

Endpoint::Packed Endpoint::packed() const
{
    Packed packed{};
    in_port_t port = 0;
    if (family() == AF_INET) {
        const auto address = address_as<sockaddr_in>(address_);
        std::memcpy(packed.data(), &address.sin_addr, sizeof address.sin_addr);
        port = address.sin_port;
    } else {
        const auto address = address_as<sockaddr_in6>(address_);
        std::memcpy(packed.data(), &address.sin6_addr, sizeof address.sin6_addr);
        port = address.sin6_port;
    }
    std::memcpy(packed.data() + host_bytes_max, &port, sizeof port);
    return packed;
}

Endpoint Endpoint::unpacked(const Packed& packed) const
{
    Endpoint other = *this;
    in_port_t port = 0;
    std::memcpy(&port, packed.data() + host_bytes_max, sizeof port);
    if (family() == AF_INET) {
        auto address = address_as<sockaddr_in>(address_);
        std::memcpy(&address.sin_addr, packed.data(), sizeof address.sin_addr);
        address.sin_port = port;
        std::memcpy(&other.address_, &address, sizeof address);
    } else {
        auto address = address_as<sockaddr_in6>(address_);
        std::memcpy(&address.sin6_addr, packed.data(), sizeof address.sin6_addr);
        address.sin6_port = port;
        std::memcpy(&other.address_, &address, sizeof address);
    }
    return other;
}

std::string Endpoint::to_text() const
{
    std::array<char, INET6_ADDRSTRLEN> host{};
    if (family() == AF_INET) {
        const auto address = address_as<sockaddr_in>(address_);
        inet_ntop(AF_INET, &address.sin_addr, host.data(), host.size());
        return fmt::format("{}:{}", host.data(), port());
    }
    const auto address = address_as<sockaddr_in6>(address_);
    inet_ntop(AF_INET6, &address.sin6_addr, host.data(), host.size());
    return fmt::format("[{}]:{}", host.data(), port());
}

bool operator==(const Endpoint& a, const Endpoint& b)
{
    if (a.family() != b.family() || a.port() != b.port()) return false;
    if (a.family() == AF_INET) {
        return address_as<sockaddr_in>(a.address_).sin_addr.s_addr ==
               address_as<sockaddr_in>(b.address_).sin_addr.s_addr;
    }
    const auto host_a = address_as<sockaddr_in6>(a.address_).sin6_addr;
    const auto host_b = address_as<sockaddr_in6>(b.address_).sin6_addr;
    return std::memcmp(&host_a, &host_b, sizeof host_a) == 0;
}

base::Result<HostPort> parse_host_port(std::string_view text)
{
    const auto colon = text.rfind(':');
    if (colon == std::string_view::npos || colon == 0) {
        return base::fail(fmt::format(
            "'{}' is not an address: write HOST:PORT, such as 127.0.0.1:7001 or [::1]:7001", text));
    }
    std::string_view host = text.substr(0, colon);
    if (host.front() == '[') {
        if (host.back() != ']' || host.size() < 3) {
            return base::fail(fmt::format("'{}': write an IPv6 address as [::1]:7001", text));
        }
        host = host.substr(1, host.size() - 2);
    } else if (host.find(':') != std::string_view::npos) {
        return base::fail(fmt::format("'{}': write an IPv6 address as [::1]:7001", text));
    }
    if (host == "*") {
        return base::fail(fmt::format("'{0}': write 0.0.0.0:{1} or [::]:{1} for all addresses of "
                                      "this machine",
                                      text, text.substr(colon + 1)));
    }
    const auto port = base::parse_count(text.substr(colon + 1), 65535);
    if (!port) return base::fail(fmt::format("'{}': the port {}", text, port.error().message));
    return HostPort{std::string{host}, static_cast<std::uint16_t>(*port)};
}

base::Result<HostPort> parse_listen_address(std::string_view text)
{
    const auto digits = text.substr(text.starts_with(':') ? 1 : 0);
    const bool is_port =
        !digits.empty() && digits.find_first_not_of("0123456789") == std::string_view::npos;
    return parse_host_port(is_port ? fmt::format("127.0.0.1:{}", digits) : std::string{text});
}

std::vector<Endpoint> resolve_all(const HostPort& where, int family)
{
    addrinfo hints{};
    hints.ai_family = family;
    hints.ai_socktype = SOCK_DGRAM;
    addrinfo* found = nullptr;
    const int code =
        getaddrinfo(where.host.c_str(), std::to_string(where.port).c_str(), &hints, &found);
    if (code != 0) {
        const std::string_view kind = family == AF_INET    ? "an IPv4 address of "
                                      : family == AF_INET6 ? "an IPv6 address of "
                                                           : "";
        throw std::system_error{code, name_lookup(),
                                fmt::format("cannot look up {}'{}'", kind, where.host)};
    }
    std::vector<Endpoint> all;
    for (const addrinfo* one = found; one != nullptr; one = one->ai_next) {
        if (one->ai_family != AF_INET && one->ai_family != AF_INET6) continue;
        sockaddr_storage address{};
        std::memcpy(&address, one->ai_addr, one->ai_addrlen);
        const Endpoint endpoint{address, one->ai_addrlen};
        if (std::ranges::find(all, endpoint) == all.end()) all.push_back(endpoint);
    }
    freeaddrinfo(found);
    base::ensure(!all.empty());
    return all;
}

Endpoint resolve(const HostPort& where, int family) { return resolve_all(where, family).front(); }

namespace {

void require_route_from(const std::optional<Endpoint>& listen, const Endpoint& remote)
{
    const int descriptor = socket(remote.family(), SOCK_DGRAM | SOCK_CLOEXEC, 0);
    if (descriptor < 0) throw std::system_error{errno, std::generic_category(), "socket"};
    // If the address cannot be bound, the later bind of the real socket reports that.
    if (listen) std::ignore = bind(descriptor, listen->address(), listen->length());
    const int outcome = connect(descriptor, remote.address(), remote.length());
    const int error = errno;
    close(descriptor);
    if (outcome == 0) return;
    const std::string from = listen ? fmt::format(" from {}", listen->to_text()) : std::string{};
    throw std::system_error{error, errors_of(AddressUse::reach),
                            fmt::format("cannot reach {}{}", remote.to_text(), from)};
}

} // namespace

void require_route(const Endpoint& remote) { require_route_from(std::nullopt, remote); }

void require_route(const Endpoint& listen, const Endpoint& remote)
{
    require_route_from(listen.with_port(0), remote); // any port: the one asked for may be taken
}

} // namespace hapnet::net
