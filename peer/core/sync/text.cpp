// SPDX-FileCopyrightText: 2026 The Hapnet authors
// SPDX-License-Identifier: MIT
#include "peer/core/sync/text.hpp"

#include "proto/base/built_in.hpp"
#include "proto/base/fields.hpp"
#include "proto/base/text.hpp"

#include <span>
#include <spdlog/fmt/fmt.h>
#include <type_traits>
#include <utility>
#include <vector>

namespace hapnet::peer {

namespace {

using base::Node;
using base::Reading;

template <typename One>
using OptionsOf = std::remove_cvref_t<decltype(std::declval<One>().options())>;

/// Returns the words that a field accepts besides a number, for people: "; drop | take".
std::string choices(const base::FieldRow& row)
{
    std::vector<std::string_view> words;
    if (row.kind->shape == base::ValueKind::Shape::choice) {
        words.assign(row.kind->names.begin(), row.kind->names.end());
    } else if (row.kind == &base::kind_of<Horizon>()) {
        words.assign(horizon_names.begin(), horizon_names.end());
    } else if (!row.absent.empty()) {
        words = {row.absent, "a time"};
    }
    return words.empty() ? "" : fmt::format("; {}", fmt::join(words, " | "));
}

/// Returns a line for every parameter, with a short description.
template <base::Described Options>
std::string explained(const Options& options)
{
    std::string text;
    for (const base::FieldRow& row : base::field_table<Options>().rows) {
        // A parameter always has a text, because an absent value is written as a word.
        const std::string line = fmt::format("{} = {}", row.key, *base::field_text(row, &options));
        text += fmt::format("{:<42} # {}{}\n", line, row.about, choices(row));
    }
    return text;
}

std::string algorithm_line(const Algorithm& algorithm)
{
    return fmt::format("algorithm = {}\n", base::quoted(name_of(algorithm)));
}

template <typename One>
Algorithm read_parameters(base::TableReader& table)
{
    OptionsOf<One> options;
    base::read_fields(table, options);
    return Algorithm{std::in_place_type<One>, options};
}

std::optional<Algorithm> read_table(const Node& node, const Node::Table& entries, Reading& reading)
{
    base::TableReader table{entries, node.place, reading};
    const Node* name_node = table.require("algorithm");
    if (name_node == nullptr) return std::nullopt;
    std::string name;
    base::read_value(*name_node, name, reading);
    if (!reading.is_good()) return std::nullopt;
    const auto named = algorithm_named(name);
    if (!named) {
        reading.complain(name_node->place, named.error().message);
        return std::nullopt;
    }
    const Algorithm algorithm =
        std::visit([&]<typename One>(const One&) { return read_parameters<One>(table); }, *named);
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
    return base::parse_text(text, source, [](const Node& node, Reading& reading) {
        return read_algorithm(node, reading).value_or(Algorithm{});
    });
}

base::Result<Algorithm> load_algorithm(const std::string& file_or_name, const base::OpenFile& open)
{
    if (file_or_name.ends_with(".so")) return SharedObject{SharedObjectOptions{file_or_name, {}}};
    std::vector<base::BuiltInText> plain;
    for (const std::string_view name : algorithm_names) {
        plain.push_back({name, fmt::format("algorithm = {}", base::quoted(name))});
    }
    const std::span<const base::BuiltInText> all{plain};
    const auto found = base::find_text(file_or_name, all, "an algorithm", open);
    if (!found) return tl::unexpected{found.error()};
    return parse_algorithm(found->text, found->source);
}

std::string print_algorithm(const Algorithm& algorithm)
{
    const auto lines = [](const auto& one) { return base::field_lines(one.options()); };
    return algorithm_line(algorithm) + std::visit(lines, algorithm);
}

std::string explain_algorithm(const Algorithm& algorithm)
{
    const auto lines = [](const auto& one) { return explained(one.options()); };
    const auto is_of_paper = [](const auto& one) {
        using Options = std::remove_cvref_t<decltype(one.options())>;
        return std::is_same_v<Options, BaseOptions> || requires { one.options().base; };
    };
    const bool has_gaps = std::visit(is_of_paper, algorithm);
    return algorithm_line(algorithm) + std::visit(lines, algorithm) +
           (has_gaps ? "# (A1) to (A11): docs/design/algorithms.md\n"
                     : "# docs/design/algorithms.md\n");
}

} // namespace hapnet::peer
