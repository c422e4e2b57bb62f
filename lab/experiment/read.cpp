// SPDX-FileCopyrightText: 2026 The Hapnet authors
// SPDX-License-Identifier: MIT
#include "emulator/core/profile/setting_hints.hpp"
#include "emulator/core/profile/text.hpp"
#include "lab/experiment/claims.hpp"
#include "lab/experiment/fields.hpp"
#include "lab/experiment/patch.hpp"
#include "lab/experiment/session_spec.hpp"
#include "lab/experiment/text.hpp"
#include "peer/core/sync/text.hpp"
#include "proto/base/built_in.hpp"
#include "proto/base/fields.hpp"
#include "proto/base/random.hpp"

#include <algorithm>
#include <chrono>
#include <cmath>
#include <cstdint>
#include <map>
#include <spdlog/fmt/fmt.h>
#include <tuple>
#include <utility>

namespace hapnet::lab::experiment {

namespace {

using base::Node;
using base::Reading;
using base::TableReader;

/// Reads a table of an own algorithm under [algorithm]. Its kind is its name if it states no other.
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

/// Reads the named algorithms: those of [algorithm], or else the built-in ones.
void read_algorithms(TableReader& table, std::vector<NamedAlgorithm>& algorithms)
{
    Reading& reading = table.reading();
    const Node* list = table.find("algorithms");
    const Node* own = table.find("algorithm");
    static const Node::Table none;
    const auto* tables = own == nullptr ? &none : std::get_if<Node::Table>(&own->value);
    if (tables == nullptr) return base::complain_of(*own, "[algorithm.NAME]", reading);
    for (auto& [name, algorithm] : algorithms) {
        const auto entry = std::ranges::find(*tables, name, &base::Entry::key);
        if (entry != tables->end()) {
            const auto read = read_own_algorithm(name, entry->value, reading);
            if (read) algorithm = *read;
        } else if (auto built_in = peer::algorithm_named(name)) {
            algorithm = *std::move(built_in);
        } else {
            reading.complain(list == nullptr ? table.place() : list->place,
                             built_in.error().message);
        }
    }
}

/// Reads the profile in a file of the experiment.
emulator::Profile read_profile(const Node& node, Reading& reading)
{
    std::string file;
    base::read_value(node, file, reading);
    const auto text = reading.is_good() ? reading.open(file) : std::string{};
    if (!text) reading.complain(node.place, text.error().message);
    if (!reading.is_good()) return {};
    const auto open = [&reading](const std::string& name) { return reading.open(name); };
    auto profile = emulator::parse_profile(*text, file, open);
    if (!profile) reading.complain(node.place, profile.error().message);
    if (profile && !profile->flows.empty()) {
        reading.complain(node.place, fmt::format("{}: messages of an experiment have neither "
                                                 "addresses nor ports: leave out [[flow]]",
                                                 file));
    }
    return profile.value_or(emulator::Profile{});
}

/// Reads the conditions of all links, the settings of single links, and the changes over time.
void read_network(TableReader& table, Experiment& experiment)
{
    const Node* file = table.find("profile");
    emulator::Profile profile;
    emulator::read_conditions(table, {.any = true}, profile);
    emulator::read_timeline(table, {.any = true}, profile);
    if (file != nullptr && profile != emulator::Profile{}) {
        table.reading().complain(file->place, "a profile is the whole network: write its path, or "
                                              "conditions such as [both] and [[at]], not both");
    } else if (file != nullptr) {
        profile = read_profile(*file, table.reading());
    }
    experiment.path = std::move(profile.path);
    experiment.links = std::move(profile.paths);
    experiment.timeline = std::move(profile.timeline);
}

void read_kind(TableReader& table, Kind& kind)
{
    const auto read = [&]<typename One>(One& one) {
        if constexpr (!has_own_table<One>) return base::read_fields(table, one);
        const auto name = base::described_name<One>;
        if (const Node* node = table.require(name)) {
            base::read_table(*node, one, table.reading());
        }
    };
    std::visit(read, kind);
}

/// True if the results of the kind distinguish several numbers of peers or several scenes.
bool has_parties(const Kind& kind)
{
    return std::holds_alternative<Limits>(kind) || std::holds_alternative<ImpairmentGrid>(kind);
}

/// A task and its players.
struct TaskOfParty {
    device::Task task{};
    Party party{};
};

/// Returns all tasks of an experiment with their players.
std::vector<TaskOfParty> played_in(const Experiment& experiment)
{
    std::vector<TaskOfParty> played;
    if (std::holds_alternative<Claims>(experiment.kind)) {
        for (const ClaimCell& cell : claim_cells())
            for (const device::Task task : cell.tasks) played.push_back({task, {cell.peers, {}}});
        return played;
    }
    auto tasks = experiment.tasks;
    if (std::holds_alternative<Table1>(experiment.kind)) tasks.push_back(device::Task::p1);
    if (const auto* limits = std::get_if<Limits>(&experiment.kind);
        limits != nullptr && limits->sensitivity && limits->sensitivity->seeds > 0) {
        const auto& more = limits->sensitivity->tasks;
        tasks.insert(tasks.end(), more.begin(), more.end());
    }
    for (const Party& party : parties_of(experiment))
        for (const device::Task task : tasks) played.push_back({task, party});
    return played;
}

/// Reports an error for parties that cannot play a task.
void check_parties(const Experiment& experiment, base::Place place, Reading& reading)
{
    const auto parties = parties_of(experiment);
    if (!has_parties(experiment.kind) && (parties.size() > 1 || experiment.peers.front() != 2)) {
        return reading.complain(place, fmt::format("kind {} takes one scene and two peers: use "
                                                   "limits or plane",
                                                   name_of(experiment.kind)));
    }
    for (const auto& [task, party] : played_in(experiment)) {
        for (const NamedAlgorithm& algorithm : experiment.algorithms) {
            const auto spec = make_session_spec(
                experiment, {algorithm, experiment.hands, task, 1, party}, experiment.path);
            const auto valid = validate(spec.setting);
            if (valid) continue;
            return reading.complain(place, fmt::format("{}, {} peers: {}", name_of(task),
                                                       party.peers, valid.error().message));
        }
    }
}

/// Reports an error for records of too many sessions, or with sealed messages.
void check_record(const Experiment& experiment, base::Place place, Reading& reading)
{
    if (!experiment.record) return;
    const bool has_few = std::holds_alternative<Table1>(experiment.kind) ||
                         std::holds_alternative<Trajectories>(experiment.kind);
    if (!has_few) return reading.complain(place, "records are kept by table1 and trajectories");
    if (experiment.keyed) reading.complain(place, "a record holds messages without keys");
    if (experiment.tick != std::chrono::milliseconds{1})
        reading.complain(place, "a record has ticks of 1 ms: leave 'tick' out");
}

/// Reports an error for recorded people if no result of the kind distinguishes their sessions.
void check_people(const Experiment& experiment, base::Place place, Reading& reading)
{
    const auto* limits = std::get_if<Limits>(&experiment.kind);
    const auto is_people = [](const Hands& hands) { return hands.people != nullptr; };
    const bool has_people =
        is_people(experiment.hands) || (limits != nullptr && limits->sensitivity &&
                                        std::ranges::any_of(limits->sensitivity->hands, is_people));
    if (!has_people) return;
    const bool is_known_kind = std::holds_alternative<Table1>(experiment.kind) ||
                               std::holds_alternative<Trajectories>(experiment.kind) ||
                               std::holds_alternative<ImpairmentGrid>(experiment.kind);
    if (!is_known_kind) {
        return reading.complain(place, "recorded hands play in the kinds table1, plane and "
                                       "trajectories");
    }
    if (experiment.script.empty() && experiment.replay.empty()) return;
    reading.complain(place, "recorded hands have scripts of their own: leave script and replay "
                            "out");
}

/// Reports an error for a hand that has both a motion to replay and a motion to intend.
void check_ways(const Experiment& experiment, base::Place place, Reading& reading)
{
    if (experiment.replay.empty() || experiment.script.empty()) return;
    for (std::size_t side = 0; side < 2; ++side) {
        if (!experiment.replay[side].trace || !experiment.script[side].trace) continue;
        return reading.complain(place, "a hand has either a replay or a script: leave one empty");
    }
}

/// Takes the length of a session from its scripts.
void take_length_of_scripts(Experiment& experiment, base::Place place, Reading& reading)
{
    if (experiment.duration != base::Duration{0}) return;
    double end_s = 0.0;
    for (const auto* traces : {&experiment.script, &experiment.replay}) {
        for (const NamedTrace& named : *traces)
            if (named.trace) end_s = std::max(end_s, named.trace->back().time_s);
    }
    for (std::size_t i = 0; i < experiment.hands.trials(); ++i) {
        if (const auto* trial = experiment.hands.trial(i)) end_s = std::max(end_s, trial->end_s());
    }
    if (end_s <= 0.0) {
        return reading.complain(place, "there is no script or replay to take the duration from: "
                                       "name one, or recorded hands, or write a time");
    }
    constexpr double longest_s = 597.0;
    if (end_s > longest_s) {
        return reading.complain(place, fmt::format("the script is {:g} s long: a session lasts "
                                                   "600s at most, hands off included",
                                                   end_s));
    }
    experiment.duration = session_length(end_s);
    experiment.is_as_long_as_scripts = true;
}

/// Reports an error for a reference with which nothing can be compared.
void check_reference(const Experiment& experiment, const std::vector<AxisValues>& points,
                     base::Place place, Reading& reading)
{
    const auto has = [](const Axis& axis) { return axis.reference.has_value(); };
    const auto axis = std::ranges::find_if(experiment.axes, has);
    if (axis == experiment.axes.end()) return;
    const auto refuse = [&](std::string_view why) {
        reading.complain(place, fmt::format("axis '{}': 'reference' {}", axis->key, why));
    };
    const bool is_alone = experiment.axes.size() == 1 && !experiment.latin_hypercube;
    if (!is_alone) return refuse("is for an experiment of one axis");
    const bool is_known_kind = std::holds_alternative<Table1>(experiment.kind) ||
                               std::holds_alternative<Limits>(experiment.kind);
    if (!is_known_kind) return refuse("is for the kinds table1 and limits");
    if (parties_of(experiment).size() > 1)
        return refuse("is for one number of peers and one scene");
    if (std::ranges::find(points, AxisValues{*axis->reference}) == points.end())
        return refuse(fmt::format("'{}' is not among the values", *axis->reference));
}

/// Reports an error for axes that have no points.
void check_axes(TableReader& table, const Experiment& experiment)
{
    const Node* axes = table.find("axis");
    const Node* drawn = table.find("latin_hypercube");
    if ((axes == nullptr && drawn == nullptr) || !table.reading().is_good()) return;
    const auto points = axis_points(experiment);
    const Node& node = axes == nullptr ? *drawn : *axes;
    if (!points) return table.reading().complain(node.place, points.error().message);
    check_reference(experiment, *points, node.place, table.reading());
}

Experiment read_experiment(const Node& document, Reading& reading)
{
    TableReader table{std::get<Node::Table>(document.value), document.place, reading};
    Experiment experiment = usual_experiment();
    const auto kinds = fmt::format("use one of {}", KindFormat{}.describe());
    std::ignore = table.require("kind", kinds); // the kind decides which keys are valid
    base::read_fields(table, experiment);
    read_algorithms(table, experiment.algorithms);
    read_network(table, experiment);
    read_kind(table, experiment.kind);
    table.finish();
    if (const Node* node = table.find("duration"); node != nullptr && reading.is_good())
        take_length_of_scripts(experiment, node->place, reading);
    check_axes(table, experiment);
    for (const char* key : {"hands", "convention"}) {
        const Node* node = table.find(key);
        if (node != nullptr && reading.is_good()) check_people(experiment, node->place, reading);
    }
    if (const Node* node = table.find("record"); node != nullptr && reading.is_good())
        check_record(experiment, node->place, reading);
    if (const Node* node = table.find("script"); node != nullptr && reading.is_good())
        check_ways(experiment, node->place, reading);
    for (const char* key :
         {"matrix", "link", "profile", "scene", "peers", "replay", "algorithms", "tasks"}) {
        const Node* node = table.find(key);
        if (node == nullptr || !reading.is_good()) continue;
        check_parties(experiment, node->place, reading);
        break;
    }
    return experiment;
}

/// Returns advice on where a misplaced key belongs: at the top, like the fields of an experiment,
/// or where a profile has it.
std::string advice_on_key(std::string_view key)
{
    const auto& rows = base::field_table<Experiment>().rows;
    if (std::ranges::find(rows, key, &base::FieldRow::key) != rows.end())
        return "write it at the top, above the first [table]";
    return emulator::advice_on_key(key);
}

/// The source that an error names.
struct Source {
    std::string name;
    bool has_lines = true; // false: it is an option of the command line
};

base::Result<Experiment> read_tree(const Node& document, const Source& source,
                                   const base::OpenFile& open)
{
    std::map<std::string, std::uint64_t> files; // hashes of all files read, by name
    base::OpenFile noting = [&](const std::string& name) {
        auto text = open ? open(name) : Reading{""}.open(name);
        if (text) files.insert_or_assign(name, base::Seed{}.stream(*text).bits(0));
        return text;
    };
    if (!open.is_quoted()) noting = noting.unquoted();
    Reading reading{source.name, noting, source.has_lines};
    reading.advise_on_keys(advice_on_key);
    auto experiment = read_experiment(document, reading);
    if (!reading.is_good()) return base::fail(*reading.complaint());
    for (const auto& [name, hash] : files) experiment.files.push_back({name, hash});
    return experiment;
}

/// Reports the first setting with which the text is no longer an experiment. `experiment` has the
/// error with all settings. A text that is not an experiment by itself may become one by its
/// settings.
base::Result<Experiment> complain_of_settings(Node document, const Overrides& overrides,
                                              const base::OpenFile& open,
                                              const base::Result<Experiment>& experiment)
{
    bool was_good = read_tree(document, {""}, open).has_value();
    auto complaint = experiment;
    for (const std::string& setting : overrides.settings) {
        overlay(document, *setting_table(setting));
        auto adjusted = read_tree(document, {"--set " + setting, false}, open);
        if (was_good && !adjusted) complaint = adjusted;
        was_good = adjusted.has_value();
    }
    return complaint;
}

/// True if a setting changes the axes themselves.
bool is_of_axes(std::string_view setting)
{
    const std::string_view key = setting.substr(0, setting.find('='));
    const std::string_view table = key.substr(0, key.find('.'));
    return table == "axis" || table == "latin_hypercube";
}

/// Opens the files that the text of `file` names: a file beside it, or else the file at the given
/// path.
base::OpenFile beside(const std::string& file, const base::OpenFile& open)
{
    const std::string folder = file.substr(0, file.rfind('/') + 1);
    if (folder.empty() || !open) return open;
    const base::OpenFile files{[folder, open](const std::string& name) {
        if (name.starts_with('/')) return open(name);
        auto text = open(folder + name);
        return text ? text : open(name);
    }};
    return open.is_quoted() ? files : files.unquoted();
}

/// Returns the complaint about a value of an axis, with the axis' place in the file.
std::string complaint_of_axis(const std::string& file_or_name, const base::OpenFile& open,
                              const std::string& complaint)
{
    const auto found = base::find_text(file_or_name, built_in_experiments(), "an experiment", open);
    const auto document = found ? base::parse_document(found->text) : base::parse_document("");
    if (!found || !document) return complaint;
    Node rest = *document;
    Node quick = taken(rest, "quick");
    Node::List list; // all axes, each with its place in the text
    for (const Node& axes : {taken(rest, "axis"), taken(quick, "axis")}) {
        const auto* several = std::get_if<Node::List>(&axes.value);
        if (several == nullptr) {
            list.push_back(axes);
        } else {
            list.insert(list.end(), several->begin(), several->end());
        }
    }
    for (const Node& axis : list) {
        const auto* entries = std::get_if<Node::Table>(&axis.value);
        if (entries == nullptr) continue;
        const auto entry = std::ranges::find(*entries, "key", &base::Entry::key);
        if (entry == entries->end()) continue;
        const auto* key = std::get_if<std::string>(&entry->value.value);
        if (key == nullptr || !complaint.starts_with("--set " + *key + "=")) continue;
        const auto what = std::string_view{complaint}.substr(std::string_view{"--set "}.size());
        return fmt::format("{}:{}:{}: axis {}", found->source, entry->value.place.line,
                           entry->value.place.column, what);
    }
    return complaint;
}

} // namespace

base::Result<Experiment> parse_experiment(std::string_view text, const std::string& source,
                                          const Overrides& overrides, const base::OpenFile& open)
{
    const auto parts = base::parse_text(text, source, [](const Node& whole, Reading& reading) {
        Node rest = whole;
        Node quick = taken(rest, "quick");
        const bool is_table = std::holds_alternative<Node::Table>(quick.value);
        if (!is_table) base::complain_of(quick, "[quick]", reading);
        return std::pair{std::move(rest), std::move(quick)};
    });
    if (!parts) return tl::unexpected{parts.error()};
    auto [document, quick] = *parts;
    if (overrides.is_point) {
        for (Node* table : {&document, &quick}) {
            std::ignore = taken(*table, "axis");
            std::ignore = taken(*table, "latin_hypercube");
        }
    }
    Node quick_document = document;
    overlay(quick_document, quick);
    const Node& chosen = overrides.quick ? quick_document : document;
    Node adjusted = chosen;
    for (const std::string& setting : overrides.settings) {
        const auto table = setting_table(setting);
        if (!table) {
            return base::fail(fmt::format("--set {}: {}", setting, table.error().message));
        }
        overlay(adjusted, *table);
    }
    auto experiment = read_tree(adjusted, {source}, open);
    if (!experiment) {
        if (overrides.settings.empty()) return experiment;
        return complain_of_settings(chosen, overrides, open, experiment);
    }
    // The values under [quick] must be valid in every run, unless only settings make the text
    // valid.
    if (overrides.settings.empty() || read_tree(document, {source}, open)) {
        if (auto read = read_tree(quick_document, {source}, open); !read) return read;
    }
    return experiment;
}

base::Result<Experiment> load_experiment(const std::string& file_or_name,
                                         const base::OpenFile& open, const Overrides& overrides)
{
    const auto found = base::find_text(file_or_name, built_in_experiments(), "an experiment", open);
    if (!found) return tl::unexpected{found.error()};
    return parse_experiment(found->text, found->source, overrides, beside(found->source, open));
}

base::Result<std::vector<AxisPoint>> load_axis_points(const std::string& file_or_name,
                                                      const base::OpenFile& open,
                                                      const Overrides& overrides)
{
    const auto whole = load_experiment(file_or_name, open, overrides);
    if (!whole) return tl::unexpected{whole.error()};
    std::vector<AxisPoint> points;
    if (whole->axes.empty()) {
        points.push_back({{}, *whole});
        return points;
    }
    auto all = axis_points(*whole);
    if (!all) return tl::unexpected{all.error()};
    for (AxisValues& values : *all) {
        Overrides at = overrides;
        at.is_point = true;
        std::erase_if(at.settings, is_of_axes);
        for (std::size_t i = 0; i < values.size(); ++i)
            at.settings.push_back(fmt::format("{}={}", whole->axes[i].key, values[i]));
        auto one = load_experiment(file_or_name, open, at);
        if (!one) return base::fail(complaint_of_axis(file_or_name, open, one.error().message));
        points.push_back({std::move(values), *std::move(one)});
    }
    return points;
}

} // namespace hapnet::lab::experiment
