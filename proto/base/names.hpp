// SPDX-FileCopyrightText: 2026 The Hapnet authors
// SPDX-License-Identifier: MIT
#pragma once

#include <algorithm>
#include <array>
#include <cstddef>
#include <optional>
#include <string_view>
#include <type_traits>

namespace hapnet::base {

/// A type as an argument, so that a description beside the type is found: fields_of(Tag<T>{}).
template <typename T>
struct Tag {};

/// An enum whose values have names, and count from 0 without gaps. The names are listed beside the
/// enum, in the order of its values:
///     constexpr auto names_of(base::Tag<Order>) { return base::names("keep", "free", "sorted"); }
template <typename Enum>
concept Named = std::is_enum_v<Enum> && requires
{
    names_of(Tag<Enum>{});
};

/// A struct with a description of its fields (describe.hpp).
template <typename T>
concept Described = requires
{
    fields_of(Tag<T>{});
};

template <typename... Texts>
[[nodiscard]] constexpr auto names(Texts... texts)
{
    return std::array<std::string_view, sizeof...(Texts)>{texts...};
}

template <Named Enum>
inline constexpr auto names_of_enum = names_of(Tag<Enum>{});

template <Named Enum>
[[nodiscard]] constexpr std::string_view name_of(Enum value)
{
    return names_of_enum<Enum>.at(static_cast<std::size_t>(value));
}

/// Returns the value with this name; nullopt if no value has it.
template <Named Enum>
[[nodiscard]] constexpr std::optional<Enum> named(std::string_view name)
{
    constexpr auto& all = names_of_enum<Enum>;
    const auto found = std::find(all.begin(), all.end(), name);
    if (found == all.end()) return std::nullopt;
    return static_cast<Enum>(found - all.begin());
}

} // namespace hapnet::base
