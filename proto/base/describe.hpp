// SPDX-FileCopyrightText: 2026 The Hapnet authors
// SPDX-License-Identifier: MIT
#pragma once

#include "proto/base/formats.hpp"
#include "proto/base/names.hpp"

#include <optional>
#include <string>
#include <string_view>
#include <tuple>
#include <type_traits>

namespace hapnet::base {

// One description of a struct's fields, beside the struct. Reading and printing TOML, ranges and
// their errors, and tables of keys (fields.hpp), JSON (fields_json.hpp), CSV (csv.hpp) and ramps
// (ramp.hpp) follow from it, so that none of them can forget a field:
//
//     struct Burst {
//         std::uint32_t lost = 1;
//         std::uint32_t of = 1;
//         std::optional<std::uint32_t> phase{};
//     };
//     constexpr auto fields_of(base::Tag<Burst>)
//     {
//         return base::fields("burst",
//             base::field("lost", &Burst::lost, base::Count{1}, "datagrams lost in a
//             row").required(), base::field("of", &Burst::of, base::Count{1}, "of every so
//             many").required(), base::field("phase", &Burst::phase, base::Count{}, "where in the
//             cycle the run begins"));
//     }

/// A member of a struct: its key, the format of its values, and a few words about it. An optional
/// without a value is left out, or written as `absent`.
template <typename Struct, typename Value, typename Format>
struct Field {
    using Owner = Struct;
    using Member = Value;

    std::string_view key;
    Value Struct::*member;
    Format format;
    std::string_view about{};
    bool is_required = false;
    std::string_view absent{};
    bool is_always_printed = false;
    bool Struct::*printed_if = nullptr;

    /// The same field, which has to be written.
    [[nodiscard]] constexpr Field required() const
    {
        Field copy = *this;
        copy.is_required = true;
        return copy.always();
    }
    /// The same field, which is printed even if it has its default.
    [[nodiscard]] constexpr Field always() const
    {
        Field copy = *this;
        copy.is_always_printed = true;
        return copy;
    }
    /// The same field, which is printed even if it has its default where another member is set.
    [[nodiscard]] constexpr Field if_set(bool Struct::*other) const
    {
        Field copy = *this;
        copy.printed_if = other;
        return copy;
    }
    /// The same field, whose missing value is written as a word: "never".
    [[nodiscard]] constexpr Field absent_as(std::string_view word) const
    {
        Field copy = *this;
        copy.absent = word;
        return copy;
    }
};

/// A member that is a struct with fields of its own, which stand among those of the whole.
template <typename Struct, typename Value>
struct Part {
    Value Struct::*member;
};

template <typename... Members>
struct Fields {
    std::string_view name; // of the struct where a text names it: the law of a loss
    std::tuple<Members...> members;
};

namespace detail {

template <typename T>
inline constexpr bool is_part = false;
template <typename Struct, typename Value>
inline constexpr bool is_part<Part<Struct, Value>> = true;

} // namespace detail

template <typename Struct, typename Value, typename Format>
requires FormatOf<Format, WithoutOptional<Value>>
[[nodiscard]] constexpr auto field(std::string_view key, Value Struct::*member, Format format,
                                   std::string_view about = {})
{
    return Field<Struct, Value, Format>{key, member, format, about, false, {}};
}

/// With the usual format of the member's type.
template <typename Struct, typename Value>
[[nodiscard]] constexpr auto field(std::string_view key, Value Struct::*member,
                                   std::string_view about = {})
{
    return Field<Struct, Value, UsualFormat<Value>>{key, member, {}, about, false, {}};
}

/// The format of what is not written in TOML: rows of bytes, cells and JSON go by the type.
struct Unwritten {};

/// A member that is not written in TOML.
template <typename Struct, typename Value>
[[nodiscard]] constexpr auto member(std::string_view key, Value Struct::*member,
                                    std::string_view about = {})
{
    return Field<Struct, Value, Unwritten>{key, member, {}, about};
}

template <typename Struct, typename Value>
[[nodiscard]] constexpr auto part(Value Struct::*member)
{
    return Part<Struct, Value>{member};
}

template <typename... Members>
[[nodiscard]] constexpr auto fields(std::string_view name, Members... members)
{
    return Fields<Members...>{name, std::tuple<Members...>{members...}};
}

template <Described T>
inline constexpr auto description = fields_of(Tag<T>{});

/// The name in the description of T.
template <Described T>
inline constexpr std::string_view described_name = description<T>.name;

/// The words about a member: about<&Burst::lost>().
template <auto wanted>
[[nodiscard]] constexpr std::string_view about()
{
    return []<typename T, typename Value>(Value T::*own) {
        std::string_view words;
        const auto look = [&]<typename Member>(const Member& member) {
            if constexpr (std::is_same_v<decltype(Member::member), Value T::*>) {
                if (member.member == own) words = member.about;
            }
        };
        std::apply([&](const auto&... member) { (look(member), ...); }, description<T>.members);
        return words;
    }(wanted);
}

/// Calls visit(field, member...) for every field of a T, with that member of each value.
template <typename Visit, typename First, typename... More>
constexpr void for_each_field(const Visit& visit, First&& first, More&&... more)
{
    using T = std::remove_cvref_t<First>;
    const auto one = [&](const auto& member) {
        if constexpr (detail::is_part<std::remove_cvref_t<decltype(member)>>) {
            for_each_field(visit, first.*member.member, more.*member.member...);
        } else {
            visit(member, first.*member.member, more.*member.member...);
        }
    };
    std::apply([&](const auto&... member) { (one(member), ...); }, description<T>.members);
}

/// The format of a member that is a described struct: a table in the table. fields.hpp has what
/// reads and prints it.
struct Table {
    template <Described T>
    void read(const Node& node, T& target, Reading& reading) const;
    template <Described T>
    [[nodiscard]] std::string print(const T& value) const;
    [[nodiscard]] std::string describe() const { return "a table"; }
};

template <Described T>
struct UsualFormat<T> : Table {};

} // namespace hapnet::base
