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
// their errors, and tables of keys (fields.hpp), JSON (fields_json.hpp), CSV (csv.hpp), ramps
// (ramp.hpp), and what programs tell of a run (proto/output) follow from it, so that none of them
// can forget a field:
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

/// A name of Prometheus, and what kind of figure it is. A counter only grows.
struct Metric {
    std::string_view name; // without the unit; empty: the field itself is no metric
    bool is_counter = false;
    std::string_view label; // label of the metrics below this field
};

/// The way in which programs print a field. Words and names are for the readers of the output.
struct Telling {
    /// The words behind a count, in a line for people: "in flight". A map has the names
    /// of its elements there instead.
    std::optional<std::string_view> words;
    bool is_told_always = false; // even a count of 0 is printed
    Metric metric;
    std::optional<int> decimals;      // decimals in JSON; nullopt: as many as needed
    bool is_left_out_if_none = false; // no key without a value; otherwise null
    bool is_without_zeros = false;    // maps in JSON leave out counts that are 0
};

/// The ways to say how a field is printed, for a description that is a `Self`.
template <typename Self>
struct Told {
    Telling telling{};

    /// Printed for people as a line with these words after the count, unless the count is 0.
    [[nodiscard]] constexpr Self told(std::string_view words) const
    {
        return with([&](Telling& t) { t.words = words; });
    }
    /// Like told(), and printed even if the count is 0.
    [[nodiscard]] constexpr Self always_told(std::string_view words) const
    {
        return with([&](Telling& t) { t.words = words, t.is_told_always = true; });
    }
    /// A metric that only grows. Times are in seconds, whatever unit the key has.
    [[nodiscard]] constexpr Self counter(std::string_view name, std::string_view label = {}) const
    {
        return with([&](Telling& t) { t.metric = {name, true, label}; });
    }
    /// A metric that may fall.
    [[nodiscard]] constexpr Self gauge(std::string_view name) const
    {
        return with([&](Telling& t) { t.metric = {name, false, {}}; });
    }
    /// The fields below this one are metrics with this label. The label's value is the field's key,
    /// or the names of a map.
    [[nodiscard]] constexpr Self label(std::string_view label) const
    {
        return with([&](Telling& t) { t.metric = {{}, false, label}; });
    }
    /// JSON has the number with this many decimals.
    [[nodiscard]] constexpr Self rounded(int decimals) const
    {
        return with([&](Telling& t) { t.decimals = decimals; });
    }
    /// JSON has no such key where there is no value, or an empty list.
    [[nodiscard]] constexpr Self left_out_if_none() const
    {
        return with([](Telling& t) { t.is_left_out_if_none = true; });
    }

private:
    template <typename Change>
    [[nodiscard]] constexpr Self with(const Change& change) const
    {
        Self copy = static_cast<const Self&>(*this);
        change(copy.telling);
        return copy;
    }
};

/// A member of a struct: its key, the format of its values, and a few words about it. An optional
/// without a value is left out, or written as `absent`.
template <typename Struct, typename Value, typename Format>
struct Field : Told<Field<Struct, Value, Format>> {
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

    constexpr Field(std::string_view its_key, Value Struct::*its_member, Format its_format,
                    std::string_view its_about)
        : key{its_key}, member{its_member}, format{its_format}, about{its_about}
    {}

    /// This field, as one that a text has to contain.
    [[nodiscard]] constexpr Field required() const
    {
        Field copy = *this;
        copy.is_required = true;
        return copy.always();
    }
    /// This field, printed even if it has its default.
    [[nodiscard]] constexpr Field always() const
    {
        Field copy = *this;
        copy.is_always_printed = true;
        return copy;
    }
    /// This field, printed even if it has its default when the bool member `other` is set.
    [[nodiscard]] constexpr Field if_set(bool Struct::*other) const
    {
        Field copy = *this;
        copy.printed_if = other;
        return copy;
    }
    /// This field, whose missing value is written as a word such as "never".
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
    bool is_without_zeros = false;

    /// This part without counts of 0 in the JSON of its maps.
    [[nodiscard]] constexpr Part without_zeros() const { return {member, true}; }
};

/// A figure that `Compute`, a lambda without captures, computes from the struct. It is printed and
/// never read.
template <typename Struct, typename Compute>
struct Computed : Told<Computed<Struct, Compute>> {
    std::string_view key;
    std::string_view about{};

    constexpr Computed(std::string_view its_key, std::string_view its_about)
        : key{its_key}, about{its_about}
    {}
};

/// A struct with fields of its own that `Compute` finds, which stand among those of the whole.
template <typename Struct, typename Compute>
struct ComputedPart {};

template <typename... Members>
struct Fields {
    std::string_view name; // name of the struct where a text names it: the law of a loss
    std::tuple<Members...> members;
};

namespace detail {

template <typename T>
inline constexpr bool is_part = false;
template <typename Struct, typename Value>
inline constexpr bool is_part<Part<Struct, Value>> = true;

template <typename T>
inline constexpr bool is_computed = false;
template <typename Struct, typename Compute>
inline constexpr bool is_computed<Computed<Struct, Compute>> = true;
template <typename Struct, typename Compute>
inline constexpr bool is_computed<ComputedPart<Struct, Compute>> = true;

} // namespace detail

template <typename Struct, typename Value, typename Format>
requires FormatOf<Format, WithoutOptional<Value>>
[[nodiscard]] constexpr auto field(std::string_view key, Value Struct::*member, Format format,
                                   std::string_view about = {})
{
    return Field<Struct, Value, Format>{key, member, format, about};
}

/// A field with the usual format of the member's type.
template <typename Struct, typename Value>
[[nodiscard]] constexpr auto field(std::string_view key, Value Struct::*member,
                                   std::string_view about = {})
{
    return Field<Struct, Value, UsualFormat<Value>>{key, member, {}, about};
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

/// A figure of a Struct that is not a member: computed<Link>("p50", [](const Link& link) { … }).
/// The lambda returns a value, or a reference to one that lasts as long as the struct.
template <typename Struct, typename Compute>
[[nodiscard]] constexpr auto computed(std::string_view key, Compute /*by its type*/,
                                      std::string_view about = {})
{
    return Computed<Struct, Compute>{key, about};
}

/// Fields of a described struct to which the lambda returns a reference.
template <typename Struct, typename Compute>
[[nodiscard]] constexpr auto computed_part(Compute /*by its type*/)
{
    return ComputedPart<Struct, Compute>{};
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
            if constexpr (requires {
                              requires std::is_same_v<decltype(Member::member), Value T::*>;
                          }) {
                if (member.member == own) words = member.about;
            }
        };
        std::apply([&](const auto&... member) { (look(member), ...); }, description<T>.members);
        return words;
    }(wanted);
}

/// Calls visit(field, member...) for every field of a T that is a member, with that member of each
/// value.
template <typename Visit, typename First, typename... More>
constexpr void for_each_field(const Visit& visit, First&& first, More&&... more)
{
    using T = std::remove_cvref_t<First>;
    const auto one = [&](const auto& member) {
        using Member = std::remove_cvref_t<decltype(member)>;
        if constexpr (detail::is_computed<Member>) {
            // It is no member.
        } else if constexpr (detail::is_part<Member>) {
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
