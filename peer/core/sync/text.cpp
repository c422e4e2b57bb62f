// SPDX-FileCopyrightText: 2026 The Hapnet authors
// SPDX-License-Identifier: MIT
#include "peer/core/sync/text.hpp"

#include "peer/core/sync/keys.hpp"
#include "proto/base/text.hpp"

#include <algorithm>
#include <spdlog/fmt/fmt.h>
#include <type_traits>

namespace hapnet::peer {

namespace {

using base::Node;
using base::Reading;

constexpr base::Duration parameter_time_max{std::chrono::seconds{10}};

constexpr std::array<std::string_view, 3> algorithm_names{
    Keys<BaseAlgorithm>::name, Keys<DeadReckoning>::name, Keys<EstimatorPredictor>::name};

void read_time(const Node& node, base::Duration& target, Reading& reading)
{
    base::Duration value = target;
    base::read_quantity(node, value, base::parse_duration, reading);
    if (!reading.is_good()) return;
    if (value > parameter_time_max) {
        return reading.complain(
            node.place, fmt::format("{} is out of range: 0 to {} is possible here",
                                    base::what_it_is(node), base::to_text(parameter_time_max)));
    }
    target = value;
}

/// Whether the node is this word.
bool is_word(const Node& node, std::string_view word)
{
    const auto* text = std::get_if<std::string>(&node.value);
    return text != nullptr && *text == word;
}

/// Complains of what is none of the words.
void complain_of_word(const Node& node, std::span<const std::string_view> words, Reading& reading)
{
    if (const auto* text = std::get_if<std::string>(&node.value)) {
        return reading.complain(node.place,
                                fmt::format("{} is not possible here: {}", base::what_it_is(node),
                                            base::suggestion(*text, words)));
    }
    std::string all;
    for (const auto word : words) all += (all.empty() ? "" : ", ") + base::quoted(word);
    base::complain_of(node, fmt::format("one of {}", all), reading);
}

/// A time where a word may stand, too; complains of what is neither.
void read_time_or(std::span<const std::string_view> words, const Node& node, base::Duration& target,
                  Reading& reading)
{
    const auto text = base::quantity(node);
    if (text && base::parse_duration(*text)) return read_time(node, target, reading);
    std::string all;
    for (const auto word : words) all += fmt::format(" or {}", base::quoted(word));
    base::complain_of(node, fmt::format("a time such as \"160ms\"{}", all), reading);
}

// What is read into a member of each type. `key` knows its limits and words.

template <typename Options, typename Enum>
requires std::is_enum_v<Enum>
void read_member(const Key<Options, Enum>& /*key*/, const Node& node, Enum& target,
                 Reading& reading)
{
    constexpr auto& words = Words<Enum>::all;
    const auto* text = std::get_if<std::string>(&node.value);
    const auto found = text == nullptr ? words.end() : std::find(words.begin(), words.end(), *text);
    if (found == words.end()) return complain_of_word(node, words, reading);
    target = static_cast<Enum>(found - words.begin());
}

template <typename Options>
void read_member(const Key<Options, base::Duration>& /*key*/, const Node& node,
                 base::Duration& target, Reading& reading)
{
    read_time(node, target, reading);
}

template <typename Options>
void read_member(const Key<Options, std::optional<base::Duration>>& key, const Node& node,
                 std::optional<base::Duration>& target, Reading& reading)
{
    if (is_word(node, key.absent)) {
        target.reset();
        return;
    }
    base::Duration value{};
    read_time_or(std::array{key.absent}, node, value, reading);
    target = value;
}

template <typename Options>
void read_member(const Key<Options, Horizon>& /*key*/, const Node& node, Horizon& target,
                 Reading& reading)
{
    constexpr auto& words = Words<Horizon::Law>::all;
    for (std::size_t i = 0; i < words.size(); ++i) {
        if (is_word(node, words.at(i))) {
            target = Horizon{static_cast<Horizon::Law>(i), {}};
            return;
        }
    }
    target.law = Horizon::Law::fixed;
    read_time_or(words, node, target.fixed, reading);
}

template <typename Options>
void read_member(const Key<Options, std::uint32_t>& key, const Node& node, std::uint32_t& target,
                 Reading& reading)
{
    const auto most = static_cast<std::uint64_t>(key.limits.most);
    const auto count = base::count_of(node, most);
    if (!count || *count < static_cast<std::uint64_t>(key.limits.least)) {
        return base::complain_of(
            node, fmt::format("a whole number from {:.0f} to {}", key.limits.least, most), reading);
    }
    target = static_cast<std::uint32_t>(*count);
}

template <typename Options>
void read_member(const Key<Options, double>& key, const Node& node, double& target,
                 Reading& reading)
{
    const auto parse = [&](std::string_view text) { return base::parse_quantity(text, *key.kind); };
    double value = target;
    base::read_quantity(node, value, parse, reading);
    if (!reading.is_good()) return;
    if (!(value >= key.limits.least && value <= key.limits.most)) {
        return reading.complain(node.place,
                                fmt::format("{} is out of range: {} to {} is possible here",
                                            base::what_it_is(node),
                                            base::quantity_text(key.limits.least, *key.kind),
                                            base::quantity_text(key.limits.most, *key.kind)));
    }
    target = value;
}

template <typename Options, typename Value>
std::string text_of(const Key<Options, Value>& key, const Value& value)
{
    if constexpr (std::is_enum_v<Value>) {
        return base::quoted(Words<Value>::all.at(static_cast<std::size_t>(value)));
    } else if constexpr (std::is_same_v<Value, Horizon>) {
        if (value.law == Horizon::Law::fixed) return base::value_text(value.fixed);
        return base::quoted(Words<Horizon::Law>::all.at(static_cast<std::size_t>(value.law)));
    } else if constexpr (std::is_same_v<Value, std::optional<base::Duration>>) {
        return value ? base::value_text(*value) : base::quoted(key.absent);
    } else if constexpr (std::is_same_v<Value, double>) {
        return base::quoted(base::quantity_text(value, *key.kind));
    } else {
        return base::value_text(value);
    }
}

/// What else may stand there, for a person.
template <typename Options, typename Value>
std::string choice_of(const Key<Options, Value>& key)
{
    std::string text;
    const auto add = [&text](std::string_view word) {
        text += fmt::format("{}{}", text.empty() ? "; " : " | ", word);
    };
    if constexpr (std::is_enum_v<Value>) {
        for (const auto word : Words<Value>::all) add(word);
    } else if constexpr (std::is_same_v<Value, Horizon>) {
        for (const auto word : Words<Horizon::Law>::all) add(word);
    } else if constexpr (std::is_same_v<Value, std::optional<base::Duration>>) {
        add(key.absent);
        add("a time");
    }
    return text;
}

/// The keys of this tuple that the table has.
template <typename Options, typename Tuple>
void read_keys(base::TableReader& table, Options& options, const Tuple& keys)
{
    [[maybe_unused]] const auto read = [&](const auto& key) {
        if (const Node* node = table.find(key.key)) {
            read_member(key, *node, options.*key.member, table.reading());
        }
    };
    std::apply([&](const auto&... key) { (read(key), ...); }, keys);
}

template <typename Options>
BaseOptions& base_of(Options& options)
{
    return options.base;
}
BaseOptions& base_of(BaseOptions& options) { return options; }

template <typename One>
Algorithm read_parameters(base::TableReader& table)
{
    typename Keys<One>::Options options;
    read_keys(table, options, Keys<One>::own);
    read_keys(table, base_of(options), base_keys);
    return Algorithm{std::in_place_type<One>, options};
}

/// One line for every key.
template <typename Options, typename Tuple>
void print_keys(std::string& text, const Options& options, const Tuple& keys, bool explained)
{
    [[maybe_unused]] const auto print = [&](const auto& key) {
        const std::string line = fmt::format("{} = {}", key.key, text_of(key, options.*key.member));
        text += explained ? fmt::format("{:<42} # {}{}\n", line, key.about, choice_of(key))
                          : line + "\n";
    };
    std::apply([&](const auto&... key) { (print(key), ...); }, keys);
}

std::string printed(const Algorithm& algorithm, bool explained)
{
    std::string text = fmt::format("algorithm = {}\n", base::quoted(name_of(algorithm)));
    std::visit([&]<typename One>(
                   const One& one) { print_keys(text, one.options(), Keys<One>::own, explained); },
               algorithm);
    print_keys(text, base_options(algorithm), base_keys, explained);
    return text;
}

std::optional<Algorithm> read_table(const Node& node, const Node::Table& entries, Reading& reading)
{
    base::TableReader table{entries, node.place, reading};
    const Node* name_node = table.require("algorithm");
    if (name_node == nullptr) return std::nullopt;
    std::string name;
    base::read_value(*name_node, name, reading);
    if (!reading.is_good()) return std::nullopt;
    std::optional<Algorithm> algorithm;
    if (name == Keys<BaseAlgorithm>::name) {
        algorithm = read_parameters<BaseAlgorithm>(table);
    } else if (name == Keys<DeadReckoning>::name) {
        algorithm = read_parameters<DeadReckoning>(table);
    } else if (name == Keys<EstimatorPredictor>::name) {
        algorithm = read_parameters<EstimatorPredictor>(table);
    } else {
        reading.complain(name_node->place,
                         fmt::format("{} is not an algorithm: {}", base::quoted(name),
                                     base::suggestion(name, algorithm_names)));
        return std::nullopt;
    }
    table.finish();
    if (!reading.is_good()) return std::nullopt;
    return algorithm;
}

} // namespace

std::optional<Algorithm> read_algorithm(const Node& node, Reading& reading)
{
    if (const auto* entries = std::get_if<Node::Table>(&node.value)) {
        return read_table(node, *entries, reading);
    }
    const auto* text = std::get_if<std::string>(&node.value);
    if (text == nullptr) {
        base::complain_of(node, "the name of an algorithm or a table of its parameters", reading);
        return std::nullopt;
    }
    const auto open = [&reading](const std::string& file) { return reading.open(file); };
    const auto algorithm = load_algorithm(*text, open);
    if (algorithm) return *algorithm;
    reading.complain(node.place, algorithm.error().message);
    return std::nullopt;
}

base::Result<Algorithm> parse_algorithm(std::string_view text, const std::string& source)
{
    Reading reading{source};
    std::optional<Algorithm> algorithm;
    if (const auto document = base::parse_document(text)) {
        algorithm = read_algorithm(*document, reading);
    } else {
        reading.complain(document.error().place, document.error().message);
    }
    if (!algorithm) return base::fail(*reading.complaint());
    return *algorithm;
}

base::Result<Algorithm> load_algorithm(const std::string& name_or_file, const base::OpenFile& open)
{
    const bool is_file =
        name_or_file.find('/') != std::string::npos || name_or_file.ends_with(".toml");
    if (!is_file) return algorithm_named(name_or_file);
    const auto text = open(name_or_file);
    if (!text) return tl::unexpected{text.error()};
    return parse_algorithm(*text, name_or_file);
}

std::string print_algorithm(const Algorithm& algorithm) { return printed(algorithm, false); }

std::string explain_algorithm(const Algorithm& algorithm) { return printed(algorithm, true); }

std::string_view name_of(const Algorithm& algorithm)
{
    return algorithm_names.at(algorithm.index());
}

} // namespace hapnet::peer
