// SPDX-FileCopyrightText: 2026 The Hapnet authors
// SPDX-License-Identifier: MIT
#include "lab/experiment/parts.hpp"

#include "lab/experiment/plane.hpp"

#include <algorithm>
#include <array>
#include <functional>
#include <utility>

namespace hapnet::lab {

namespace {

std::uint32_t seeds_end(const Experiment& experiment, std::uint32_t seeds)
{
    return experiment.first_seed + seeds;
}

/// The sessions of all algorithms, tasks and seeds under the same conditions.
struct PartsOfSessions {
    const Experiment& experiment;
    std::vector<Part>& parts;

    void add(const std::vector<device::Task>& tasks, const emulator::Path& path,
             std::uint32_t rows_per_s_of_first_seed) const
    {
        for (std::size_t i = 0; i < experiment.algorithms.size(); ++i) {
            for (const device::Task task : tasks) {
                for (std::uint32_t seed = experiment.first_seed;
                     seed < seeds_end(experiment, experiment.seeds); ++seed) {
                    auto spec = spec_of(
                        experiment, {experiment.algorithms[i], experiment.hands, task, seed}, path);
                    const bool is_first = seed == experiment.first_seed;
                    spec.rows_per_s = is_first ? rows_per_s_of_first_seed : 0;
                    parts.emplace_back(SessionPart{i, task, std::move(spec)});
                }
            }
        }
    }
};

struct PartsOf {
    const Experiment& experiment;
    std::vector<Part>& parts;

    void operator()(const Table1& table) const
    {
        std::vector<device::Task> tasks{device::Task::p1};
        for (const device::Task task : experiment.tasks) {
            if (task != device::Task::p1) tasks.push_back(task);
        }
        PartsOfSessions{experiment, parts}.add(tasks, experiment.path, table.rows_per_s);
    }
    void operator()(const Limits& limits) const
    {
        for_each_search(limits, experiment.tasks,
                        [&](SearchPart part) { parts.emplace_back(std::move(part)); });
        if (!limits.convention) return;
        for_each_search(limits, limits.convention->tasks, [&](const SearchPart& part) {
            for (const Hands& hands : limits.convention->hands) {
                parts.emplace_back(ConventionPart{part.algorithm, part.task, part.range, hands});
            }
        });
    }
    void operator()(const Trajectories& trajectories) const
    {
        for (std::size_t i = 0; i < experiment.algorithms.size(); ++i) {
            const device::Task task = experiment.tasks.front();
            auto spec =
                spec_of(experiment,
                        {experiment.algorithms[i], experiment.hands, task, experiment.first_seed},
                        experiment.path);
            spec.rows_per_s = trajectories.rows_per_s;
            parts.emplace_back(SessionPart{i, task, std::move(spec)});
        }
    }
    void operator()(const Plane& plane) const
    {
        for (const PlaneCell& cell : cells_of(plane)) {
            PartsOfSessions{experiment, parts}.add(experiment.tasks, path_of(experiment.path, cell),
                                                   0);
        }
    }
    void operator()(const Calibration& calibration) const
    {
        const auto add = [&](Impairment impairment, Level level) {
            PartsOfSessions{experiment, parts}.add(experiment.tasks,
                                                   impaired(experiment.path, impairment, level), 0);
        };
        add(Impairment::delay, calibration.delay);
        add(Impairment::random_loss, calibration.random_loss);
    }

private:
    void for_each_search(const Limits& limits, const std::vector<device::Task>& tasks,
                         const std::function<void(SearchPart)>& use) const
    {
        for (std::size_t i = 0; i < experiment.algorithms.size(); ++i) {
            for (const SearchRange& range : limits.ranges) {
                for (const device::Task task : tasks) use({i, task, range});
            }
        }
    }
};

/// One search: judges cells, seed after seed, and keeps what it has judged.
class CellJudge {
public:
    CellJudge(const Experiment& experiment, Cell cell, Impairment impairment,
              const PlaySession& play)
        : experiment_{experiment}, cell_{cell}, impairment_{impairment}, play_{play}
    {}

    /// Whether all seeds are usable; the first that is not ends it.
    base::Result<bool> passes(Level level, std::uint32_t seeds, const Criteria& criteria)
    {
        for (std::uint32_t seed = experiment_.first_seed; seed < seeds_end(experiment_, seeds);
             ++seed) {
            const auto scores = scores_at(level, seed);
            if (!scores) return tl::unexpected{scores.error()};
            const Tier tier = judge(*scores, criteria).tier;
            curve_.push_back({level, seed, *scores, tier});
            if (tier == Tier::unusable) return false;
        }
        return true;
    }

    std::vector<CurvePoint> curve() &&
    {
        std::stable_sort(curve_.begin(), curve_.end(),
                         [](const auto& a, const auto& b) { return a.level < b.level; });
        return std::move(curve_);
    }

private:
    base::Result<Scores> scores_at(Level level, std::uint32_t seed)
    {
        cell_.seed = seed;
        const auto path = impaired(experiment_.path, impairment_, level);
        const auto spec = spec_of(experiment_, cell_, path);
        const auto played = play_(spec);
        if (!played) return tl::unexpected{played.error()};
        const auto perfect = play_(perfect_twin(spec));
        if (!perfect) return tl::unexpected{perfect.error()};
        return scores_of(played->metrics, perfect->metrics);
    }

    const Experiment& experiment_;
    Cell cell_;
    Impairment impairment_;
    const PlaySession& play_;
    std::vector<CurvePoint> curve_;
};

struct CarryOut {
    const Experiment& experiment;
    const Criteria& criteria;
    const PlaySession& play;

    base::Result<Finding> operator()(const SessionPart& part) const
    {
        auto played = play(part.spec);
        if (!played) return tl::unexpected{played.error()};
        auto perfect = play(perfect_twin(part.spec));
        if (!perfect) return tl::unexpected{perfect.error()};
        return SessionFinding{std::move(played->metrics), std::move(perfect->metrics),
                              std::move(played->rows)};
    }

    base::Result<Finding> operator()(const SearchPart& part) const
    {
        CellJudge cells{experiment,
                        {experiment.algorithms[part.algorithm], experiment.hands, part.task},
                        part.range.impairment,
                        play};
        const auto limit = find_limit(part.range, [&](Level level) {
            return cells.passes(level, experiment.seeds, criteria);
        });
        if (!limit) return tl::unexpected{limit.error()};
        return SearchFinding{*limit, std::move(cells).curve()};
    }

    base::Result<Finding> operator()(const ConventionPart& part) const
    {
        const Convention& convention = *std::get<Limits>(experiment.kind).convention;
        CellJudge cells{experiment,
                        {experiment.algorithms[part.algorithm], part.hands, part.task},
                        part.range.impairment,
                        play};
        ConventionFinding finding;
        for (const FilterOrder order : convention.filter_orders) {
            Criteria by_order = criteria;
            by_order.filter_order = order;
            const auto limit = find_limit(part.range, [&](Level level) {
                return cells.passes(level, convention.seeds, by_order);
            });
            if (!limit) return tl::unexpected{limit.error()};
            finding.limits.push_back(*limit);
        }
        return finding;
    }
};

} // namespace

std::vector<Part> parts_of(const Experiment& experiment)
{
    std::vector<Part> parts;
    std::visit(PartsOf{experiment, parts}, experiment.kind);
    return parts;
}

base::Result<Finding> carry_out(const Part& part, const Experiment& experiment,
                                const Criteria& criteria, const PlaySession& play)
{
    return std::visit(CarryOut{experiment, criteria, play}, part);
}

} // namespace hapnet::lab
