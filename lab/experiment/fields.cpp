// SPDX-FileCopyrightText: 2026 The Hapnet authors
// SPDX-License-Identifier: MIT
#include "lab/experiment/fields.hpp"

#include "peer/core/others.hpp"
#include "proto/base/fields.hpp"
#include "scene/text/text.hpp"

#include <algorithm>
#include <array>
#include <iterator>
#include <spdlog/fmt/fmt.h>
#include <string_view>
#include <utility>

namespace hapnet::lab::experiment {

namespace {

using base::Node;
using base::Reading;

constexpr std::int64_t search_levels_max = 1000;
constexpr base::Count peers_format{2, peer::peers_max};

/// Reads a list of different texts, at least one; or one text alone.
std::vector<std::string> read_texts(const Node& node, Reading& reading)
{
    if (const auto* text = std::get_if<std::string>(&node.value)) return {*text};
    std::vector<std::string> texts;
    base::List<base::Text>{{}, 1}.read(node, texts, reading);
    for (auto text = texts.begin(); text != texts.end(); ++text) {
        if (std::find(texts.begin(), text, *text) == text) continue;
        reading.complain(node.place, fmt::format("'{}' is there already", *text));
    }
    return texts;
}

/// True if the name can be in a CSV and in the name of a file.
bool is_plain(std::string_view name)
{
    constexpr std::string_view plain = "abcdefghijklmnopqrstuvwxyzABCDEFGHIJKLMNOPQRSTUVWXYZ"
                                       "0123456789-_";
    return !name.empty() && name.find_first_not_of(plain) == std::string_view::npos;
}

std::string operator_text(const device::Operator& person)
{
    const auto preset = device::operator_named(person.name);
    if (preset && *preset == person) return base::quoted(person.name);
    return base::Table{}.print(person);
}

template <typename... Kinds>
constexpr auto names_of_kinds(base::Tag<std::variant<Kinds...>> /*kinds*/)
{
    return base::names(base::described_name<Kinds>...);
}
constexpr auto kind_names = names_of_kinds(base::Tag<Kind>{});

template <typename... Kinds>
Kind kind_at(std::size_t index, base::Tag<std::variant<Kinds...>> /*kinds*/)
{
    return std::array{Kind{Kinds{}}...}.at(index);
}

} // namespace

void KindFormat::read(const Node& node, Kind& target, Reading& reading) const
{
    std::string text;
    base::read_value(node, text, reading);
    const auto* const found = std::find(kind_names.begin(), kind_names.end(), text);
    if (found != kind_names.end()) {
        target = kind_at(static_cast<std::size_t>(found - kind_names.begin()), base::Tag<Kind>{});
        return;
    }
    reading.complain(node.place, fmt::format("there is no kind of experiment '{}': {}", text,
                                             base::suggestion(text, kind_names)));
}

std::string KindFormat::print(const Kind& kind) const { return base::quoted(name_of(kind)); }

std::string KindFormat::describe() const
{
    return fmt::format("`\"{}\"`", fmt::join(kind_names, "\"`, `\""));
}

void AlgorithmNames::read(const Node& node, std::vector<NamedAlgorithm>& target,
                          Reading& reading) const
{
    target.clear();
    for (std::string& name : read_texts(node, reading)) {
        if (!is_plain(name)) {
            return reading.complain(node.place, "a name has letters, digits, - and _ only");
        }
        target.push_back({std::move(name), {}});
    }
}

std::string AlgorithmNames::print(const std::vector<NamedAlgorithm>& algorithms) const
{
    std::vector<std::string> names;
    for (const NamedAlgorithm& named : algorithms) names.push_back(named.name);
    return base::List<base::Text>{}.print(names);
}

void TaskNames::read(const Node& node, std::vector<device::Task>& target, Reading& reading) const
{
    target.clear();
    for (const std::string& name : read_texts(node, reading)) {
        const auto task = device::task_named(name);
        if (!task) return reading.complain(node.place, task.error().message);
        target.push_back(*task);
    }
}

std::string TaskNames::print(const std::vector<device::Task>& tasks) const
{
    return base::List<base::Choice>{}.print(tasks);
}

std::string TaskNames::describe() const
{
    return fmt::format("a list of different tasks, or one: `\"{}\"`",
                       fmt::join(base::names_of_enum<device::Task>, "\"`, `\""));
}

void TierNames::read(const Node& node, std::vector<metrics::Tier>& target, Reading& reading) const
{
    target.clear();
    for (const std::string& name : read_texts(node, reading)) {
        const auto tier = name == name_of(metrics::Tier::good)     ? metrics::Tier::good
                          : name == name_of(metrics::Tier::usable) ? metrics::Tier::usable
                                                                   : metrics::Tier::unusable;
        if (tier == metrics::Tier::unusable) {
            return reading.complain(node.place,
                                    fmt::format("unknown tier '{}': use usable or good", name));
        }
        target.push_back(tier);
    }
}

std::string TierNames::print(const std::vector<metrics::Tier>& tiers) const
{
    return base::List<base::Choice>{}.print(tiers);
}

void PeerCounts::read(const Node& node, std::vector<std::uint32_t>& target, Reading& reading) const
{
    if (!std::holds_alternative<Node::List>(node.value)) {
        target.assign(1, 0);
        return peers_format.read(node, target.front(), reading);
    }
    base::List<base::Count>{peers_format, 1}.read(node, target, reading);
    for (auto count = target.begin(); count != target.end(); ++count) {
        if (std::find(target.begin(), count, *count) == count) continue;
        reading.complain(node.place, fmt::format("{} is there already", *count));
    }
}

std::string PeerCounts::print(const std::vector<std::uint32_t>& counts) const
{
    if (counts.size() == 1) return peers_format.print(counts.front());
    return base::List<base::Count>{peers_format}.print(counts);
}

std::string PeerCounts::describe() const
{
    return peers_format.describe() + ", or a list of different ones";
}

void SceneNames::read(const Node& node, std::vector<NamedScene>& target, Reading& reading) const
{
    target.clear();
    for (std::string& name : read_texts(node, reading)) {
        auto scene =
            scene::load_scene(name, [&](const std::string& file) { return reading.open(file); });
        if (!scene) return reading.complain(node.place, scene.error().message);
        target.push_back({std::move(name), *std::move(scene)});
    }
}

std::string SceneNames::print(const std::vector<NamedScene>& scenes) const
{
    std::vector<std::string> names;
    for (const NamedScene& named : scenes) names.push_back(named.name);
    if (names.size() == 1) return base::quoted(names.front());
    return base::List<base::Text>{}.print(names);
}

void DurationFormat::read(const Node& node, base::Duration& target, Reading& reading) const
{
    const auto* text = std::get_if<std::string>(&node.value);
    if (text != nullptr && *text == "script") {
        target = base::Duration{0};
    } else {
        time().read(node, target, reading);
    }
}

void TracesFormat::read(const Node& node, std::vector<NamedTrace>& target, Reading& reading) const
{
    const auto* list = std::get_if<Node::List>(&node.value);
    if (list == nullptr || list->size() != 2) return base::complain_of(node, describe(), reading);
    std::vector<NamedTrace> traces;
    for (const Node& one : *list) {
        NamedTrace& named = traces.emplace_back();
        base::read_value(one, named.name, reading);
        if (named.name.empty()) continue;
        const auto text = reading.open(named.name);
        if (!text) return reading.complain(one.place, text.error().message);
        auto trace = device::parse_hand_trace(*text, named.name);
        if (!trace) return reading.complain(one.place, trace.error().message);
        named.trace = std::make_shared<const device::HandTrace>(*std::move(trace));
    }
    target = std::move(traces);
}

std::string TracesFormat::print(const std::vector<NamedTrace>& traces) const
{
    std::vector<std::string> names;
    for (const NamedTrace& named : traces) names.push_back(named.name);
    return base::List<base::Text>{}.print(names);
}

namespace {

/// Reads recorded people, in the folder that a text names. Returns nullptr after a complaint.
std::shared_ptr<const hands::Population> read_people(const Node& node, Reading& reading)
{
    std::string folder;
    base::read_value(node, folder, reading);
    if (!reading.is_good()) return nullptr;
    auto people = hands::read_population(folder, reading);
    if (people) return std::make_shared<const hands::Population>(*std::move(people));
    std::string why = people.error().message;
    if (folder.find('/') == std::string::npos) {
        why = fmt::format("'{}' is neither an operator ({}) nor a folder of recorded hands: {}",
                          folder, fmt::join(device::operator_names, ", "), why);
    }
    reading.complain(node.place, why);
    return nullptr;
}

/// Reads the hand that follows people from a table.
std::optional<device::Operator> read_follower(const Node::Table& table, base::Place place,
                                              Reading& reading)
{
    Node rest{place, Node::Table{}};
    auto& entries = std::get<Node::Table>(rest.value);
    std::ranges::copy_if(table, std::back_inserter(entries),
                         [](const base::Entry& entry) { return entry.key != "people"; });
    auto person = device::read_operator(rest, reading);
    const bool says_wander =
        std::ranges::find(entries, "wander", &base::Entry::key) != entries.end();
    if (person && !says_wander) person->wander = hand_of_people().wander;
    return person;
}

} // namespace

void HandsFormat::read(const Node& node, Hands& target, Reading& reading) const
{
    const auto* text = std::get_if<std::string>(&node.value);
    if (text != nullptr && !device::operator_named(*text)) {
        if (auto people = read_people(node, reading))
            target = {hand_of_people(), hand_of_people(), std::move(people)};
        return;
    }
    if (const auto* table = std::get_if<Node::Table>(&node.value)) {
        const auto entry = std::ranges::find(*table, "people", &base::Entry::key);
        if (entry != table->end()) {
            auto people = read_people(entry->value, reading);
            const auto person = read_follower(*table, node.place, reading);
            if (people && person) target = {*person, *person, std::move(people)};
            return;
        }
    }
    const auto* list = std::get_if<Node::List>(&node.value);
    if (list != nullptr && list->size() != 2) {
        return reading.complain(node.place, "one operator for both hands, or a list of two: "
                                            "[\"nominal\", \"firm\"] of A and of B");
    }
    const auto left = device::read_operator(list == nullptr ? node : list->front(), reading);
    const auto right = list == nullptr ? left : device::read_operator(list->back(), reading);
    if (left && right) target = {*left, *right, nullptr};
}

std::string HandsFormat::print(const Hands& hands) const
{
    if (hands.people) {
        auto folder = base::quoted(hands.people->folder);
        if (hands.left == hand_of_people()) return folder;
        auto entries = base::field_texts(hands.left);
        entries.insert(entries.begin(), "people = " + folder);
        return base::table_text(entries);
    }
    std::string left = operator_text(hands.left);
    if (hands.left == hands.right) return left;
    return fmt::format("[{}, {}]", left, operator_text(hands.right));
}

void check(const SearchRange& range, base::Place place, Reading& reading)
{
    const auto refuse = [&](std::string_view what) { reading.complain(place, what); };
    if (range.from >= range.to) return refuse("'from' has to be less than 'to'");
    if (range.resolution.thousandths == 0) return refuse("'resolution' has to be more than 0");
    if (range.step.thousandths == 0 || range.step.thousandths % range.resolution.thousandths != 0) {
        return refuse("'step' has to be a multiple of 'resolution'");
    }
    if (range.to.thousandths / range.step.thousandths > search_levels_max) {
        return refuse(fmt::format("more than {} steps to 'to'", search_levels_max));
    }
}

void AxesFormat::read(const Node& node, std::vector<Axis>& target, Reading& reading) const
{
    std::vector<Axis> axes;
    if (const auto* list = std::get_if<Node::List>(&node.value)) {
        for (const Node& one : *list) base::read_table(one, axes.emplace_back(), reading);
    } else {
        base::read_table(node, axes.emplace_back(), reading);
    }
    if (reading.is_good()) target = std::move(axes);
}

std::string AxesFormat::print(const std::vector<Axis>& axes) const
{
    std::vector<std::string> texts;
    for (const Axis& axis : axes)
        texts.push_back(base::table_text(base::field_texts(axis, base::Print::needed)));
    if (texts.size() == 1) return texts.front();
    return fmt::format("[{}]", fmt::join(texts, ", "));
}

void LevelsFormat::read(const Node& node, std::vector<ImpairmentLevel>& target,
                        Reading& reading) const
{
    if (std::holds_alternative<Node::List>(node.value))
        return base::List<LevelFormat>{level, 1}.read(node, target, reading);
    target.assign(1, {});
    level.read(node, target.front(), reading);
}

std::string LevelsFormat::print(const std::vector<ImpairmentLevel>& levels) const
{
    return base::List<LevelFormat>{level}.print(levels);
}

void RangesFormat::read(const Node& node, SearchRanges& target, Reading& reading) const
{
    base::Table::read(node, target, reading);
    if (target != SearchRanges{}) return;
    reading.complain(node.place, "there is no [limit.delay], [limit.jitter], [limit.random-loss], "
                                 "[limit.burst-loss] or [limit.interval]");
}

Experiment usual_experiment()
{
    Experiment experiment;
    for (const char* name : {"base", "sep", "dead-reckoning"}) {
        experiment.algorithms.push_back({name, {}});
    }
    return experiment;
}

} // namespace hapnet::lab::experiment
