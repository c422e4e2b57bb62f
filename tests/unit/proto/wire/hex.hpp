// SPDX-FileCopyrightText: 2026 The Hapnet authors
// SPDX-License-Identifier: MIT
#pragma once

#include <cstddef>
#include <span>
#include <sstream>
#include <string>
#include <vector>

namespace hapnet::wire {

using Bytes = std::vector<std::byte>;

/// "48 4e 01" as bytes.
[[nodiscard]] inline Bytes bytes_of(const std::string& hex)
{
    std::istringstream words{hex};
    Bytes bytes;
    for (std::string word; words >> word;) {
        bytes.push_back(static_cast<std::byte>(std::stoul(word, nullptr, 16)));
    }
    return bytes;
}

[[nodiscard]] inline Bytes bytes_of(std::span<const std::byte> bytes)
{
    return {bytes.begin(), bytes.end()};
}

} // namespace hapnet::wire
