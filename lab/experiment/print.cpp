// SPDX-FileCopyrightText: 2026 The Hapnet authors
// SPDX-License-Identifier: MIT
#include "emulator/core/profile/text.hpp"
#include "lab/experiment/text.hpp"
#include "peer/core/sync/text.hpp"

#include <spdlog/fmt/fmt.h>
#include <string>
#include <vector>

namespace hapnet::lab::experiment {

namespace {

/// Lines `key = value` as `{ key = value, ... }`.
std::string inline_table(std::string_view lines)
{
    std::vector<std::string> entries;
    while (!lines.empty()) {
        const auto end = std::min(lines.find('\n'), lines.size());
        if (end > 0) entries.emplace_back(lines.substr(0, end));
        lines.remove_prefix(std::min(end + 1, lines.size()));
    }
    return base::table_text(entries);
}

std::string operator_text(const device::Operator& person)
{
    const auto preset = device::operator_named(person.name);
    if (preset && *preset == person) return base::quoted(person.name);
    return inline_table(device::print_operator(person));
}

std::string hands_text(const Hands& hands)
{
    auto left = operator_text(hands.left);
    if (hands.left == hands.right) return left;
    const auto right = operator_text(hands.right);
    return fmt::format("[{}, {}]", left, right);
}

template <typename List, typename ToText>
std::string toml_list(const List& list, ToText to_toml)
{
    std::vector<std::string> elements;
    for (const auto& element : list) elements.push_back(to_toml(element));
    return fmt::format("[{}]", base::list_text(elements));
}

std::string tasks_text(const std::vector<device::Task>& tasks)
{
    return toml_list(tasks, [](device::Task task) { return base::quoted(name_of(task)); });
}

std::string levels_text(const std::vector<ImpairmentLevel>& levels, Impairment impairment)
{
    return toml_list(levels, [&](ImpairmentLevel level) { return level_text(level, impairment); });
}

struct KindText {
    std::string operator()(const Table1& table) const
    {
        return fmt::format("rows_per_second = {}\n", table.rows_per_s);
    }
    std::string operator()(const Trajectories& trajectories) const
    {
        return fmt::format("rows_per_second = {}\n", trajectories.rows_per_s);
    }
    std::string operator()(const Limits&) const { return ""; }
    std::string operator()(const ImpairmentGrid&) const { return ""; }
    std::string operator()(const Calibration&) const { return ""; }
};

/// The tables of a kind, which come after all bare keys.
struct KindTables {
    std::string operator()(const Table1&) const { return ""; }
    std::string operator()(const Trajectories&) const { return ""; }
    std::string operator()(const Limits& limits) const
    {
        std::string out;
        for (const SearchRange& range : limits.ranges) {
            const auto level = [&](ImpairmentLevel value) {
                return level_text(value, range.impairment);
            };
            out += fmt::format("\n[limit.{}]\nfrom = {}\nto = {}\nstep = {}\nresolution = {}\n",
                               name_of(range.impairment), level(range.from), level(range.to),
                               level(range.step), level(range.resolution));
        }
        if (!limits.sensitivity) return out;
        const Sensitivity& sensitivity = *limits.sensitivity;
        out += fmt::format("\n[convention]\nfilter_orders = {}\n",
                           toml_list(sensitivity.filter_orders, [](metrics::FilterOrder order) {
                               return fmt::format("{}", count_of(order));
                           }));
        out += fmt::format("hands = {}\n", toml_list(sensitivity.hands, hands_text));
        out += fmt::format("tasks = {}\nseeds = {}\n", tasks_text(sensitivity.tasks),
                           sensitivity.seeds);
        return out;
    }
    std::string operator()(const ImpairmentGrid& plane) const
    {
        return fmt::format("\n[plane]\ndelay = {}\njitter = {}\nloss = {}\n",
                           levels_text(plane.delays, Impairment::delay),
                           levels_text(plane.jitters, Impairment::jitter),
                           levels_text(plane.losses, Impairment::random_loss));
    }
    std::string operator()(const Calibration& calibration) const
    {
        return fmt::format("\n[calibration]\ndelay = {}\nrandom-loss = {}\n",
                           level_text(calibration.delay, Impairment::delay),
                           level_text(calibration.random_loss, Impairment::random_loss));
    }
};

} // namespace

std::string to_text(const Experiment& experiment)
{
    std::string out;
    if (!experiment.title.empty()) {
        out += fmt::format("title = {}\n", base::quoted(experiment.title));
    }
    out += fmt::format("kind = {}\n", base::quoted(name_of(experiment.kind)));
    out += fmt::format("duration = {}\ntick = {}\n", base::value_text(experiment.duration),
                       base::value_text(experiment.tick));
    out += fmt::format("seeds = {}\nfirst_seed = {}\n", experiment.seeds, experiment.first_seed);
    out += fmt::format("algorithms = {}\n",
                       toml_list(experiment.algorithms, [](const NamedAlgorithm& algorithm) {
                           return base::quoted(algorithm.name);
                       }));
    out += fmt::format("tasks = {}\nhands = {}\n", tasks_text(experiment.tasks),
                       hands_text(experiment.hands));
    out += std::visit(KindText{}, experiment.kind);
    out += emulator::to_text(emulator::Profile{{}, {}, experiment.path, {}});
    out += std::visit(KindTables{}, experiment.kind);
    for (const NamedAlgorithm& named : experiment.algorithms) {
        out += fmt::format("\n[algorithm.{}]\n{}", base::quoted(named.name),
                           peer::print_algorithm(named.algorithm));
    }
    return out;
}

} // namespace hapnet::lab::experiment
