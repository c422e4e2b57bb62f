// SPDX-FileCopyrightText: 2026 The Hapnet authors
// SPDX-License-Identifier: MIT
#include "lab/experiment/patch.hpp"

#include <algorithm>
#include <spdlog/fmt/fmt.h>
#include <string>
#include <utility>

namespace hapnet::lab::experiment {

namespace {

using base::Entry;
using base::Node;

/// The greatest depth of a key. No key of an experiment is that deep, and at this depth no text can
/// exhaust the stack.
constexpr std::size_t key_parts_max = 8;

Node::Table::iterator entry_of(Node::Table& table, std::string_view key)
{
    return std::find_if(table.begin(), table.end(),
                        [&](const Entry& entry) { return entry.key == key; });
}

/// Reads a value: a text without quotes, or a number, a truth value, a list or a table in TOML.
base::Result<Node> value_of(std::string_view text)
{
    auto document = base::parse_document(fmt::format("value = {}", text));
    // A text such as "1 \n more = 2" would be several values.
    if (document && std::get<Node::Table>(document->value).size() == 1) {
        return std::move(std::get<Node::Table>(document->value).front().value);
    }
    if (text.starts_with('[') || text.starts_with('{') || text.starts_with('"')) {
        const auto why = document ? "more than one value" : document.error().message;
        return base::fail(fmt::format("not TOML ({}): write a list as [\"T1\", \"T3\"]", why));
    }
    return Node{{}, std::string{text}};
}

} // namespace

void overlay(base::Node& under, const base::Node& over)
{
    auto& table = std::get<Node::Table>(under.value);
    for (const Entry& entry : std::get<Node::Table>(over.value)) {
        const auto found = entry_of(table, entry.key);
        if (found == table.end()) {
            table.push_back(entry);
        } else if (std::holds_alternative<Node::Table>(found->value.value) &&
                   std::holds_alternative<Node::Table>(entry.value.value)) {
            overlay(found->value, entry.value);
        } else {
            *found = entry;
        }
    }
}

base::Node taken(base::Node& table, std::string_view key)
{
    auto& entries = std::get<Node::Table>(table.value);
    const auto found = entry_of(entries, key);
    if (found == entries.end()) return Node{table.place, Node::Table{}};
    Node node = std::move(found->value);
    entries.erase(found);
    return node;
}

base::Result<base::Node> setting_table(std::string_view setting)
{
    constexpr std::string_view form = "write KEY=VALUE, such as seeds=3 or both.delay=100ms";
    const auto equals = setting.find('=');
    if (equals == std::string_view::npos || equals == 0) return base::fail(std::string{form});
    auto node = value_of(setting.substr(equals + 1));
    if (!node) return node;
    std::string_view key = setting.substr(0, equals);
    for (std::size_t part = 0; part < key_parts_max; ++part) {
        const auto dot = key.rfind('.');
        const auto name = dot == std::string_view::npos ? key : key.substr(dot + 1);
        if (name.empty()) return base::fail(std::string{form});
        node = Node{{}, Node::Table{Entry{std::string{name}, {}, *std::move(node)}}};
        if (dot == std::string_view::npos) return node;
        key = key.substr(0, dot);
    }
    return base::fail("a key has at most 8 parts");
}

} // namespace hapnet::lab::experiment
