// SPDX-FileCopyrightText: 2026 The Hapnet authors
// SPDX-License-Identifier: MIT
#include "device/simulated/operator.hpp"

#include "proto/base/built_in.hpp"
#include "proto/base/fields.hpp"

#include <span>
#include <spdlog/fmt/fmt.h>
#include <vector>

namespace hapnet::device {

namespace {

std::optional<Operator> read_preset(const base::Node& node, base::Reading& reading)
{
    std::string name;
    base::read_value(node, name, reading);
    if (!reading.is_good()) return std::nullopt;
    auto preset = operator_named(name);
    if (preset) return *std::move(preset);
    reading.complain(node.place, preset.error().message);
    return std::nullopt;
}

} // namespace

std::optional<Operator> read_operator(const base::Node& node, base::Reading& reading)
{
    const auto* entries = std::get_if<base::Node::Table>(&node.value);
    if (entries == nullptr) return read_preset(node, reading);
    base::TableReader table{*entries, node.place, reading};
    Operator person;
    if (const base::Node* preset = table.find("preset")) {
        const auto found = read_preset(*preset, reading);
        if (!found) return std::nullopt;
        person = *found;
    }
    base::read_fields(table, person);
    table.finish();
    if (!reading.is_good()) return std::nullopt;
    return person;
}

base::Result<Operator> parse_operator(std::string_view text, const std::string& source)
{
    return base::parse_text(text, source, [](const base::Node& node, base::Reading& reading) {
        return read_operator(node, reading).value_or(Operator{});
    });
}

base::Result<Operator> load_operator(const std::string& file_or_name, const base::OpenFile& open)
{
    std::vector<base::BuiltInText> presets;
    for (const std::string_view name : operator_names) {
        presets.push_back({name, fmt::format("preset = {}", base::quoted(name))});
    }
    const std::span<const base::BuiltInText> all{presets};
    const auto found = base::find_text(file_or_name, all, "an operator", open);
    if (!found) return tl::unexpected{found.error()};
    return parse_operator(found->text, found->source);
}

std::string print_operator(const Operator& person) { return base::field_lines(person); }

} // namespace hapnet::device
