// SPDX-FileCopyrightText: 2026 The Hapnet authors
// SPDX-License-Identifier: MIT
#include "lab/metrics/criteria.hpp"

#include "proto/base/document.hpp"
#include "proto/base/quantity.hpp"
#include "proto/base/reading.hpp"

#include <array>
#include <optional>
#include <spdlog/fmt/fmt.h>
#include <utility>

namespace hapnet::lab {

namespace {

using base::Node;
using base::Reading;
using base::TableReader;

constexpr std::array<std::pair<std::string_view, FilterOrder>, 3> filter_orders{
    {{"1", FilterOrder::first}, {"2", FilterOrder::second}, {"4", FilterOrder::fourth}}};

void read_filter_order(const Node* node, FilterOrder& target, Reading& reading)
{
    if (node == nullptr) return;
    const auto count = base::count_of(*node, 4);
    for (const auto& [name, order] : filter_orders) {
        if (!count || fmt::format("{}", *count) != name) continue;
        target = order;
        return;
    }
    reading.complain(node->place, "the order of a filter is 1, 2 or 4");
}

std::string text_of(FilterOrder order)
{
    for (const auto& [name, known] : filter_orders) {
        if (known == order) return std::string{name};
    }
    return "?";
}

void read_not_negative(const Node* node, double& target, const base::QuantityKind& kind,
                       Reading& reading)
{
    if (node == nullptr) return;
    double value = target;
    base::read_quantity(
        *node, value, [&](std::string_view text) { return base::parse_quantity(text, kind); },
        reading);
    if (value < 0.0) return reading.complain(node->place, "a limit is not negative");
    target = value;
}

void read_share(const Node* node, double& target, Reading& reading)
{
    if (node == nullptr) return;
    double value = target;
    base::read_value(*node, value, reading);
    if (!(value >= 0.0 && value <= 1.0)) {
        return reading.complain(node->place, "a limit of a ratio or a share is from 0.0 to 1.0");
    }
    target = value;
}

void read_table(const Node* node, Reading& reading, const auto& read_entries)
{
    if (node == nullptr) return;
    const auto* entries = std::get_if<Node::Table>(&node->value);
    if (entries == nullptr) return base::complain_of(*node, "a table", reading);
    TableReader table{*entries, node->place, reading};
    read_entries(table);
    table.finish();
}

void read_vibration(const Node* node, ByOrder& target, Reading& reading)
{
    read_table(node, reading, [&](TableReader& table) {
        read_not_negative(table.find("first"), target.first, base::length_kind, reading);
        read_not_negative(table.find("second"), target.second, base::length_kind, reading);
        read_not_negative(table.find("fourth"), target.fourth, base::length_kind, reading);
    });
}

void read_all(TableReader& table, Criteria& criteria, Reading& reading)
{
    read_filter_order(table.find("filter_order"), criteria.filter_order, reading);
    read_table(table.find("usable"), reading, [&](TableReader& usable) {
        read_vibration(usable.find("vibration_max"), criteria.vibration_max_m, reading);
        read_share(usable.find("stiffness_ratio_min"), criteria.stiffness_ratio_min, reading);
        read_not_negative(usable.find("force_vibration_max"), criteria.force_vibration_max_n,
                          base::force_kind, reading);
        read_share(usable.find("scored_share_min"), criteria.scored_share_min, reading);
    });
    read_table(table.find("good"), reading, [&](TableReader& good) {
        read_share(good.find("stiffness_ratio_min"), criteria.good_stiffness_ratio_min, reading);
        read_share(good.find("force_discrepancy_max"), criteria.good_force_discrepancy_max,
                   reading);
        read_share(good.find("contact_lost_max"), criteria.good_contact_lost_max, reading);
        read_not_negative(good.find("drag_max"), criteria.good_drag_max_n, base::force_kind,
                          reading);
    });
}

std::string length(double metres)
{
    return base::quoted(base::quantity_text(metres, base::length_kind));
}

std::string newtons(double force)
{
    return base::quoted(base::quantity_text(force, base::force_kind));
}

} // namespace

double at_order(const ByOrder& values, FilterOrder order)
{
    switch (order) {
    case FilterOrder::first: return values.first;
    case FilterOrder::second: return values.second;
    case FilterOrder::fourth: return values.fourth;
    }
    return values.first;
}

base::Result<Criteria> parse_criteria(std::string_view text, const std::string& source)
{
    Reading reading{source};
    Criteria criteria;
    const auto document = base::parse_document(text);
    if (!document) {
        reading.complain(document.error().place, document.error().message);
    } else {
        TableReader table{std::get<Node::Table>(document->value), document->place, reading};
        read_all(table, criteria, reading);
        table.finish();
    }
    if (reading.complaint()) return base::fail(*reading.complaint());
    return criteria;
}

std::string print_criteria(const Criteria& criteria)
{
    const ByOrder& vibration = criteria.vibration_max_m;
    std::string text;
    text +=
        "# When a session is usable, and when it is good. A convention that makes sessions\n"
        "# comparable, not a finding about people. docs/design/metrics.md defines each metric.\n\n";
    text += "# Of the 20 Hz high-pass that vibration is judged by: 1, 2 or 4. The first\n"
            "# estimates used 1.\n";
    text += fmt::format("filter_order = {}\n\n[usable]\n", text_of(criteria.filter_order));
    text += "# A. Calibrated: base is to be usable up to 93 % random loss and no further.\n";
    text +=
        fmt::format("vibration_max = {{ first = {}, second = {}, fourth = {} }}\n",
                    length(vibration.first), length(vibration.second), length(vibration.fourth));
    text += "# B at 1 Hz. Calibrated: base is to be usable up to 160 ms of delay and no further.\n";
    text +=
        fmt::format("stiffness_ratio_min = {}\n", base::value_text(criteria.stiffness_ratio_min));
    text += "# E, what the network adds of it. A working limit, from no source.\n";
    text += fmt::format("force_vibration_max = {}\n", newtons(criteria.force_vibration_max_n));
    text += "# Of the time that both sides would run: a session that hardly took place is none.\n";
    text += fmt::format("scored_share_min = {}\n\n[good]\n",
                        base::value_text(criteria.scored_share_min));
    text += "# B at 1 Hz. The just noticeable difference of stiffness, 23 % (Jones and Hunter).\n";
    text += fmt::format("stiffness_ratio_min = {}\n",
                        base::value_text(criteria.good_stiffness_ratio_min));
    text += "# C. The just noticeable difference of force, 7 to 10 % (Pang, Tan and Durlach).\n";
    text += fmt::format("force_discrepancy_max = {}\n",
                        base::value_text(criteria.good_force_discrepancy_max));
    text += "# F and I. Working limits, from no source.\n";
    text +=
        fmt::format("contact_lost_max = {}\n", base::value_text(criteria.good_contact_lost_max));
    text += fmt::format("drag_max = {}\n", newtons(criteria.good_drag_max_n));
    return text;
}

} // namespace hapnet::lab
