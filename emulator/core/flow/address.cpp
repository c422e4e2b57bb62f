// SPDX-FileCopyrightText: 2026 The Hapnet authors
// SPDX-License-Identifier: MIT
#include "emulator/core/flow/address.hpp"

#include "proto/base/text.hpp"

#include <algorithm>
#include <charconv>
#include <optional>
#include <spdlog/fmt/fmt.h>
#include <vector>

namespace hapnet::emulator {

namespace {

constexpr std::uint8_t ipv4_begin = 96; // bits before an IPv4 address

std::optional<std::uint64_t> number_of(std::string_view digits, int base, std::uint64_t most)
{
    std::uint64_t value = 0;
    const auto [end, error] =
        std::from_chars(digits.data(), digits.data() + digits.size(), value, base);
    const bool is_whole = error == std::errc{} && end == digits.data() + digits.size();
    return is_whole && value <= most ? std::optional{value} : std::nullopt;
}

std::vector<std::string_view> pieces_of(std::string_view text, char separator)
{
    std::vector<std::string_view> parts;
    for (;;) {
        const auto at = text.find(separator);
        parts.push_back(text.substr(0, at));
        if (at == std::string_view::npos) return parts;
        text.remove_prefix(at + 1);
    }
}

std::optional<Address> parse_ipv4(std::string_view text)
{
    const auto parts = pieces_of(text, '.');
    if (parts.size() != 4) return std::nullopt;
    std::uint64_t low = Address::ipv4_prefix;
    for (std::size_t i = 0; i < parts.size(); ++i) {
        const bool has_leading_zero = parts[i].size() > 1 && parts[i].front() == '0';
        const auto byte = number_of(parts[i], 10, 255);
        if (!byte || has_leading_zero) return std::nullopt;
        low |= *byte << (24 - 8 * i);
    }
    return Address{0, low};
}

/// Reads groups of hexadecimal digits between colons; nullopt: there is anything else.
std::optional<std::vector<std::uint16_t>> groups_of(std::string_view text)
{
    std::vector<std::uint16_t> groups;
    if (text.empty()) return groups;
    for (const std::string_view part : pieces_of(text, ':')) {
        const auto group = part.size() <= 4 ? number_of(part, 16, 0xffff) : std::nullopt;
        if (!group) return std::nullopt;
        groups.push_back(static_cast<std::uint16_t>(*group));
    }
    return groups;
}

std::optional<Address> parse_ipv6(std::string_view text)
{
    constexpr std::size_t groups_count = 8;
    const auto gap = text.find("::");
    const bool has_gap = gap != std::string_view::npos;
    const auto before = groups_of(text.substr(0, gap));
    const auto after = groups_of(has_gap ? text.substr(gap + 2) : "");
    if (!before || !after) return std::nullopt;
    const std::size_t written = before->size() + after->size();
    if (has_gap ? written >= groups_count : written != groups_count) return std::nullopt;
    std::array<std::uint16_t, groups_count> all{};
    std::ranges::copy(*before, all.begin());
    std::ranges::copy_backward(*after, all.end());
    Address address;
    for (std::size_t i = 0; i < groups_count; ++i) {
        auto& half = i < 4 ? address.high : address.low;
        half = half << 16U | all[i];
    }
    return address;
}

Address mask_of(std::uint8_t bits)
{
    const auto ones = [](unsigned count) {
        return count == 0 ? 0 : ~std::uint64_t{0} << (64 - count);
    };
    return {ones(std::min<unsigned>(bits, 64)), ones(bits > 64 ? bits - 64U : 0)};
}

std::string ipv4_text(const Address& address)
{
    return fmt::format("{}.{}.{}.{}", address.low >> 24U & 255U, address.low >> 16U & 255U,
                       address.low >> 8U & 255U, address.low & 255U);
}

/// Returns the text of an address with "::" for the first longest run of at least two zeros (RFC
/// 5952).
std::string ipv6_text(const Address& address)
{
    std::array<std::uint16_t, 8> groups{};
    for (std::size_t i = 0; i < groups.size(); ++i) {
        const auto half = i < 4 ? address.high : address.low;
        groups[i] = static_cast<std::uint16_t>(half >> (48 - 16 * (i % 4)));
    }
    std::size_t gap = 0;
    std::size_t gap_length = 1;
    for (std::size_t i = 0; i < groups.size(); ++i) {
        const auto end = std::find_if(groups.begin() + static_cast<std::ptrdiff_t>(i), groups.end(),
                                      [](auto group) { return group != 0; });
        const auto length = static_cast<std::size_t>(end - groups.begin()) - i;
        if (length <= gap_length) continue;
        gap = i;
        gap_length = length;
    }
    if (gap_length == 1) return fmt::format("{:x}", fmt::join(groups, ":"));
    const auto first = groups.begin();
    const auto hole = static_cast<std::ptrdiff_t>(gap);
    const auto rest = static_cast<std::ptrdiff_t>(gap + gap_length);
    return fmt::format("{:x}::{:x}", fmt::join(first, first + hole, ":"),
                       fmt::join(first + rest, groups.end(), ":"));
}

} // namespace

base::Result<Net> Net::parse(std::string_view text)
{
    const auto slash = text.find('/');
    const auto host = text.substr(0, slash);
    const bool is_v6 = host.find(':') != std::string_view::npos;
    const auto address = is_v6 ? parse_ipv6(host) : parse_ipv4(host);
    const std::uint8_t most = is_v6 ? 128 : 32;
    const auto length = slash == std::string_view::npos
                            ? std::optional<std::uint64_t>{most}
                            : number_of(text.substr(slash + 1), 10, most);
    if (!address || !length) {
        return base::fail(fmt::format("'{}' is not a network: write an address and how many of its "
                                      "bits count, such as 10.0.0.0/8 or fe80::/10",
                                      text));
    }
    Net net;
    net.version_ = is_v6 ? 6 : 4;
    net.bits_ = static_cast<std::uint8_t>(*length + (is_v6 ? 0 : ipv4_begin));
    net.mask_ = mask_of(net.bits_);
    net.first_ = {address->high & net.mask_.high, address->low & net.mask_.low};
    if (net.first_ != *address) {
        return base::fail(
            fmt::format("'{}' says more bits than count: write {}", text, net.text()));
    }
    return net;
}

std::string Net::text() const
{
    const bool is_v4 = version_ == 4;
    const auto host = is_v4 ? ipv4_text(first_) : ipv6_text(first_);
    return is_single() ? host : fmt::format("{}/{}", host, is_v4 ? bits_ - ipv4_begin : bits_);
}

} // namespace hapnet::emulator
