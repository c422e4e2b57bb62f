// SPDX-FileCopyrightText: 2026 The Hapnet authors
// SPDX-License-Identifier: MIT
#include "proto/base/formats.hpp"

#include <algorithm>
#include <cmath>

namespace hapnet::base {

namespace {

/// Returns "a time from 0ms to 10s", "a time of at least 1ms" or "a time".
std::string within(std::string_view what, const std::string& min, const std::string& max)
{
    if (min.empty() && max.empty()) return std::string{what};
    if (max.empty()) return fmt::format("{} of at least {}", what, min);
    if (min.empty()) return fmt::format("{} of at most {}", what, max);
    return fmt::format("{} from {} to {}", what, min, max);
}

} // namespace

void complain_of_range(const Node& node, std::string_view min, std::string_view max,
                       Reading& reading)
{
    const std::string value = what_it_is(node);
    if (max.empty()) {
        return reading.complain(node.place,
                                fmt::format("{} is too small: use {} or more", value, min));
    }
    if (min.empty()) {
        return reading.complain(node.place,
                                fmt::format("{} is too large: use {} or less", value, max));
    }
    reading.complain(node.place, fmt::format("{} is out of range: use {} to {}", value, min, max));
}

void Time::read(const Node& node, Duration& target, Reading& reading) const
{
    Duration value = target;
    read_value(node, value, reading);
    if (!reading.is_good()) return;
    if (value < min || value > max) {
        return complain_of_range(node, bound_text(min),
                                 max == Duration::max() ? "" : bound_text(max), reading);
    }
    target = value;
}

std::string Time::example() const
{
    constexpr Duration usual{std::chrono::milliseconds{10}};
    return value_text(std::clamp(usual, min, max));
}

std::string Time::describe() const
{
    return within("a time", min == Duration{0} && max == Duration::max() ? "" : to_text(min),
                  max == Duration::max() ? "" : to_text(max));
}

void Number::read(const Node& node, double& target, Reading& reading) const
{
    double value = target;
    read_value(node, value, reading);
    if (!reading.is_good()) return;
    if (!(value >= min && value <= max)) {
        return complain_of_range(node, std::isinf(min) ? "" : fmt::to_string(min),
                                 std::isinf(max) ? "" : fmt::to_string(max), reading);
    }
    target = value;
}

std::string Number::example() const { return value_text(std::clamp(2.5, min, max)); }

std::string Number::describe() const
{
    return within("a number", std::isinf(min) ? "" : fmt::to_string(min),
                  std::isinf(max) ? "" : fmt::to_string(max));
}

void Quantity::read(const Node& node, double& target, Reading& reading) const
{
    double value = target;
    read_quantity(
        node, value, [&](std::string_view text) { return parse_quantity(text, kind); }, reading);
    if (!reading.is_good()) return;
    if (!(value >= min && value <= max)) {
        return complain_of_range(node, std::isinf(min) ? "" : quantity_text(min, kind),
                                 std::isinf(max) ? "" : quantity_text(max, kind), reading);
    }
    target = value;
}

std::string Quantity::example() const
{
    const std::string_view usual = kind.examples.substr(0, kind.examples.find_first_of(", "));
    return print(std::clamp(parse_quantity(usual, kind).value(), min, max));
}

std::string Quantity::describe() const
{
    return within(kind.name, std::isinf(min) ? "" : quantity_text(min, kind),
                  std::isinf(max) ? "" : quantity_text(max, kind));
}

std::optional<std::uint64_t> Count::read_within(const Node& node, std::uint64_t type_max,
                                                Reading& reading) const
{
    const std::uint64_t most = std::min(max, type_max);
    const auto value = count_of(node, most);
    if (value && *value >= min) return value;
    const auto expected = fmt::format("a whole number from {} to {}", min, most);
    const auto* real = std::get_if<double>(&node.value);
    constexpr double exact_max = 9e15; // every whole number below is a double
    if (real != nullptr && *real >= static_cast<double>(min) && *real < exact_max &&
        *real <= static_cast<double>(most) && *real == std::floor(*real)) {
        reading.complain(node.place,
                         fmt::format("expected {} in digits: write {:.0f}", expected, *real));
    } else {
        complain_of(node, expected, reading);
    }
    return std::nullopt;
}

std::string Count::example() const { return print(std::clamp(std::uint64_t{10}, min, max)); }

std::string Count::describe() const
{
    if (max == Count{}.max) return within("a whole number", fmt::to_string(min), "");
    return within("a whole number", fmt::to_string(min), fmt::to_string(max));
}

void Flag::read(const Node& node, bool& target, Reading& reading) const
{
    const auto* value = std::get_if<bool>(&node.value);
    if (value == nullptr) return complain_of(node, "true or false", reading);
    target = *value;
}

std::optional<std::size_t>
Choice::read_index(const Node& node, std::span<const std::string_view> names, Reading& reading)
{
    const auto* text = std::get_if<std::string>(&node.value);
    if (text == nullptr) {
        complain_of(node, fmt::format("one of {}", fmt::join(names, ", ")), reading);
        return std::nullopt;
    }
    const auto found = std::find(names.begin(), names.end(), *text);
    if (found != names.end()) return static_cast<std::size_t>(found - names.begin());
    reading.complain(
        node.place, fmt::format("unknown name {}: {}", in_quotes(*text), suggestion(*text, names)));
    return std::nullopt;
}

} // namespace hapnet::base
