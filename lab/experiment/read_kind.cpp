// SPDX-FileCopyrightText: 2026 The Hapnet authors
// SPDX-License-Identifier: MIT
#include "lab/experiment/read_kind.hpp"

#include <algorithm>
#include <array>
#include <spdlog/fmt/fmt.h>
#include <string_view>
#include <utility>

namespace hapnet::lab::experiment {

namespace {

using base::Node;
using base::Reading;
using base::TableReader;

constexpr std::uint32_t rows_per_s_max = 1000;
constexpr std::int64_t search_levels_max = 1000;

void read_filter_orders(const Node& node, std::vector<metrics::FilterOrder>& target,
                        Reading& reading)
{
    const auto* list = std::get_if<Node::List>(&node.value);
    if (list == nullptr || list->empty()) {
        return base::complain_of(node, "a list of filter orders such as [1, 2, 4]", reading);
    }
    target.clear();
    for (const Node& element : *list) {
        const auto count = base::count_of(element, 4).value_or(0);
        const auto known = std::find(metrics::filter_order_counts.begin(),
                                     metrics::filter_order_counts.end(), count);
        if (known == metrics::filter_order_counts.end()) {
            return base::complain_of(element, "the filter order 1, 2 or 4", reading);
        }
        target.push_back(
            static_cast<metrics::FilterOrder>(known - metrics::filter_order_counts.begin()));
    }
}

/// Complains unless the node is a table; `use` reads its keys.
template <typename Use>
void read_table_of_kind(const Node& node, Reading& reading, Use use)
{
    const auto* entries = std::get_if<Node::Table>(&node.value);
    if (entries == nullptr) return base::complain_of(node, "a table", reading);
    TableReader table{*entries, node.place, reading};
    use(table);
    table.finish();
}

void check_range(const SearchRange& range, base::Place place, Reading& reading)
{
    const auto refuse = [&](std::string_view what) { reading.complain(place, what); };
    if (range.from >= range.to) return refuse("'from' has to be less than 'to'");
    if (range.resolution.thousandths == 0) return refuse("'resolution' has to be more than 0");
    if (range.step.thousandths == 0 || range.step.thousandths % range.resolution.thousandths != 0) {
        return refuse("'step' has to be once, twice, ... the resolution");
    }
    if (range.to.thousandths / range.step.thousandths > search_levels_max) {
        return refuse(fmt::format("more than {} steps to 'to'", search_levels_max));
    }
}

SearchRange read_range(const Node& node, Impairment impairment, Reading& reading)
{
    SearchRange range;
    range.impairment = impairment;
    read_table_of_kind(node, reading, [&](TableReader& table) {
        const auto read = [&](const Node* value, ImpairmentLevel& target) {
            if (value != nullptr) read_level(*value, impairment, target, reading);
        };
        read(table.find("from"), range.from);
        read(table.require("to"), range.to);
        read(table.require("step"), range.step);
        read(table.require("resolution"), range.resolution);
    });
    if (reading.is_good()) check_range(range, node.place, reading);
    return range;
}

Sensitivity read_sensitivity(const Node& node, Reading& reading)
{
    Sensitivity sensitivity;
    read_table_of_kind(node, reading, [&](TableReader& table) {
        if (const Node* orders = table.find("filter_orders")) {
            read_filter_orders(*orders, sensitivity.filter_orders, reading);
        }
        if (const Node* tasks = table.require("tasks")) {
            sensitivity.tasks = read_tasks(*tasks, reading);
        }
        read_positive(table.require("seeds"), sensitivity.seeds, seeds_max, reading);
        const Node* hands = table.require("hands");
        if (hands == nullptr) return;
        const auto* list = std::get_if<Node::List>(&hands->value);
        if (list == nullptr || list->empty()) {
            return base::complain_of(*hands, "a list such as [\"relaxed\", \"firm\"]", reading);
        }
        for (const Node& element : *list) {
            sensitivity.hands.emplace_back();
            read_hands(element, sensitivity.hands.back(), reading);
        }
    });
    return sensitivity;
}

Limits read_limits(TableReader& table)
{
    Limits limits;
    Reading& reading = table.reading();
    if (const Node* ranges = table.require("limit")) {
        read_table_of_kind(*ranges, reading, [&](TableReader& by_name) {
            for (const Impairment impairment : impairments) {
                const Node* range = by_name.find(name_of(impairment));
                if (range == nullptr) continue;
                limits.ranges.push_back(read_range(*range, impairment, reading));
            }
        });
        if (limits.ranges.empty()) {
            reading.complain(ranges->place, "there is no [limit.delay], [limit.jitter], "
                                            "[limit.random-loss] or [limit.burst-loss]");
        }
    }
    if (const Node* convention = table.find("convention")) {
        limits.sensitivity = read_sensitivity(*convention, reading);
    }
    return limits;
}

std::vector<ImpairmentLevel> read_levels(const Node* node, Impairment impairment, Reading& reading)
{
    std::vector<ImpairmentLevel> levels;
    if (node == nullptr) return levels;
    const auto* list = std::get_if<Node::List>(&node->value);
    if (list == nullptr || list->empty()) {
        base::complain_of(*node, "a list of levels", reading);
        return levels;
    }
    for (const Node& element : *list) {
        levels.emplace_back();
        read_level(element, impairment, levels.back(), reading);
    }
    return levels;
}

ImpairmentGrid read_plane(TableReader& table)
{
    ImpairmentGrid plane;
    const Node* node = table.require("plane");
    if (node == nullptr) return plane;
    Reading& reading = table.reading();
    read_table_of_kind(*node, reading, [&](TableReader& axes) {
        plane.delays = read_levels(axes.require("delay"), Impairment::delay, reading);
        plane.jitters = read_levels(axes.require("jitter"), Impairment::jitter, reading);
        plane.losses = read_levels(axes.require("loss"), Impairment::random_loss, reading);
    });
    return plane;
}

Calibration read_calibration(TableReader& table)
{
    Calibration calibration;
    const Node* node = table.require("calibration");
    if (node == nullptr) return calibration;
    Reading& reading = table.reading();
    read_table_of_kind(*node, reading, [&](TableReader& numbers) {
        const auto read = [&](std::string_view key, Impairment impairment,
                              ImpairmentLevel& target) {
            const Node* value = numbers.require(key);
            if (value != nullptr) read_level(*value, impairment, target, reading);
        };
        read("delay", Impairment::delay, calibration.delay);
        read("random-loss", Impairment::random_loss, calibration.random_loss);
    });
    return calibration;
}

template <typename OfRows>
OfRows read_rows(TableReader& table)
{
    OfRows kind;
    read_positive(table.find("rows_per_second"), kind.rows_per_s, rows_per_s_max, table.reading());
    return kind;
}

} // namespace

void read_positive(const Node* node, std::uint32_t& target, std::uint32_t most, Reading& reading)
{
    if (node == nullptr) return;
    const auto count = base::count_of(*node, most);
    if (!count || *count == 0) {
        return base::complain_of(*node, fmt::format("a whole number from 1 to {}", most), reading);
    }
    target = static_cast<std::uint32_t>(*count);
}

std::vector<std::string> read_texts(const Node& node, Reading& reading)
{
    if (const auto* text = std::get_if<std::string>(&node.value)) return {*text};
    const auto* list = std::get_if<Node::List>(&node.value);
    std::vector<std::string> texts;
    if (list == nullptr || list->empty()) {
        base::complain_of(node, "a list of names in quotes", reading);
        return texts;
    }
    for (const Node& element : *list) {
        std::string text;
        base::read_value(element, text, reading);
        if (std::find(texts.begin(), texts.end(), text) != texts.end()) {
            reading.complain(element.place, fmt::format("'{}' is there already", text));
        }
        texts.push_back(std::move(text));
    }
    return texts;
}

std::vector<device::Task> read_tasks(const Node& node, Reading& reading)
{
    std::vector<device::Task> tasks;
    for (const std::string& name : read_texts(node, reading)) {
        const auto task = device::task_named(name);
        if (!task) {
            reading.complain(node.place, task.error().message);
            return tasks;
        }
        tasks.push_back(*task);
    }
    return tasks;
}

void read_hands(const Node& node, Hands& target, Reading& reading)
{
    const auto* list = std::get_if<Node::List>(&node.value);
    if (list != nullptr && list->size() != 2) {
        return reading.complain(node.place, "one operator for both hands, or a list of two: "
                                            "[\"nominal\", \"firm\"] of L and of R");
    }
    const auto left = device::read_operator(list == nullptr ? node : list->front(), reading);
    const auto right = list == nullptr ? left : device::read_operator(list->back(), reading);
    if (left && right) target = {*left, *right};
}

void read_kind(const Node& name, TableReader& table, Kind& target)
{
    constexpr std::array<std::string_view, 5> names{"table1", "limits", "trajectories", "plane",
                                                    "calibration"};
    std::string text;
    base::read_value(name, text, table.reading());
    if (text == names[0]) {
        target = read_rows<Table1>(table);
    } else if (text == names[1]) {
        target = read_limits(table);
    } else if (text == names[2]) {
        target = read_rows<Trajectories>(table);
    } else if (text == names[3]) {
        target = read_plane(table);
    } else if (text == names[4]) {
        target = read_calibration(table);
    } else {
        table.reading().complain(name.place, fmt::format("there is no kind of experiment '{}': {}",
                                                         text, base::suggestion(text, names)));
    }
}

} // namespace hapnet::lab::experiment
