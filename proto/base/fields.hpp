// SPDX-FileCopyrightText: 2026 The Hapnet authors
// SPDX-License-Identifier: MIT
#pragma once

#include "proto/base/formats.hpp"
#include "proto/base/names.hpp"
#include "proto/base/reading.hpp"

#include <algorithm>
#include <cmath>
#include <optional>
#include <string>
#include <string_view>
#include <tuple>
#include <type_traits>
#include <utility>
#include <variant>
#include <vector>

namespace hapnet::base {

// One description of a struct's fields, beside the struct. Reading and printing TOML, ranges and
// their errors, JSON (fields_json.hpp), CSV (csv.hpp), ramps and tables of keys follow from it, so
// that none of them can forget a field:
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

/// A struct with a description.
template <typename T>
concept Described = requires
{
    fields_of(Tag<T>{});
};

namespace detail {

template <typename T>
struct WithoutOptional {
    using type = T;
};
template <typename T>
struct WithoutOptional<std::optional<T>> {
    using type = T;
};

template <typename T>
inline constexpr bool is_optional = !std::is_same_v<T, typename WithoutOptional<T>::type>;

template <typename T>
inline constexpr bool is_part = false;
template <typename Struct, typename Value>
inline constexpr bool is_part<Part<Struct, Value>> = true;

} // namespace detail

template <typename Struct, typename Value, typename Format>
requires FormatOf<Format, typename detail::WithoutOptional<Value>::type>
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

// Reading.

/// One member from its value in a text.
template <typename Struct, typename Value, typename Format>
void read_field(const Field<Struct, Value, Format>& field, const Node& node, Value& target,
                Reading& reading)
{
    if constexpr (detail::is_optional<Value>) {
        const auto* word = std::get_if<std::string>(&node.value);
        if (!field.absent.empty() && word != nullptr && *word == field.absent) {
            target.reset();
            return;
        }
        auto value = target.value_or(typename Value::value_type{});
        field.format.read(node, value, reading);
        if (reading.is_good()) target = std::move(value);
    } else {
        field.format.read(node, target, reading);
    }
}

/// What to write into a field that is missing: `write sd = "10ms"`, or the names to choose from.
template <typename Struct, typename Value, typename Format>
[[nodiscard]] std::string cure_of_missing(const Field<Struct, Value, Format>& field)
{
    using Plain = typename detail::WithoutOptional<Value>::type;
    if constexpr (Named<Plain>) {
        return fmt::format("use one of {}", fmt::join(names_of_enum<Plain>, ", "));
    } else if constexpr (requires { field.format.example(); }) {
        return fmt::format("write {} = {}", field.key, field.format.example());
    } else {
        return fmt::format("expected {}", field.format.describe());
    }
}

/// The fields that stand in a table; the others keep their values. Complains of missing required
/// ones. The table may have other keys: finish() is left to the caller.
template <Described T>
void read_fields(TableReader& table, T& target)
{
    for_each_field(
        [&](const auto& field, auto& member) {
            const Node* node = table.find(field.key);
            if (node == nullptr && field.is_required) {
                std::ignore = table.require(field.key, cure_of_missing(field));
            }
            if (node != nullptr) read_field(field, *node, member, table.reading());
        },
        target);
}

/// The fields of a table that has no other keys.
template <Described T>
void read_table(const Node& node, T& target, Reading& reading)
{
    const auto* entries = std::get_if<Node::Table>(&node.value);
    if (entries == nullptr) return complain_of(node, "a table", reading);
    TableReader table{*entries, node.place, reading};
    read_fields(table, target);
    table.finish();
}

// Printing.

/// Which fields are printed: all, or those that are required or differ from the default.
enum class Print { all, needed };

/// The value of one field as TOML; nullopt: an optional without a value.
template <typename Struct, typename Value, typename Format>
[[nodiscard]] std::optional<std::string> field_text(const Field<Struct, Value, Format>& field,
                                                    const Value& value)
{
    if constexpr (detail::is_optional<Value>) {
        if (value) return field.format.print(*value);
        if (field.absent.empty()) return std::nullopt;
        return base::quoted(field.absent);
    } else {
        return field.format.print(value);
    }
}

/// `half_width = "15ms"`, one text for each field that is printed. A value differs from the default
/// when it is written otherwise: so does the zero with a sign.
template <Described T>
[[nodiscard]] std::vector<std::string> field_texts(const T& value, Print print = Print::all)
{
    const T defaults{};
    std::vector<std::string> texts;
    for_each_field(
        [&](const auto& field, const auto& member, const auto& usual) {
            using Own = std::remove_cvref_t<decltype(field)>;
            const auto text = field_text(field, member);
            bool is_printed = print == Print::all || field.is_always_printed;
            if constexpr (std::is_same_v<typename Own::Owner, T>) {
                is_printed |= field.printed_if != nullptr && value.*field.printed_if;
            }
            if (text && (is_printed || text != field_text(field, usual))) {
                texts.push_back(fmt::format("{} = {}", field.key, *text));
            }
        },
        value, defaults);
    return texts;
}

/// The same, a line each; those of a struct in the struct have dotted keys: `reflex.gain = 0.5`.
template <Described T>
[[nodiscard]] std::string field_lines(const T& value, const std::string& prefix = {});

/// A member that is a described struct: a table in the table.
struct Table {
    template <Described T>
    void read(const Node& node, T& target, Reading& reading) const
    {
        T value = target;
        read_table(node, value, reading);
        if (reading.is_good()) target = std::move(value);
    }
    template <Described T>
    [[nodiscard]] std::string print(const T& value) const
    {
        return table_text(field_texts(value));
    }
    [[nodiscard]] std::string describe() const { return "a table"; }
};

template <Described T>
struct UsualFormat<T> : Table {};

template <Described T>
std::string field_lines(const T& value, const std::string& prefix)
{
    std::string lines;
    for_each_field(
        [&](const auto& field, const auto& member) {
            using Member = std::remove_cvref_t<decltype(member)>;
            const std::string key = prefix + std::string{field.key};
            if constexpr (Described<Member>) {
                lines += field_lines(member, key + '.');
            } else if (const auto text = field_text(field, member)) {
                lines += key + " = " + *text + '\n';
            }
        },
        value);
    return lines;
}

// What people read of a description.

/// A row of a table of keys.
struct KeyRow {
    std::string key;
    std::string values;     // what may be written: "a time from 0ms to 10s"
    std::string by_default; // as it is written, or "required"; empty: there is none
    std::string about;

    static constexpr std::string_view required = "required";
};

/// What may be written into a field, for people.
template <typename Struct, typename Value, typename Format>
[[nodiscard]] std::string allowed(const Field<Struct, Value, Format>& field)
{
    using Plain = typename detail::WithoutOptional<Value>::type;
    std::string text;
    if constexpr (Named<Plain>) {
        for (const std::string_view name : names_of_enum<Plain>) {
            text += fmt::format("{}`{}`", text.empty() ? "" : ", ", base::quoted(name));
        }
    } else {
        text = field.format.describe();
    }
    if (!field.absent.empty()) text += fmt::format(", or `{}`", base::quoted(field.absent));
    return text;
}

template <Described T>
[[nodiscard]] std::vector<KeyRow> key_rows(const std::string& prefix = {}, const T& defaults = {})
{
    std::vector<KeyRow> rows;
    for_each_field(
        [&](const auto& field, const auto& usual) {
            using Member = std::remove_cvref_t<decltype(usual)>;
            const std::string key = prefix + std::string{field.key};
            using Plain = typename detail::WithoutOptional<Member>::type;
            if constexpr (Described<Plain>) {
                Plain own{};
                if constexpr (!detail::is_optional<Member>) own = usual;
                auto about = field.about;
                if (about.ends_with('.')) about.remove_suffix(1);
                for (KeyRow& inner : key_rows<Plain>(key + '.', own)) {
                    if (!about.empty()) inner.about = fmt::format("{}: {}", about, inner.about);
                    rows.push_back(std::move(inner));
                }
            } else {
                // What is printed where another member is set has no default there.
                const bool has_default = !field.is_required && field.printed_if == nullptr;
                std::string by_default{field.is_required ? KeyRow::required : ""};
                if (has_default) by_default = field_text(field, usual).value_or("");
                rows.push_back({key, allowed(field), by_default, std::string{field.about}});
            }
        },
        defaults);
    return rows;
}

/// Rows as a table of Markdown, as it stands in the docs.
[[nodiscard]] std::string markdown(const std::vector<KeyRow>& rows);

// Ramps: the value between two, at `progress` from 0 (a) to 1 (b); nullopt when there is none.

[[nodiscard]] inline std::optional<double> between(double a, double b, double progress)
{
    return a + (b - a) * progress;
}

[[nodiscard]] inline std::optional<Duration> between(Duration a, Duration b, double progress)
{
    return a + Duration{std::llround(static_cast<double>((b - a).count()) * progress)};
}

[[nodiscard]] inline std::optional<Probability> between(Probability a, Probability b,
                                                        double progress)
{
    const double fraction = a.fraction() + (b.fraction() - a.fraction()) * progress;
    return Probability::from_fraction(std::clamp(fraction, 0.0, 1.0));
}

/// A number of things, not a small code or a truth value.
template <typename T>
concept Whole = std::unsigned_integral<T> && sizeof(T) > 1;

template <Whole T>
[[nodiscard]] std::optional<T> between(T a, T b, double progress)
{
    const auto from = static_cast<double>(a);
    return static_cast<T>(std::llround(from + (static_cast<double>(b) - from) * progress));
}

/// What has nothing in between goes only from itself to itself.
template <typename T>
requires(!Described<T> && !Whole<T>)
    [[nodiscard]] std::optional<T> between(const T& a, const T& b, double /*progress*/)
{
    return a == b ? std::optional<T>{b} : std::nullopt;
}

template <typename T>
[[nodiscard]] std::optional<std::optional<T>> between(const std::optional<T>& a,
                                                      const std::optional<T>& b, double progress)
{
    using Between = std::optional<std::optional<T>>;
    if (!a || !b) return a == b ? Between{std::in_place, b} : Between{};
    const auto value = between(*a, *b, progress);
    return value ? Between{std::in_place, *value} : Between{};
}

/// Within one alternative.
template <typename... Types>
[[nodiscard]] std::optional<std::variant<Types...>>
between(const std::variant<Types...>& a, const std::variant<Types...>& b, double progress);

/// Field by field.
template <Described T>
[[nodiscard]] std::optional<T> between(const T& a, const T& b, double progress)
{
    T result = b;
    bool is_possible = true;
    for_each_field(
        [&](const auto& /*field*/, auto& target, const auto& from, const auto& to) {
            const auto value = between(from, to, progress);
            is_possible = is_possible && value.has_value();
            if (value) target = *value;
        },
        result, a, b);
    return is_possible ? std::optional<T>{result} : std::nullopt;
}

template <typename... Types>
std::optional<std::variant<Types...>> between(const std::variant<Types...>& a,
                                              const std::variant<Types...>& b, double progress)
{
    if (a.index() != b.index()) return std::nullopt;
    return std::visit(
        [&]<typename Own>(const Own& to) -> std::optional<std::variant<Types...>> {
            auto value = between(std::get<Own>(a), to, progress);
            if (!value) return std::nullopt;
            return *std::move(value);
        },
        b);
}

} // namespace hapnet::base
