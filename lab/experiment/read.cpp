// SPDX-FileCopyrightText: 2026 The Hapnet authors
// SPDX-License-Identifier: MIT
#include "emulator/core/profile/text.hpp"
#include "lab/experiment/patch.hpp"
#include "lab/experiment/read_kind.hpp"
#include "lab/experiment/text.hpp"
#include "peer/core/sync/text.hpp"
#include "proto/base/built_in.hpp"

#include <algorithm>
#include <spdlog/fmt/fmt.h>
#include <tuple>
#include <utility>

namespace hapnet::lab::experiment {

namespace {

using base::Node;
using base::Reading;
using base::TableReader;

constexpr base::Duration duration_min = std::chrono::seconds{5};
constexpr base::Duration duration_max = std::chrono::minutes{10};
constexpr base::Duration tick_min = std::chrono::microseconds{100};
constexpr base::Duration tick_max = std::chrono::milliseconds{10};

const std::vector<std::string>& usual_algorithms()
{
    static const std::vector<std::string> names{"base", "sep", "dead-reckoning"};
    return names;
}

void read_between(const Node* node, base::Duration& target, base::Duration least,
                  std::pair<base::Duration, Reading&> most)
{
    if (node == nullptr) return;
    base::Duration value = target;
    base::read_value(*node, value, most.second);
    if (value < least || value > most.first) {
        return most.second.complain(node->place, fmt::format("from {} to {} is possible here",
                                                             base::value_text(least),
                                                             base::value_text(most.first)));
    }
    target = value;
}

/// Whether it can stand in a CSV and in the name of a file.
bool is_plain(std::string_view name)
{
    constexpr std::string_view plain = "abcdefghijklmnopqrstuvwxyzABCDEFGHIJKLMNOPQRSTUVWXYZ"
                                       "0123456789-_";
    return !name.empty() && name.find_first_not_of(plain) == std::string_view::npos;
}

/// A table of its own under [algorithm], whose kind is its name if it says no other.
std::optional<peer::Algorithm> read_own_algorithm(const std::string& name, const Node& node,
                                                  Reading& reading)
{
    Node table = node;
    auto* entries = std::get_if<Node::Table>(&table.value);
    const auto says_kind = [](const base::Entry& entry) { return entry.key == "algorithm"; };
    if (entries != nullptr && peer::algorithm_named(name) &&
        std::none_of(entries->begin(), entries->end(), says_kind)) {
        entries->push_back({"algorithm", node.place, Node{node.place, name}});
    }
    return peer::read_algorithm(table, reading);
}

void read_algorithms(TableReader& table, Experiment& experiment)
{
    Reading& reading = table.reading();
    std::vector<std::string> names = usual_algorithms();
    const Node* list = table.find("algorithms");
    if (list != nullptr) names = read_texts(*list, reading);
    const Node* own = table.find("algorithm");
    static const Node::Table none;
    const auto* tables = own == nullptr ? &none : std::get_if<Node::Table>(&own->value);
    if (tables == nullptr) return base::complain_of(*own, "[algorithm.NAME]", reading);
    for (const std::string& name : names) {
        if (!is_plain(name)) {
            return reading.complain(list == nullptr ? table.place() : list->place,
                                    "a name has letters, digits, - and _ only");
        }
        const auto entry = std::find_if(tables->begin(), tables->end(),
                                        [&](const base::Entry& one) { return one.key == name; });
        if (entry != tables->end()) {
            const auto algorithm = read_own_algorithm(name, entry->value, reading);
            if (algorithm) experiment.algorithms.push_back({name, *algorithm});
            continue;
        }
        auto algorithm = peer::algorithm_named(name);
        if (!algorithm) {
            return reading.complain(list == nullptr ? table.place() : list->place,
                                    algorithm.error().message);
        }
        experiment.algorithms.push_back({name, *std::move(algorithm)});
    }
}

void read_path(TableReader& table, emulator::Path& path)
{
    Reading& reading = table.reading();
    std::vector<emulator::Setting> settings;
    base::Place place = table.place();
    const auto read = [&](std::string_view key, std::optional<emulator::Direction> direction) {
        const Node* node = table.find(key);
        if (node == nullptr) return;
        settings.push_back({direction, emulator::read_direction(*node, reading)});
        place = node->place;
    };
    read("both", std::nullopt);
    read("up", emulator::Direction::up);
    read("down", emulator::Direction::down);
    auto read_path = emulator::with_settings({}, settings);
    if (!read_path) return reading.complain(place, read_path.error().message);
    path = *std::move(read_path);
}

Experiment read_experiment(const Node& document, Reading& reading)
{
    TableReader table{std::get<Node::Table>(document.value), document.place, reading};
    Experiment experiment;
    const Node* kind = table.require("kind");
    if (const Node* title = table.find("title")) {
        base::read_value(*title, experiment.title, reading);
    }
    read_between(table.find("duration"), experiment.duration, duration_min,
                 {duration_max, reading});
    read_between(table.find("tick"), experiment.tick, tick_min, {tick_max, reading});
    read_positive(table.find("seeds"), experiment.seeds, seeds_max, reading);
    read_positive(table.find("first_seed"), experiment.first_seed, first_seed_max, reading);
    read_algorithms(table, experiment);
    const Node* tasks = table.find("tasks");
    if (tasks != nullptr) experiment.tasks = read_tasks(*tasks, reading);
    if (const Node* hands = table.find("hands")) read_hands(*hands, experiment.hands, reading);
    read_path(table, experiment.path);
    if (kind != nullptr) read_kind(*kind, table, experiment.kind);
    table.finish(); // a misspelt key is the better complaint than a missing one
    if (tasks == nullptr) std::ignore = table.require("tasks");
    return experiment;
}

base::Result<Experiment> read_tree(const Node& document, Reading reading)
{
    auto experiment = read_experiment(document, reading);
    if (!reading.is_good()) return base::fail(*reading.complaint());
    return experiment;
}

/// The first setting with which the text is no experiment any more is the one to complain of.
base::Result<Experiment> complain_of_settings(Node document, const Overrides& overrides,
                                              base::Result<Experiment> experiment)
{
    for (const std::string& setting : overrides.settings) {
        overlay(document, *setting_table(setting));
        auto adjusted = read_tree(document, Reading{"--set " + setting, {}, false});
        if (!adjusted) return adjusted;
    }
    return experiment;
}

} // namespace

base::Result<Experiment> parse_experiment(std::string_view text, const std::string& source,
                                          const Overrides& overrides)
{
    auto parsed = base::parse_document(text);
    if (!parsed) {
        Reading reading{source};
        reading.complain(parsed.error().place, parsed.error().message);
        return base::fail(*reading.complaint());
    }
    Node document = *std::move(parsed);
    const Node quick = taken(document, "quick");
    if (!std::holds_alternative<Node::Table>(quick.value)) {
        Reading reading{source};
        base::complain_of(quick, "[quick]", reading);
        return base::fail(*reading.complaint());
    }
    Node quick_document = document;
    overlay(quick_document, quick);
    if (auto read = read_tree(quick_document, Reading{source}); !read) return read;
    if (overrides.quick) document = std::move(quick_document);
    Node adjusted = document;
    for (const std::string& setting : overrides.settings) {
        const auto table = setting_table(setting);
        if (!table) {
            return base::fail(fmt::format("--set {}: {}", setting, table.error().message));
        }
        overlay(adjusted, *table);
    }
    auto experiment = read_tree(adjusted, Reading{source});
    if (experiment || overrides.settings.empty()) return experiment;
    auto plain = read_tree(document, Reading{source});
    if (!plain) return plain;
    return complain_of_settings(std::move(document), overrides, std::move(experiment));
}

base::Result<Experiment> load_experiment(const std::string& file_or_name,
                                         const base::OpenFile& open, const Overrides& overrides)
{
    const auto found = base::find_text(file_or_name, built_in_experiments(), "an experiment", open);
    if (!found) return tl::unexpected{found.error()};
    return parse_experiment(found->text, found->source, overrides);
}

} // namespace hapnet::lab::experiment
