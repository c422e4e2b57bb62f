// SPDX-FileCopyrightText: 2026 The Hapnet authors
// SPDX-License-Identifier: MIT
#include "emulator/core/profile/reading.hpp"

#include "emulator/core/loss/trace.hpp"
#include "proto/base/text.hpp"

#include <limits>
#include <spdlog/fmt/fmt.h>

namespace hapnet::emulator {

void read_value(const Node& node, std::variant<base::Duration, std::uint32_t>& target,
                Reading& reading)
{
    if (std::holds_alternative<std::int64_t>(node.value)) {
        std::uint32_t count = 0;
        read_value(node, count, reading);
        target = count;
    } else {
        base::Duration time{};
        read_value(node, time, reading);
        target = time;
    }
}

void read_value(const Node& node, Displacement& target, Reading& reading)
{
    std::variant<base::Duration, std::uint32_t> value;
    read_value(node, value, reading);
    target = {};
    if (const auto* places = std::get_if<std::uint32_t>(&value)) target.places = *places;
    if (const auto* time = std::get_if<base::Duration>(&value)) target.time = *time;
}

void read_value(const Node& node, std::vector<std::uint64_t>& target, Reading& reading)
{
    const auto* list = std::get_if<Node::List>(&node.value);
    if (list == nullptr) return complain_of(node, "a list of whole numbers", reading);
    target.clear();
    for (const Node& element : *list) {
        const auto count = count_of(element, std::numeric_limits<std::int64_t>::max());
        if (!count) return complain_of(element, "a whole number from 0 on", reading);
        target.push_back(*count);
    }
}

void read_value(const Node& node, std::vector<bool>& target, Reading& reading)
{
    const auto* text = std::get_if<std::string>(&node.value);
    if (text == nullptr) {
        return complain_of(node, "a text of 0 (passes) and 1 (is lost), such as \"0010\",",
                           reading);
    }
    auto pattern = parse_pattern(*text);
    if (!pattern) return reading.complain(node.place, pattern.error().message);
    target = *std::move(pattern);
}

void read_value(const Node& node, std::vector<Window>& target, Reading& reading)
{
    constexpr std::string_view expected =
        "a list of times from and to, such as [[\"10s\", \"12s\"]],";
    const auto* list = std::get_if<Node::List>(&node.value);
    if (list == nullptr) return complain_of(node, expected, reading);
    target.clear();
    for (const Node& element : *list) {
        const auto* pair = std::get_if<Node::List>(&element.value);
        if (pair == nullptr || pair->size() != 2) return complain_of(element, expected, reading);
        Window window;
        read_value((*pair)[0], window.from, reading);
        read_value((*pair)[1], window.to, reading);
        target.push_back(window);
    }
}

void read_whole(const Node& node, std::uint64_t& target, Counts counts, Reading& reading)
{
    if (counts == Counts::bytes) {
        read_quantity(node, target, base::parse_size, reading);
    } else {
        read_quantity(node, target, base::parse_bit_rate, reading);
    }
}

std::string value_text(const std::variant<base::Duration, std::uint32_t>& value)
{
    return std::visit([](const auto& one) { return value_text(one); }, value);
}

std::string value_text(const Displacement& value)
{
    return value.places > 0 ? value_text(value.places) : value_text(value.time);
}

std::string value_text(const std::vector<std::uint64_t>& value)
{
    return fmt::format("[{}]", fmt::join(value, ", "));
}

std::string value_text(const std::vector<bool>& value) { return base::quoted(to_text(value)); }

std::string value_text(const std::vector<Window>& value)
{
    std::vector<std::string> texts;
    for (const Window& window : value) {
        texts.push_back(fmt::format("[{}, {}]", value_text(window.from), value_text(window.to)));
    }
    return fmt::format("[{}]", list_text(texts));
}

std::string whole_value_text(std::uint64_t value, Counts counts)
{
    return base::quoted(counts == Counts::bytes ? base::size_text(value)
                                                : base::bit_rate_text(value));
}

} // namespace hapnet::emulator
