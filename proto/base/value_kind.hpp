// SPDX-FileCopyrightText: 2026 The Hapnet authors
// SPDX-License-Identifier: MIT
#pragma once

#include "proto/base/names.hpp"
#include "proto/base/time.hpp"

#include <array>
#include <concepts>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <type_traits>
#include <utility>
#include <variant>
#include <vector>

namespace hapnet::base {

struct FieldTable;

/// Returns the table of a described struct (field_table.hpp).
template <Described T>
[[nodiscard]] const FieldTable& field_table();

/// An array with one T for each value of an enum.
template <Named Enum, typename T>
struct ByName {
    std::array<T, names_of_enum<Enum>.size()> values{};

    [[nodiscard]] T& operator[](Enum name) { return values[static_cast<std::size_t>(name)]; }
    [[nodiscard]] const T& operator[](Enum name) const
    {
        return values[static_cast<std::size_t>(name)];
    }

    friend bool operator==(const ByName&, const ByName&) = default;
};

/// Values with names, in the order in which they are printed.
template <typename T>
using Entries = std::vector<std::pair<std::string, T>>;

/// A value without parts, as JSON and CSV cells contain it.
using Leaf = std::variant<bool, std::int64_t, std::uint64_t, double, std::string>;

/// Operations on values of one type, for code that does not know the type. The `void` pointers
/// point to values of that type. Each type has one constant, however many fields have the type.
struct ValueKind {
    enum class Shape : std::uint8_t {
        opaque, // only its own format can read and print it
        flag,
        whole, // a whole number
        number,
        time, // nanoseconds, printed in the unit that the key ends with
        text,
        choice, // one of `names`
        maybe,  // an optional, treated as a list of at most one element
        list,
        map,   // elements with names
        record // a described struct
    };

    Shape shape = Shape::opaque;
    bool is_signed = false; // a whole number that may be negative
    /// The names of a choice, or of a map whose elements are always the same.
    std::span<const std::string_view> names{};

    // For flag, whole, number, time, text and choice.
    Leaf (*get)(const void* value) = nullptr;
    /// Sets `value` from a leaf. Returns false, and leaves the value unchanged, if the leaf is of
    /// another kind or out of range.
    bool (*set)(void* value, const Leaf& leaf) = nullptr;

    // For maybe, list and map.
    const ValueKind* element = nullptr;
    std::size_t (*size)(const void* value) = nullptr;
    void* (*at)(void* value, std::size_t index) = nullptr;
    std::size_t length = 0; // length of a list of fixed length
    // Removes all elements. nullptr: a list of fixed length.
    void (*clear)(void* value) = nullptr;
    /// Adds an element at the end and returns it. Elements are added one at a time, so that a text
    /// with many wrong elements takes no more memory than its readable elements. A maybe must be
    /// empty.
    void* (*add)(void* value) = nullptr;

    // For map only.
    std::string_view (*name_at)(const void* value, std::size_t index) = nullptr;

    // For record only.
    const FieldTable& (*table)() = nullptr;

    /// Returns an element for reading.
    [[nodiscard]] const void* element_at(const void* value, std::size_t index) const
    {
        return at(const_cast<void*>(value), index); // NOLINT(*-const-cast): it is only looked up
    }
    /// Returns the kind of the value itself, or of the value that a maybe can hold.
    [[nodiscard]] const ValueKind& plain() const
    {
        return shape == Shape::maybe ? *element : *this;
    }
};

namespace detail {

/// Returns the whole number in a leaf; nullopt if it does not fit this type.
template <std::integral T>
[[nodiscard]] std::optional<T> whole_from(const Leaf& leaf)
{
    const auto within = [](auto number) {
        return std::in_range<T>(number) ? std::optional{static_cast<T>(number)} : std::nullopt;
    };
    if (const auto* number = std::get_if<std::uint64_t>(&leaf)) return within(*number);
    if (const auto* number = std::get_if<std::int64_t>(&leaf)) return within(*number);
    return std::nullopt;
}

[[nodiscard]] std::optional<double> number_from(const Leaf& leaf);
/// Returns the index of the leaf among the names; nullopt if it is not one of them.
[[nodiscard]] std::optional<std::size_t> choice_from(const Leaf& leaf,
                                                     std::span<const std::string_view> names);

/// Value kinds by type; the primary template knows nothing about the values.
template <typename T>
struct Kind {
    static constexpr ValueKind kind{};
};

/// Returns the T in a leaf, or nullopt if the leaf holds none.
template <typename T>
[[nodiscard]] std::optional<T> value_from(const Leaf& leaf)
{
    if constexpr (Named<T>) {
        const auto index = choice_from(leaf, names_of_enum<T>);
        return index ? std::optional{static_cast<T>(*index)} : std::nullopt;
    } else if constexpr (std::is_same_v<T, double>) {
        return number_from(leaf);
    } else if constexpr (std::integral<T> && !std::is_same_v<T, bool>) {
        return whole_from<T>(leaf);
    } else {
        const auto* value = std::get_if<T>(&leaf);
        return value != nullptr ? std::optional{*value} : std::nullopt;
    }
}

template <typename T>
[[nodiscard]] Leaf get_leaf(const void* value)
{
    const T& own = *static_cast<const T*>(value);
    if constexpr (Named<T>) {
        return std::string{name_of(own)};
    } else if constexpr (std::is_same_v<T, Duration>) {
        return std::int64_t{own.count()};
    } else if constexpr (std::is_same_v<T, std::string_view>) {
        return std::string{own};
    } else if constexpr (std::signed_integral<T>) {
        return std::int64_t{own};
    } else if constexpr (std::unsigned_integral<T> && !std::is_same_v<T, bool>) {
        return std::uint64_t{own};
    } else {
        return own;
    }
}

template <typename T>
bool set_leaf(void* value, const Leaf& leaf)
{
    auto read = value_from<T>(leaf);
    if (!read) return false;
    *static_cast<T*>(value) = *std::move(read);
    return true;
}

template <typename T>
[[nodiscard]] constexpr ValueKind leaf_kind(ValueKind::Shape shape)
{
    return {.shape = shape,
            .is_signed = std::signed_integral<T>,
            .get = get_leaf<T>,
            .set = set_leaf<T>};
}

template <>
struct Kind<bool> {
    static constexpr ValueKind kind = leaf_kind<bool>(ValueKind::Shape::flag);
};
template <std::integral T>
struct Kind<T> {
    static constexpr ValueKind kind = leaf_kind<T>(ValueKind::Shape::whole);
};
template <>
struct Kind<double> {
    static constexpr ValueKind kind = leaf_kind<double>(ValueKind::Shape::number);
};
template <>
struct Kind<std::string> {
    static constexpr ValueKind kind = leaf_kind<std::string>(ValueKind::Shape::text);
};

/// These two kinds are printed and never read.
template <>
struct Kind<Duration> {
    static constexpr ValueKind kind{.shape = ValueKind::Shape::time, .get = get_leaf<Duration>};
};
template <>
struct Kind<std::string_view> {
    static constexpr ValueKind kind{.shape = ValueKind::Shape::text,
                                    .get = get_leaf<std::string_view>};
};

template <Named Enum>
struct Kind<Enum> {
    static constexpr ValueKind kind{.shape = ValueKind::Shape::choice,
                                    .names = names_of_enum<Enum>,
                                    .get = get_leaf<Enum>,
                                    .set = set_leaf<Enum>};
};

template <Described T>
struct Kind<T> {
    static constexpr ValueKind kind{.shape = ValueKind::Shape::record, .table = field_table<T>};
};

template <typename T>
struct Kind<std::optional<T>> {
    using Maybe = std::optional<T>;
    static constexpr ValueKind kind{
        .shape = ValueKind::Shape::maybe,
        .element = &Kind<T>::kind,
        .size =
            [](const void* value) {
                return std::size_t{static_cast<const Maybe*>(value)->has_value() ? 1U : 0U};
            },
        .at = [](void* value, std::size_t) -> void* { return &**static_cast<Maybe*>(value); },
        .clear = [](void* value) { static_cast<Maybe*>(value)->reset(); },
        .add = [](void* value) -> void* { return &static_cast<Maybe*>(value)->emplace(T{}); }};
};

/// The kind of a pointer: a maybe that contains the value that it points to.
template <typename T>
struct Kind<const T*> {
    static constexpr ValueKind kind{
        .shape = ValueKind::Shape::maybe,
        .element = &Kind<T>::kind,
        .size =
            [](const void* value) {
                return std::size_t{*static_cast<const T* const*>(value) != nullptr ? 1U : 0U};
            },
        .at = [](void* value, std::size_t) -> void* {
            return const_cast<T*>(*static_cast<const T**>(value)); // NOLINT(*-const-cast): as at()
        }};
};

template <Named Enum, typename T>
struct Kind<ByName<Enum, T>> {
    using Map = ByName<Enum, T>;
    static constexpr ValueKind kind{
        .shape = ValueKind::Shape::map,
        .names = names_of_enum<Enum>,
        .element = &Kind<T>::kind,
        .size = [](const void*) { return names_of_enum<Enum>.size(); },
        .at = [](void* value, std::size_t index) -> void* {
            return &static_cast<Map*>(value)->values[index];
        },
        .name_at = [](const void*, std::size_t index) { return names_of_enum<Enum>[index]; }};
};

template <typename T>
struct Kind<Entries<T>> {
    static constexpr ValueKind kind{
        .shape = ValueKind::Shape::map,
        .element = &Kind<T>::kind,
        .size = [](const void* value) { return static_cast<const Entries<T>*>(value)->size(); },
        .at = [](void* value, std::size_t index) -> void* {
            return &(*static_cast<Entries<T>*>(value))[index].second;
        },
        .name_at = [](const void* value, std::size_t index) -> std::string_view {
            return (*static_cast<const Entries<T>*>(value))[index].first;
        }};
};

/// Returns the kind of a container whose elements have addresses.
template <typename List>
[[nodiscard]] constexpr ValueKind list_kind()
{
    return {.shape = ValueKind::Shape::list,
            .element = &Kind<typename List::value_type>::kind,
            .size = [](const void* value) { return static_cast<const List*>(value)->size(); },
            .at = [](void* value, std::size_t index) -> void* {
                return &(*static_cast<List*>(value))[index];
            }};
}

template <typename T>
inline constexpr bool is_entry = false;
template <typename T>
inline constexpr bool is_entry<std::pair<std::string, T>> = true;

template <typename T>
requires(!std::is_same_v<T, bool> && // vector<bool> has no elements with addresses
         !is_entry<T>) struct Kind<std::vector<T>> {
    static constexpr ValueKind kind = [] {
        ValueKind list = list_kind<std::vector<T>>();
        list.clear = [](void* value) { static_cast<std::vector<T>*>(value)->clear(); };
        list.add = [](void* value) -> void* {
            return &static_cast<std::vector<T>*>(value)->emplace_back();
        };
        return list;
    }();
};

template <typename T, std::size_t size>
struct Kind<std::array<T, size>> {
    static constexpr ValueKind kind = [] {
        ValueKind list = list_kind<std::array<T, size>>();
        list.length = size;
        return list;
    }();
};

} // namespace detail

/// The kind of T's values.
template <typename T>
[[nodiscard]] constexpr const ValueKind& kind_of()
{
    return detail::Kind<T>::kind;
}

} // namespace hapnet::base
