// SPDX-FileCopyrightText: 2026 The Hapnet authors
// SPDX-License-Identifier: MIT
#pragma once

#include "proto/base/names.hpp"
#include "proto/base/quantity.hpp"
#include "proto/base/reading.hpp"
#include "proto/base/text.hpp"

#include <concepts>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <optional>
#include <spdlog/fmt/fmt.h>
#include <string>
#include <string_view>
#include <vector>

namespace hapnet::base {

// A format defines how the values of a field are written, in TOML and on a command line, and which
// are allowed. A format of T is a small constant with
//     void read(const Node&, T&, Reading&) const;  complains, and leaves the target unchanged
//     std::string print(const T&) const;           TOML that reads back as the same value
//     std::string describe() const;                for people: "a time from 0ms to 10s"
//     std::string example() const;                 optional: an allowed value as TOML, "10ms"
// A format whose values are written in TOML without quotes has `is_bare`.
// Code with its own kind of values defines such a struct beside them.

template <typename Format, typename T>
concept FormatOf = requires(const Format format, const Node& node, T& target, Reading& reading)
{
    format.read(node, target, reading);
    {
        format.print(target)
        } -> std::convertible_to<std::string>;
    {
        format.describe()
        } -> std::convertible_to<std::string>;
};

/// Complains that the value at `node` is outside the range from `min` to `max`. Both are given as
/// text.
void complain_of_range(const Node& node, std::string_view min, std::string_view max,
                       Reading& reading);

/// A time with its unit: "160ms".
struct Time {
    Duration min{0};
    Duration max{Duration::max()};

    void read(const Node& node, Duration& target, Reading& reading) const;
    [[nodiscard]] std::string print(Duration value) const { return value_text(value); }
    [[nodiscard]] std::string example() const;
    [[nodiscard]] std::string describe() const;
};

/// A proportion: "93%".
struct Share {
    void read(const Node& node, Probability& target, Reading& reading) const
    {
        read_value(node, target, reading);
    }
    [[nodiscard]] std::string print(Probability value) const { return value_text(value); }
    [[nodiscard]] std::string example() const { return base::quoted("5%"); }
    [[nodiscard]] std::string describe() const { return "a share from 0% to 100%"; }
};

/// A number without a unit: 2.5.
struct Number {
    static constexpr bool is_bare = true;
    double min = -std::numeric_limits<double>::infinity();
    double max = std::numeric_limits<double>::infinity();

    void read(const Node& node, double& target, Reading& reading) const;
    [[nodiscard]] std::string print(double value) const { return value_text(value); }
    [[nodiscard]] std::string example() const;
    [[nodiscard]] std::string describe() const;
};

/// A physical quantity with its unit: "40mm". The value is kept in SI units.
struct Quantity {
    const QuantityKind& kind;
    double min = -std::numeric_limits<double>::infinity();
    double max = std::numeric_limits<double>::infinity();

    void read(const Node& node, double& target, Reading& reading) const;
    [[nodiscard]] std::string print(double value) const
    {
        return base::quoted(quantity_text(value, kind));
    }
    [[nodiscard]] std::string example() const;
    [[nodiscard]] std::string describe() const;
};

/// A whole number: 40.
struct Count {
    static constexpr bool is_bare = true;
    std::uint64_t min = 0;
    std::uint64_t max = std::numeric_limits<std::int64_t>::max();

    template <std::unsigned_integral T>
    void read(const Node& node, T& target, Reading& reading) const
    {
        const auto value = read_within(node, std::numeric_limits<T>::max(), reading);
        if (value) target = static_cast<T>(*value);
    }
    template <std::unsigned_integral T>
    [[nodiscard]] std::string print(T value) const
    {
        return fmt::format("{}", value);
    }
    [[nodiscard]] std::string example() const;
    [[nodiscard]] std::string describe() const;

private:
    [[nodiscard]] std::optional<std::uint64_t> read_within(const Node& node, std::uint64_t type_max,
                                                           Reading& reading) const;
};

/// Bytes: "64KiB".
struct Size {
    template <std::unsigned_integral T>
    void read(const Node& node, T& target, Reading& reading) const
    {
        read_quantity(node, target, parse_size, reading);
    }
    [[nodiscard]] std::string print(std::uint64_t value) const
    {
        return base::quoted(size_text(value));
    }
    [[nodiscard]] std::string example() const { return base::quoted("64KiB"); }
    [[nodiscard]] std::string describe() const { return "a size such as 1500B or 64KiB"; }
};

/// Bits per second: "10Mbit/s".
struct BitRate {
    void read(const Node& node, std::uint64_t& target, Reading& reading) const
    {
        read_quantity(node, target, parse_bit_rate, reading);
    }
    [[nodiscard]] std::string print(std::uint64_t value) const
    {
        return base::quoted(bit_rate_text(value));
    }
    [[nodiscard]] std::string example() const { return base::quoted("10Mbit/s"); }
    [[nodiscard]] std::string describe() const { return "a rate such as 10Mbit/s"; }
};

/// Any text.
struct Text {
    void read(const Node& node, std::string& target, Reading& reading) const
    {
        read_value(node, target, reading);
    }
    [[nodiscard]] std::string print(const std::string& value) const { return base::quoted(value); }
    [[nodiscard]] std::string example() const { return base::quoted("..."); }
    [[nodiscard]] std::string describe() const { return "a text"; }
};

/// true or false.
struct Flag {
    static constexpr bool is_bare = true;
    void read(const Node& node, bool& target, Reading& reading) const;
    [[nodiscard]] std::string print(bool value) const { return value ? "true" : "false"; }
    [[nodiscard]] std::string example() const { return "true"; }
    [[nodiscard]] std::string describe() const { return "true or false"; }
};

/// One of the names of an enum.
struct Choice {
    template <Named Enum>
    void read(const Node& node, Enum& target, Reading& reading) const
    {
        constexpr auto& names = names_of_enum<Enum>;
        if (const auto index = read_index(node, names, reading)) {
            target = static_cast<Enum>(*index);
        }
    }
    template <Named Enum>
    [[nodiscard]] std::string print(Enum value) const
    {
        return base::quoted(name_of(value));
    }
    [[nodiscard]] std::string describe() const { return "one of the names"; }

private:
    [[nodiscard]] static std::optional<std::size_t>
    read_index(const Node& node, std::span<const std::string_view> names, Reading& reading);
};

/// The format of a list with at least `least` elements. It contains the format of the elements.
template <typename Element>
struct List {
    Element element;
    std::size_t least = 0;

    template <typename T>
    void read(const Node& node, std::vector<T>& target, Reading& reading) const
    {
        const auto* list = std::get_if<Node::List>(&node.value);
        if (list == nullptr || list->size() < least) return complain_of(node, describe(), reading);
        std::vector<T> values;
        for (const Node& one : *list) element.read(one, values.emplace_back(), reading);
        if (reading.is_good()) target = std::move(values);
    }
    template <typename T>
    [[nodiscard]] std::string print(const std::vector<T>& values) const
    {
        std::vector<std::string> texts;
        for (const T& value : values) texts.push_back(element.print(value));
        return fmt::format("[{}]", list_text(texts));
    }
    [[nodiscard]] std::string describe() const { return "a list: each " + element.describe(); }
};

namespace detail {
template <typename T>
struct Held {
    using type = T;
};
template <typename T>
struct Held<std::optional<T>> {
    using type = T;
};
} // namespace detail

/// The type that an optional holds; any other type itself.
template <typename T>
using WithoutOptional = typename detail::Held<T>::type;

/// The format that a field with values of this type has if it names none.
template <typename T>
struct UsualFormat;
template <>
struct UsualFormat<Duration> : Time {};
template <>
struct UsualFormat<Probability> : Share {};
template <>
struct UsualFormat<double> : Number {};
template <>
struct UsualFormat<std::string> : Text {};
template <>
struct UsualFormat<bool> : Flag {};
template <std::unsigned_integral T>
struct UsualFormat<T> : Count {};
template <Named Enum>
struct UsualFormat<Enum> : Choice {};
template <typename T>
struct UsualFormat<std::vector<T>> : List<UsualFormat<T>> {};
template <typename T>
struct UsualFormat<std::optional<T>> : UsualFormat<T> {};

} // namespace hapnet::base
