// SPDX-FileCopyrightText: 2026 The Hapnet authors
// SPDX-License-Identifier: MIT
#include "proto/net/address_set.hpp"

#include "proto/base/ensure.hpp"
#include "proto/base/text.hpp"

#include <algorithm>
#include <arpa/inet.h>
#include <cstring>
#include <ifaddrs.h>
#include <netinet/in.h>
#include <spdlog/fmt/fmt.h>

namespace hapnet::net {

namespace {

constexpr unsigned int bits_of_v4 = 32;
constexpr unsigned int bits_of_v6 = 128;

bool is_numeric(const std::string& host)
{
    in6_addr unused{};
    return inet_pton(AF_INET, host.c_str(), &unused) == 1 ||
           inet_pton(AF_INET6, host.c_str(), &unused) == 1;
}

/// Returns "::1" for "[::1]".
std::string_view without_brackets(std::string_view host)
{
    const bool has = host.size() > 2 && host.front() == '[' && host.back() == ']';
    return has ? host.substr(1, host.size() - 2) : host;
}

base::Result<AddressPattern> network_of(std::string_view text, std::size_t slash)
{
    const std::string host{without_brackets(text.substr(0, slash))};
    const auto bits = base::parse_count(text.substr(slash + 1), bits_of_v6);
    if (!is_numeric(host) || !bits) {
        return base::fail(fmt::format("'{}' is not a network: write NET/BITS, such as 10.0.0.0/8 "
                                      "or fd00::/8",
                                      text));
    }
    if (host.find(':') == std::string::npos && *bits > bits_of_v4) {
        return base::fail(fmt::format("'{}': an IPv4 network has at most 32 bits", text));
    }
    return AddressPattern{host, std::nullopt, static_cast<unsigned int>(*bits)};
}

bool agree(const std::array<std::uint8_t, 16>& a, const std::array<std::uint8_t, 16>& b,
           unsigned int bits)
{
    const std::size_t whole = bits / 8;
    const unsigned int rest = bits % 8;
    if (!std::equal(a.begin(), a.begin() + static_cast<std::ptrdiff_t>(whole), b.begin())) {
        return false;
    }
    return rest == 0 || ((a[whole] ^ b[whole]) >> (8 - rest)) == 0;
}

} // namespace

base::Result<AddressPattern> parse_address_pattern(std::string_view text)
{
    if (const auto slash = text.find('/'); slash != std::string_view::npos) {
        return network_of(text, slash);
    }
    const std::string bare{without_brackets(text)};
    if (bare.empty()) return base::fail("'' is not an address: write HOST, HOST:PORT or NET/BITS");
    if (is_numeric(bare)) return AddressPattern{bare, std::nullopt, std::nullopt};
    if (text.ends_with(":*")) {
        const auto host = text.substr(0, text.size() - 2);
        const std::string name{without_brackets(host)};
        if (name.empty() || (name.find(':') != std::string::npos && name.size() == host.size())) {
            return base::fail(fmt::format("'{}': write an IPv6 address as [::1]:*", text));
        }
        return AddressPattern{name, std::nullopt, std::nullopt};
    }
    if (text.find(':') == std::string_view::npos) {
        return AddressPattern{bare, std::nullopt, std::nullopt};
    }
    const auto exact = parse_host_port(text);
    if (!exact) return tl::unexpected{exact.error()};
    if (exact->port == 0) {
        return base::fail(fmt::format("'{0}': nothing comes from port 0; write {1}:* for any port",
                                      text, text.substr(0, text.rfind(':'))));
    }
    return AddressPattern{exact->host, exact->port, std::nullopt};
}

AddressSet::Bytes AddressSet::bytes_of(const Endpoint& endpoint)
{
    Bytes bytes{};
    if (endpoint.family() == AF_INET6) {
        sockaddr_in6 v6{};
        std::memcpy(&v6, endpoint.address(), sizeof v6);
        std::memcpy(bytes.data(), &v6.sin6_addr, bytes.size());
    } else {
        sockaddr_in v4{};
        std::memcpy(&v4, endpoint.address(), sizeof v4);
        bytes[10] = bytes[11] = 0xff;
        std::memcpy(bytes.data() + 12, &v4.sin_addr, 4);
    }
    return bytes;
}

base::Result<void> AddressSet::add(const AddressPattern& pattern, int family)
{
    const bool is_v4_text = pattern.host.find(':') == std::string::npos && is_numeric(pattern.host);
    const int looked_up_in = is_v4_text ? AF_INET : family; // IPv6 sockets receive IPv4 as mapped
    const Endpoint host = resolve({pattern.host, 0}, looked_up_in);
    unsigned int bits = bits_of_v6;
    if (pattern.prefix) {
        bits = *pattern.prefix + (host.family() == AF_INET ? bits_of_v6 - bits_of_v4 : 0);
    }
    const Bytes address = bytes_of(host);
    Bytes network{};
    for (unsigned int bit = 0; bit < bits; ++bit) {
        network[bit / 8] |= static_cast<std::uint8_t>(address[bit / 8] & (0x80U >> (bit % 8)));
    }
    if (network != address) {
        return base::fail(fmt::format("{}/{} has bits beyond its length: a network ends in zeros",
                                      pattern.host, *pattern.prefix));
    }
    members_.push_back({address, bits, pattern.port});
    return {};
}

void AddressSet::add_host(const Endpoint& host)
{
    members_.push_back({bytes_of(host), bits_of_v6, std::nullopt});
}

bool AddressSet::contains(const Endpoint& endpoint) const
{
    const Bytes address = bytes_of(endpoint);
    const auto port = endpoint.port();
    return std::ranges::any_of(members_, [&](const Member& member) {
        return (!member.port || *member.port == port) &&
               agree(address, member.address, member.bits);
    });
}

bool AddressSet::is_loopback() const
{
    static constexpr Bytes v6{0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 1};
    static constexpr Bytes v4{0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0xff, 0xff, 127};
    return std::ranges::all_of(members_, [](const Member& member) {
        const bool is_v4 = member.bits >= 104 && agree(member.address, v4, 104);
        return is_v4 || (member.bits == bits_of_v6 && member.address == v6);
    });
}

AddressSet addresses_of_this_machine()
{
    AddressSet set;
    base::ensure(set.add({"127.0.0.0", std::nullopt, 8}).has_value());
    ifaddrs* first = nullptr;
    if (getifaddrs(&first) != 0) return set;
    for (const ifaddrs* one = first; one != nullptr; one = one->ifa_next) {
        if (one->ifa_addr == nullptr) continue;
        const auto family = one->ifa_addr->sa_family;
        if (family != AF_INET && family != AF_INET6) continue;
        const socklen_t length = family == AF_INET ? sizeof(sockaddr_in) : sizeof(sockaddr_in6);
        sockaddr_storage address{};
        std::memcpy(&address, one->ifa_addr, length);
        set.add_host(Endpoint{address, length});
    }
    freeifaddrs(first);
    return set;
}

} // namespace hapnet::net
