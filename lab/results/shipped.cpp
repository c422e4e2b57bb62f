// SPDX-FileCopyrightText: 2026 The Hapnet authors
// SPDX-License-Identifier: MIT
#include "lab/results/shipped.hpp"

#include "lab/experiment/criteria_text.hpp"
#include "lab/experiment/text.hpp"
#include "peer/core/sync/text.hpp"

namespace hapnet::lab::results {

namespace {

bool has_free_jitter(const experiment::Experiment& experiment)
{
    const auto* limits = std::get_if<experiment::Limits>(&experiment.kind);
    return limits == nullptr || limits->jitter_order == emulator::Order::free;
}

bool has_same_sessions(const experiment::Experiment& a, const experiment::Experiment& b)
{
    // Table 1 compares only P1 with the paper, whatever other tasks are played.
    const bool are_tasks = a.tasks == b.tasks || std::holds_alternative<experiment::Table1>(a.kind);
    return a.kind.index() == b.kind.index() && a.duration == b.duration && a.tick == b.tick &&
           are_tasks && a.peers == b.peers && a.scenes.empty() && b.scenes.empty() &&
           a.hands == b.hands && a.energy_limit == b.energy_limit && a.keyed == b.keyed &&
           a.path == b.path && a.links == b.links && a.replay.empty() && b.replay.empty() &&
           a.script.empty() && b.script.empty() && a.task_options == b.task_options &&
           has_free_jitter(a) && has_free_jitter(b);
}

} // namespace

bool plays_as_shipped(const experiment::Experiment& experiment, const metrics::Criteria& criteria,
                      std::string_view built_in)
{
    const base::OpenFile none = [](const std::string& file) { return base::fail(file); };
    const auto shipped = experiment::load_experiment(std::string{built_in}, none, {});
    const auto judged = experiment::load_criteria("paper", none);
    if (!shipped || !judged) return false;
    return has_same_sessions(experiment, *shipped) && criteria == *judged;
}

bool is_built_in(const experiment::NamedAlgorithm& algorithm)
{
    const auto built_in = peer::algorithm_named(algorithm.name);
    return built_in &&
           peer::print_algorithm(*built_in) == peer::print_algorithm(algorithm.algorithm);
}

} // namespace hapnet::lab::results
