// SPDX-FileCopyrightText: 2026 The Hapnet authors
// SPDX-License-Identifier: MIT
#include "emulator/core/profile/reading.hpp"

#include "emulator/core/loss/trace.hpp"
#include "proto/base/text.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numeric>
#include <spdlog/fmt/fmt.h>

namespace hapnet::emulator {

namespace {

/// How many letters have to be changed, added or left out to make one word of the other
/// (Levenshtein, 1966).
std::size_t distance(std::string_view a, std::string_view b)
{
    std::vector<std::size_t> row(b.size() + 1);
    std::iota(row.begin(), row.end(), std::size_t{0});
    for (std::size_t i = 0; i < a.size(); ++i) {
        std::size_t diagonal = row[0];
        row[0] = i + 1;
        for (std::size_t j = 0; j < b.size(); ++j) {
            const std::size_t replaced = diagonal + (a[i] == b[j] ? 0 : 1);
            diagonal = row[j + 1];
            row[j + 1] = std::min({replaced, row[j] + 1, row[j + 1] + 1});
        }
    }
    return row.back();
}

std::string what_it_is(const Node& node)
{
    if (const auto* boolean = std::get_if<bool>(&node.value)) return *boolean ? "true" : "false";
    if (const auto* integer = std::get_if<std::int64_t>(&node.value)) {
        return fmt::format("{}", *integer);
    }
    if (const auto* real = std::get_if<double>(&node.value)) return fmt::format("{}", *real);
    if (const auto* text = std::get_if<std::string>(&node.value)) return quoted(*text);
    return std::holds_alternative<Node::List>(node.value) ? "a list" : "a table";
}

void complain_of(const Node& node, std::string_view expected, Reading& reading)
{
    reading.complain(node.place,
                     fmt::format("{} stands where {} belongs", what_it_is(node), expected));
}

/// The text of a quantity with a unit; a bare 0 needs none.
std::optional<std::string_view> quantity(const Node& node)
{
    if (const auto* text = std::get_if<std::string>(&node.value)) return *text;
    const auto* integer = std::get_if<std::int64_t>(&node.value);
    if (integer != nullptr && *integer == 0) return "0";
    return std::nullopt;
}

template <typename Target, typename Parse>
void read_quantity(const Node& node, Target& target, Parse parse, Reading& reading)
{
    const auto text = quantity(node);
    const bool is_number = std::holds_alternative<std::int64_t>(node.value) ||
                           std::holds_alternative<double>(node.value);
    // The parser says best what it expects: a number without a unit is wrong text to it.
    if (!text && !is_number) {
        const auto example = parse("?");
        const std::string message = example.error().message;
        return complain_of(node, message.substr(message.find("write ") + 6), reading);
    }
    const auto value = parse(text ? *text : std::string_view{what_it_is(node)});
    if (!value) return reading.complain(node.place, value.error().message);
    target = static_cast<Target>(*value);
}

std::optional<std::uint64_t> count_of(const Node& node, std::uint64_t most)
{
    const auto* integer = std::get_if<std::int64_t>(&node.value);
    if (integer == nullptr || *integer < 0) return std::nullopt;
    const auto count = static_cast<std::uint64_t>(*integer);
    return count <= most ? std::optional{count} : std::nullopt;
}

template <typename Target>
void read_count(const Node& node, Target& target, Reading& reading)
{
    constexpr std::uint64_t most = std::numeric_limits<Target>::max();
    const auto count = count_of(node, most);
    if (!count) return complain_of(node, fmt::format("a whole number from 0 to {}", most), reading);
    target = static_cast<Target>(*count);
}

template <typename T>
std::string list_text(const std::vector<T>& list)
{
    std::string text;
    for (const T& element : list) text += (text.empty() ? "" : ", ") + element;
    return text;
}

} // namespace

void Reading::complain(Place place, std::string_view what)
{
    if (complaint_) return;
    complaint_ = has_lines_ ? fmt::format("{}:{}:{}: {}", source_, place.line, place.column, what)
                            : fmt::format("{}: {}", source_, what);
}

base::Result<std::string> Reading::open(const std::string& name) const
{
    if (!open_) return base::fail("no file can be opened here");
    return open_(name);
}

std::string suggestion(std::string_view word, std::span<const std::string_view> possible)
{
    std::string_view nearest;
    std::size_t least = 1 + word.substr(0, 40).size() / 3;
    std::string all;
    for (const std::string_view candidate : possible) {
        const auto changes = distance(word.substr(0, 40), candidate);
        if (changes <= least && changes < candidate.size()) {
            least = changes - std::min<std::size_t>(changes, 1);
            nearest = candidate;
        }
        all += fmt::format("{}{}", all.empty() ? "" : ", ", candidate);
    }
    if (!nearest.empty()) return fmt::format("did you mean '{}'?", nearest);
    return fmt::format("possible here: {}", all);
}

const Node* TableReader::find(std::string_view key)
{
    known_.push_back(key);
    const auto entry = std::find_if(table_.begin(), table_.end(),
                                    [&](const Entry& one) { return one.key == key; });
    return entry == table_.end() ? nullptr : &entry->value;
}

const Node* TableReader::require(std::string_view key)
{
    const Node* node = find(key);
    if (node == nullptr) reading_.complain(place_, fmt::format("'{}' is missing here", key));
    return node;
}

void TableReader::finish() const
{
    for (const Entry& entry : table_) {
        if (std::find(known_.begin(), known_.end(), entry.key) != known_.end()) continue;
        reading_.complain(entry.place, fmt::format("{} is not known here: {}", quoted(entry.key),
                                                   suggestion(entry.key, known_)));
    }
}

void read_value(const Node& node, base::Duration& target, Reading& reading)
{
    read_quantity(node, target, base::parse_signed_duration, reading);
}

void read_value(const Node& node, base::Probability& target, Reading& reading)
{
    read_quantity(node, target, base::parse_probability, reading);
}

void read_value(const Node& node, double& target, Reading& reading)
{
    if (const auto* integer = std::get_if<std::int64_t>(&node.value)) {
        target = static_cast<double>(*integer);
    } else if (const auto* real = std::get_if<double>(&node.value); real && std::isfinite(*real)) {
        target = *real;
    } else {
        complain_of(node, "a number without a unit, such as 2.5,", reading);
    }
}

void read_value(const Node& node, std::uint8_t& target, Reading& reading)
{
    read_count(node, target, reading);
}

void read_value(const Node& node, std::uint32_t& target, Reading& reading)
{
    read_count(node, target, reading);
}

void read_value(const Node& node, std::string& target, Reading& reading)
{
    const auto* text = std::get_if<std::string>(&node.value);
    if (text == nullptr) return complain_of(node, "a text in quotes", reading);
    target = *text;
}

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

std::string quoted(std::string_view text)
{
    std::string out = "\"";
    for (const char c : text) {
        if (c == '"' || c == '\\') {
            out += '\\';
            out += c;
        } else if (static_cast<unsigned char>(c) < 0x20 || c == 0x7f) {
            out += fmt::format("\\u{:04X}", static_cast<unsigned>(c));
        } else {
            out += c;
        }
    }
    return out + "\"";
}

std::string value_text(base::Duration value) { return quoted(base::to_text(value)); }
std::string value_text(base::Probability value) { return quoted(base::to_text(value)); }
std::string value_text(double value) { return fmt::format("{}", value); }
std::string value_text(std::uint8_t value) { return fmt::format("{}", value); }
std::string value_text(std::uint32_t value) { return fmt::format("{}", value); }
std::string value_text(const std::string& value) { return quoted(value); }

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

std::string value_text(const std::vector<bool>& value) { return quoted(to_text(value)); }

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
    return quoted(counts == Counts::bytes ? base::size_text(value) : base::bit_rate_text(value));
}

std::string table_text(const std::vector<std::string>& entries)
{
    return fmt::format("{{ {} }}", list_text(entries));
}

} // namespace hapnet::emulator
