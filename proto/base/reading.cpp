// SPDX-FileCopyrightText: 2026 The Hapnet authors
// SPDX-License-Identifier: MIT
#include "proto/base/reading.hpp"

#include "proto/base/text.hpp"
#include "proto/base/visible.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numeric>
#include <spdlog/fmt/fmt.h>

namespace hapnet::base {

namespace {

/// Returns the least number of changes that turn one word into the other: a letter changed, added
/// or removed, or two neighbours swapped (Damerau and Levenshtein; each letter takes part in one
/// change).
std::size_t distance(std::string_view a, std::string_view b)
{
    std::vector<std::size_t> before_last(b.size() + 1), last(b.size() + 1), row(b.size() + 1);
    std::iota(row.begin(), row.end(), std::size_t{0});
    for (std::size_t i = 1; i <= a.size(); ++i) {
        before_last.swap(last);
        last.swap(row);
        row[0] = i;
        for (std::size_t j = 1; j <= b.size(); ++j) {
            const std::size_t replaced = last[j - 1] + (a[i - 1] == b[j - 1] ? 0 : 1);
            row[j] = std::min({replaced, row[j - 1] + 1, last[j] + 1});
            const bool is_swapped = i > 1 && j > 1 && a[i - 1] == b[j - 2] && a[i - 2] == b[j - 1];
            if (is_swapped) row[j] = std::min(row[j], before_last[j - 2] + 1);
        }
    }
    return row.back();
}

std::string with_escapes(std::string_view text)
{
    std::string out;
    for (const char c : text) {
        if (c == '"') {
            out += "\\\"";
        } else if (c == '\\') {
            out += "\\\\";
        } else if (static_cast<unsigned char>(c) < 0x20 || c == 0x7f) {
            out += fmt::format("\\u{:04X}", static_cast<unsigned>(c));
        } else {
            out += c;
        }
    }
    return out;
}

template <typename Target>
void read_count(const Node& node, Target& target, Reading& reading)
{
    constexpr std::uint64_t most = std::numeric_limits<Target>::max();
    const auto count = count_of(node, most);
    if (!count) return complain_of(node, fmt::format("a whole number from 0 to {}", most), reading);
    target = static_cast<Target>(*count);
}

} // namespace

tl::expected<Node, DocumentError> parse_option(std::string_view text, bool is_bare)
{
    if (!is_bare && !text.starts_with('{') && !text.starts_with('[')) {
        return Node{{}, std::string{text}};
    }
    auto document = parse_document(fmt::format("value = {}", text));
    // For a word in place of a number, the reader of numbers gives the best error.
    const bool is_text = !text.starts_with('{') && !text.starts_with('[');
    if (!document && is_text) return Node{{}, std::string{text}};
    if (!document) return document;
    auto& table = std::get<Node::Table>(document->value);
    // The text "{} \n more = 1" contains several values.
    if (table.size() != 1) return tl::unexpected{DocumentError{{}, "more than one value"}};
    return std::move(table.front().value);
}

void Reading::complain(Place place, std::string_view what)
{
    if (!complaint_) complain_rather(place, what);
}

void Reading::complain_rather(Place place, std::string_view what)
{
    complaint_ = has_lines_ ? fmt::format("{}:{}:{}: {}", source_, place.line, place.column, what)
                            : fmt::format("{}: {}", source_, what);
}

Result<std::string> Reading::open(const std::string& name) const
{
    if (!open_) {
        return fail("laws that read a file (table, trace) cannot be used here: write the law with "
                    "its parameters");
    }
    return open_(name);
}

Error Reading::trouble_in(const std::string& file, std::string_view what) const
{
    if (open_.is_quoted()) return Error{fmt::format("{}: {}", file, what)};
    const auto end = what.starts_with("line ") ? what.find_first_not_of("0123456789", 5) : 0;
    const auto line = what.substr(0, end);
    return Error{
        fmt::format("{}: {}is not what belongs there", file,
                    line.empty() ? std::string{"what it holds "} : std::string{line} + " ")};
}

std::optional<std::string_view> nearest(std::string_view word,
                                        std::span<const std::string_view> possible)
{
    std::optional<std::string_view> found;
    std::size_t least = 1 + word.substr(0, 40).size() / 3;
    for (const std::string_view candidate : possible) {
        const auto changes = distance(word.substr(0, 40), candidate);
        if (changes > least || changes >= candidate.size()) continue;
        least = changes - std::min<std::size_t>(changes, 1);
        found = candidate;
    }
    return found;
}

std::string suggestion(std::string_view word, std::span<const std::string_view> possible)
{
    if (const auto meant = nearest(word, possible)) {
        return fmt::format("did you mean '{}'?", *meant);
    }
    return fmt::format("use one of {}", fmt::join(possible, ", "));
}

const Node* TableReader::find(std::string_view key)
{
    if (std::find(known_.begin(), known_.end(), key) == known_.end()) known_.push_back(key);
    const auto entry = std::find_if(table_.begin(), table_.end(),
                                    [&](const Entry& one) { return one.key == key; });
    return entry == table_.end() ? nullptr : &entry->value;
}

const Node* TableReader::require(std::string_view key, std::string_view cure)
{
    const Node* node = find(key);
    if (node != nullptr || !reading_.is_good()) return node;
    reading_.complain(place_, cure.empty() ? fmt::format("missing key '{}'", key)
                                           : fmt::format("missing key '{}': {}", key, cure));
    is_missing_told_ = true;
    return node;
}

void TableReader::finish() const
{
    for (const Entry& entry : table_) {
        if (std::find(known_.begin(), known_.end(), entry.key) != known_.end()) continue;
        const std::string advice = reading_.advice_on(entry.key);
        const auto what = fmt::format("unknown key {}: {}", in_quotes(entry.key),
                                      advice.empty() ? suggestion(entry.key, known_) : advice);
        // This key is probably a misspelling of the missing one.
        if (is_missing_told_) return reading_.complain_rather(entry.place, what);
        return reading_.complain(entry.place, what);
    }
}

std::string what_it_is(const Node& node)
{
    if (const auto* boolean = std::get_if<bool>(&node.value)) return *boolean ? "true" : "false";
    if (const auto* integer = std::get_if<std::int64_t>(&node.value)) {
        return fmt::format("{}", *integer);
    }
    // Keeps the decimal point, because 40.0 is not the whole number 40.
    if (const auto* real = std::get_if<double>(&node.value)) return fmt::format("{:#}", *real);
    if (const auto* text = std::get_if<std::string>(&node.value)) return in_quotes(*text);
    return std::holds_alternative<Node::List>(node.value) ? "a list" : "a table";
}

void complain_of(const Node& node, std::string_view expected, Reading& reading)
{
    if (expected.ends_with(',')) expected.remove_suffix(1);
    reading.complain(node.place, fmt::format("expected {}, not {}", expected, what_it_is(node)));
}

std::optional<std::string_view> quantity(const Node& node)
{
    if (const auto* text = std::get_if<std::string>(&node.value)) return *text;
    const auto* integer = std::get_if<std::int64_t>(&node.value);
    if (integer != nullptr && *integer == 0) return "0";
    return std::nullopt;
}

std::optional<std::uint64_t> count_of(const Node& node, std::uint64_t most)
{
    const auto* integer = std::get_if<std::int64_t>(&node.value);
    if (integer == nullptr || *integer < 0) return std::nullopt;
    const auto count = static_cast<std::uint64_t>(*integer);
    return count <= most ? std::optional{count} : std::nullopt;
}

void read_value(const Node& node, Duration& target, Reading& reading)
{
    read_quantity(node, target, parse_signed_duration, reading);
}

void read_value(const Node& node, Probability& target, Reading& reading)
{
    read_quantity(node, target, parse_probability, reading);
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

std::string quoted(std::string_view text) { return '"' + with_escapes(text) + '"'; }

std::string in_quotes(std::string_view text)
{
    std::string doubled;
    for (const char c : text) doubled += c == '\\' ? "\\\\" : std::string{c};
    return "'" + visible(doubled) + "'";
}

std::string value_text(Duration value) { return base::quoted(to_text(value)); }
std::string value_text(Probability value) { return base::quoted(to_text(value)); }
std::string value_text(double value)
{
    // TOML loses the sign of a zero that is written as a whole number.
    return value == 0.0 && std::signbit(value) ? "-0.0" : fmt::format("{}", value);
}
std::string value_text(std::uint8_t value) { return fmt::format("{}", value); }
std::string value_text(std::uint32_t value) { return fmt::format("{}", value); }
std::string value_text(const std::string& value) { return base::quoted(value); }

std::string list_text(const std::vector<std::string>& elements)
{
    std::string text;
    for (const std::string& element : elements) text += (text.empty() ? "" : ", ") + element;
    return text;
}

std::string table_text(const std::vector<std::string>& entries)
{
    return fmt::format("{{ {} }}", list_text(entries));
}

} // namespace hapnet::base
