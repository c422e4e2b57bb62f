// SPDX-FileCopyrightText: 2026 The Hapnet authors
// SPDX-License-Identifier: MIT
#pragma once

#include "proto/secure/primitives.hpp"

#include <algorithm>
#include <array>
#include <stdexcept>
#include <string>
#include <string_view>
#include <vector>

namespace hapnet::secure {

using Text = std::vector<std::byte>;

/// "48e4" as bytes.
[[nodiscard]] inline Text from_hex(std::string_view hex)
{
    if (hex.size() % 2 != 0) throw std::invalid_argument{"an odd number of digits"};
    Text bytes;
    for (std::size_t i = 0; i < hex.size(); i += 2) {
        bytes.push_back(
            static_cast<std::byte>(std::stoul(std::string{hex.substr(i, 2)}, nullptr, 16)));
    }
    return bytes;
}

[[nodiscard]] inline std::string to_hex(Bytes bytes)
{
    constexpr std::string_view digits = "0123456789abcdef";
    std::string hex;
    for (const std::byte each : bytes) {
        hex += digits[std::to_integer<std::size_t>(each >> 4)];
        hex += digits[std::to_integer<std::size_t>(each & std::byte{15})];
    }
    return hex;
}

template <std::size_t count>
[[nodiscard]] std::array<std::byte, count> array_from_hex(std::string_view hex)
{
    const Text bytes = from_hex(hex);
    if (bytes.size() != count) throw std::invalid_argument{"another number of digits"};
    std::array<std::byte, count> result{};
    std::ranges::copy(bytes, result.begin());
    return result;
}

[[nodiscard]] inline Secret secret_from_hex(std::string_view hex)
{
    return Secret{array_from_hex<key_bytes>(hex)};
}
[[nodiscard]] inline PublicKey public_from_hex(std::string_view hex)
{
    return array_from_hex<key_bytes>(hex);
}

[[nodiscard]] inline Bytes bytes_of(std::string_view text)
{
    return std::as_bytes(std::span{text});
}

} // namespace hapnet::secure
