// SPDX-FileCopyrightText: 2026 The Hapnet authors
// SPDX-License-Identifier: MIT
#include "device/simulated/operator.hpp"

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

base::Result<Operator> load_operator(const std::string& name_or_file, const base::OpenFile& open)
{
    const bool is_file =
        name_or_file.find('/') != std::string::npos || name_or_file.ends_with(".toml");
    if (!is_file) return operator_named(name_or_file);
    const auto text = open(name_or_file);
    if (!text) return tl::unexpected{text.error()};
    base::Reading reading{name_or_file};
    const auto document = base::parse_document(*text);
    if (!document) {
        reading.complain(document.error().place, document.error().message);
        return base::fail(*reading.complaint());
    }
    auto person = read_operator(*document, reading);
    if (!person) return base::fail(*reading.complaint());
    return *std::move(person);
}

std::string print_operator(const Operator& person) { return base::field_lines(person); }

} // namespace hapnet::device
