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

// A description of a struct's fields, written once beside the struct. Everything else is derived
// from it, so that no code can forget a field: TOML with ranges, errors and tables of keys
// (fields.hpp), JSON (fields_json.hpp), CSV (csv.hpp), ramps (ramp.hpp), and the reports of
// programs on a run (proto/output).
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

/// The name of a Prometheus metric, and its type: a counter only grows.
struct Metric {
    std::string_view name; // without the unit; empty: the field itself is not a metric
    bool is_counter = false;
    std::string_view label; // label of the metrics below this field
};

/// The way in which programs print a field. Words and names are for the readers of the output.
struct Telling {
    /// The words after the count in a line for people: "in flight". In a map, the names of its
    /// elements take their place.
    std::optional<std::string_view> words;
    bool is_told_always = false; // a count of 0 is printed, too
    Metric metric;
    std::optional<int> decimals;      // decimals in JSON; nullopt: as many as needed
    bool is_left_out_if_none = false; // no key if there is no value; false: null
    bool is_without_zeros = false;    // maps in JSON leave out counts that are 0
};

/// Functions that set how a field is printed, for a description of type `Self`.
template <typename Self>
struct Told {
    Telling telling{};

    /// Prints the field for people as a count followed by these words, unless the count is 0.
    [[nodiscard]] constexpr Self told(std::string_view words) const
    {
        return with([&](Telling& t) { t.words = words; });
    }
    /// Prints the field like told(), even if the count is 0.
    [[nodiscard]] constexpr Self always_told(std::string_view words) const
    {
        return with([&](Telling& t) { t.words = words, t.is_told_always = true; });
    }
    /// Makes the field a metric that only grows. Times are in seconds, in whatever unit the key is.
    [[nodiscard]] constexpr Self counter(std::string_view name, std::string_view label = {}) const
    {
        return with([&](Telling& t) { t.metric = {name, true, label}; });
    }
    /// Makes the field a metric that may fall.
    [[nodiscard]] constexpr Self gauge(std::string_view name) const
    {
        return with([&](Telling& t) { t.metric = {name, false, {}}; });
    }
    /// Gives this label to the metrics below this field. The label's value is the key of this
    /// field, or, if it is a map, the name of the element.
    [[nodiscard]] constexpr Self label(std::string_view label) const
    {
        return with([&](Telling& t) { t.metric = {{}, false, label}; });
    }
    /// Writes the number in JSON with this many decimals.
    [[nodiscard]] constexpr Self rounded(int decimals) const
    {
        return with([&](Telling& t) { t.decimals = decimals; });
    }
    /// Leaves the key out of the JSON if there is no value, or the list is empty.
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

/// A member of a struct, with its key, the format of its values, and a short description. An
/// optional without a value is left out, or written as the word `absent`.
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

    /// Returns this field, marked as one that a text must contain.
    [[nodiscard]] constexpr Field required() const
    {
        Field copy = *this;
        copy.is_required = true;
        return copy.always();
    }
    /// Returns this field, marked to be printed even if it has its default.
    [[nodiscard]] constexpr Field always() const
    {
        Field copy = *this;
        copy.is_always_printed = true;
        return copy;
    }
    /// Returns this field, marked to be printed even if it has its default, provided that the bool
    /// member `other` is true.
    [[nodiscard]] constexpr Field if_set(bool Struct::*other) const
    {
        Field copy = *this;
        copy.printed_if = other;
        return copy;
    }
    /// Returns this field, whose missing value is written as a word such as "never".
    [[nodiscard]] constexpr Field absent_as(std::string_view word) const
    {
        Field copy = *this;
        copy.absent = word;
        return copy;
    }
};

/// A member that is a described struct. Its fields are listed among those of the outer struct.
template <typename Struct, typename Value>
struct Part {
    Value Struct::*member;
    bool is_without_zeros = false;

    /// Returns this part. The JSON of its maps leaves out counts of 0.
    [[nodiscard]] constexpr Part without_zeros() const { return {member, true}; }
};

/// A figure that `Compute`, a lambda without captures, computes from the struct. It is printed but
/// never read.
template <typename Struct, typename Compute>
struct Computed : Told<Computed<Struct, Compute>> {
    std::string_view key;
    std::string_view about{};

    constexpr Computed(std::string_view its_key, std::string_view its_about)
        : key{its_key}, about{its_about}
    {}
};

/// A described struct that `Compute` finds. Its fields are listed among those of the outer struct.
template <typename Struct, typename Compute>
struct ComputedPart {};

template <typename... Members>
struct Fields {
    std::string_view name; // name of the struct, if texts contain it: the law of a loss
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

/// Describes a field with the usual format of the member's type.
template <typename Struct, typename Value>
[[nodiscard]] constexpr auto field(std::string_view key, Value Struct::*member,
                                   std::string_view about = {})
{
    return Field<Struct, Value, UsualFormat<Value>>{key, member, {}, about};
}

/// The format of a member that is not written in TOML. Rows of bytes, CSV cells and JSON depend on
/// the type alone.
struct Unwritten {};

/// Describes a member that is not written in TOML.
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

/// Describes a figure of a Struct that is not a member: computed<Link>("p50", [](const Link& link)
/// { … }). The lambda returns a value, or a reference to a value that lasts as long as the struct.
template <typename Struct, typename Compute>
[[nodiscard]] constexpr auto computed(std::string_view key, Compute /*by its type*/,
                                      std::string_view about = {})
{
    return Computed<Struct, Compute>{key, about};
}

/// Describes the fields of a described struct to which the lambda returns a reference.
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

/// The name that the description of T gives.
template <Described T>
inline constexpr std::string_view described_name = description<T>.name;

/// Returns the short description of a member: about<&Burst::lost>().
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

/// Calls visit(field, member...) for every field of a T that is a member. `member...` are that
/// member of each of the values.
template <typename Visit, typename First, typename... More>
constexpr void for_each_field(const Visit& visit, First&& first, More&&... more)
{
    using T = std::remove_cvref_t<First>;
    const auto one = [&](const auto& member) {
        using Member = std::remove_cvref_t<decltype(member)>;
        if constexpr (detail::is_computed<Member>) {
            // A computed figure is not a member.
        } else if constexpr (detail::is_part<Member>) {
            for_each_field(visit, first.*member.member, more.*member.member...);
        } else {
            visit(member, first.*member.member, more.*member.member...);
        }
    };
    std::apply([&](const auto&... member) { (one(member), ...); }, description<T>.members);
}

/// The format of a member that is a described struct: a nested table. fields.hpp has the functions
/// that read and print it.
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
