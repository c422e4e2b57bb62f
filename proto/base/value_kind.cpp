// SPDX-FileCopyrightText: 2026 The Hapnet authors
// SPDX-License-Identifier: MIT
#include "proto/base/value_kind.hpp"

#include <algorithm>

namespace hapnet::base::detail {

std::optional<double> number_from(const Leaf& leaf)
{
    if (const auto* number = std::get_if<double>(&leaf)) return *number;
    if (const auto* number = std::get_if<std::int64_t>(&leaf)) return static_cast<double>(*number);
    if (const auto* number = std::get_if<std::uint64_t>(&leaf)) return static_cast<double>(*number);
    return std::nullopt;
}

std::optional<std::size_t> choice_from(const Leaf& leaf, std::span<const std::string_view> names)
{
    const auto* name = std::get_if<std::string>(&leaf);
    if (name == nullptr) return std::nullopt;
    const auto found = std::find(names.begin(), names.end(), *name);
    if (found == names.end()) return std::nullopt;
    return static_cast<std::size_t>(found - names.begin());
}

} // namespace hapnet::base::detail
