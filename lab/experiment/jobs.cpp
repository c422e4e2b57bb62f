// SPDX-FileCopyrightText: 2026 The Hapnet authors
// SPDX-License-Identifier: MIT
#include "lab/experiment/jobs.hpp"

#include "lab/experiment/claims.hpp"
#include "lab/experiment/grid.hpp"

#include <algorithm>
#include <array>
#include <functional>
#include <utility>

namespace hapnet::lab::experiment {

namespace {

std::uint32_t seeds_end(const Experiment& experiment, std::uint32_t seeds)
{
    return experiment.first_seed + seeds;
}

/// The sessions of all algorithms, tasks and seeds under the same conditions.
struct SessionJobs {
    const Experiment& experiment;
    std::vector<Job>& jobs;

    void add(const std::vector<device::Task>& tasks, const emulator::Path& path,
             std::uint32_t rows_per_s_of_first_seed) const
    {
        for (std::size_t i = 0; i < experiment.algorithms.size(); ++i) {
            for (const Party& party : parties_of(experiment)) {
                for (const device::Task task : tasks) {
                    add_seeds({experiment.algorithms[i], experiment.hands, task,
                               experiment.first_seed, party},
                              i, path, rows_per_s_of_first_seed);
                }
            }
        }
    }

private:
    void add_seeds(SessionCase one, std::size_t algorithm, const emulator::Path& path,
                   std::uint32_t rows_per_s_of_first_seed) const
    {
        for (; one.seed < seeds_end(experiment, experiment.seeds); ++one.seed) {
            auto spec = make_session_spec(experiment, one, path);
            const bool is_first = one.seed == experiment.first_seed;
            spec.rows_per_s = is_first ? rows_per_s_of_first_seed : 0;
            jobs.emplace_back(SessionJob{algorithm, one.task, std::move(spec), one.party});
        }
    }
};

struct MakeJobs {
    const Experiment& experiment;
    std::vector<Job>& jobs;

    void operator()(const Table1& table) const
    {
        std::vector<device::Task> tasks{device::Task::p1};
        for (const device::Task task : experiment.tasks) {
            if (task != device::Task::p1) tasks.push_back(task);
        }
        SessionJobs{experiment, jobs}.add(tasks, experiment.path, table.rows_per_s);
    }
    void operator()(const Limits& limits) const
    {
        for_each_search(limits, experiment.tasks,
                        [&](SearchJob job) { jobs.emplace_back(std::move(job)); });
        if (!limits.sensitivity) return;
        for_each_search(limits, limits.sensitivity->tasks, [&](const SearchJob& job) {
            for (const Hands& hands : limits.sensitivity->hands) {
                jobs.emplace_back(
                    SensitivityJob{job.algorithm, job.task, job.range, job.party, hands});
            }
        });
    }
    void operator()(const Trajectories& trajectories) const
    {
        for (std::size_t i = 0; i < experiment.algorithms.size(); ++i) {
            const device::Task task = experiment.tasks.front();
            const Party party = parties_of(experiment).front();
            auto spec = make_session_spec(
                experiment,
                {experiment.algorithms[i], experiment.hands, task, experiment.first_seed, party},
                experiment.path);
            spec.rows_per_s = trajectories.rows_per_s;
            jobs.emplace_back(SessionJob{i, task, std::move(spec), party});
        }
    }
    void operator()(const ImpairmentGrid& plane) const
    {
        for (const GridPoint& point : grid_points(plane)) {
            SessionJobs{experiment, jobs}.add(experiment.tasks, make_path(experiment.path, point),
                                              0);
        }
    }
    void operator()(const Calibration& calibration) const
    {
        const auto add = [&](Impairment impairment, ImpairmentLevel level) {
            SessionJobs{experiment, jobs}.add(experiment.tasks,
                                              impaired(experiment.path, impairment, level), 0);
        };
        add(Impairment::delay, calibration.delay);
        add(Impairment::random_loss, calibration.random_loss);
    }
    void operator()(const Claims& /*claims*/) const { jobs = claim_jobs(experiment); }

private:
    void for_each_search(const Limits& limits, const std::vector<device::Task>& tasks,
                         const std::function<void(SearchJob)>& use) const
    {
        for (std::size_t i = 0; i < experiment.algorithms.size(); ++i) {
            for (const SearchRange& range : ranges_of(limits)) {
                for (const Party& party : parties_of(experiment)) {
                    for (const device::Task task : tasks) use({i, task, range, party});
                }
            }
        }
    }
};

/// One search: judges levels, seed after seed, and keeps what it has judged.
class LevelJudge {
public:
    LevelJudge(const Experiment& experiment, SessionCase session, Impairment impairment,
               const PlaySession& play)
        : experiment_{experiment}, session_{session}, impairment_{impairment}, play_{play}
    {}

    /// Whether all seeds are usable; the first that is not ends it.
    base::Result<bool> passes(ImpairmentLevel level, std::uint32_t seeds,
                              const metrics::Criteria& criteria)
    {
        for (std::uint32_t seed = experiment_.first_seed; seed < seeds_end(experiment_, seeds);
             ++seed) {
            const auto scores = scores_at(level, seed);
            if (!scores) return tl::unexpected{scores.error()};
            const metrics::Tier tier = judge(*scores, criteria).tier;
            curve_.push_back({level, seed, *scores, tier});
            if (tier == metrics::Tier::unusable) return false;
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
    base::Result<metrics::Scores> scores_at(ImpairmentLevel level, std::uint32_t seed)
    {
        session_.seed = seed;
        const auto path = impaired(experiment_.path, impairment_, level);
        const auto spec = make_session_spec(experiment_, session_, path);
        const auto played = play_(spec);
        if (!played) return tl::unexpected{played.error()};
        const auto perfect = play_(perfect_twin(spec));
        if (!perfect) return tl::unexpected{perfect.error()};
        return scores_of(played->metrics, perfect->metrics);
    }

    const Experiment& experiment_;
    SessionCase session_;
    Impairment impairment_;
    const PlaySession& play_;
    std::vector<CurvePoint> curve_;
};

struct RunJob {
    const Experiment& experiment;
    const metrics::Criteria& criteria;
    const PlaySession& play;

    base::Result<JobResult> operator()(const SessionJob& job) const
    {
        auto played = play(job.spec);
        if (!played) return tl::unexpected{played.error()};
        auto perfect = play(perfect_twin(job.spec));
        if (!perfect) return tl::unexpected{perfect.error()};
        return SessionResult{std::move(played->metrics), std::move(perfect->metrics),
                             std::move(played->rows)};
    }

    base::Result<JobResult> operator()(const SearchJob& job) const
    {
        LevelJudge levels{experiment,
                          {experiment.algorithms[job.algorithm], experiment.hands, job.task,
                           experiment.first_seed, job.party},
                          job.range.impairment,
                          play};
        const auto limit = find_limit(job.range, [&](ImpairmentLevel level) {
            return levels.passes(level, experiment.seeds, criteria);
        });
        if (!limit) return tl::unexpected{limit.error()};
        return SearchResult{*limit, std::move(levels).curve()};
    }

    base::Result<JobResult> operator()(const SensitivityJob& job) const
    {
        const Sensitivity& sensitivity = *std::get<Limits>(experiment.kind).sensitivity;
        LevelJudge levels{experiment,
                          {experiment.algorithms[job.algorithm], job.hands, job.task,
                           experiment.first_seed, job.party},
                          job.range.impairment,
                          play};
        SensitivityResult result;
        for (const metrics::FilterOrder order : sensitivity.filter_orders) {
            metrics::Criteria by_order = criteria;
            by_order.filter_order = order;
            const auto limit = find_limit(job.range, [&](ImpairmentLevel level) {
                return levels.passes(level, sensitivity.seeds, by_order);
            });
            if (!limit) return tl::unexpected{limit.error()};
            result.limits.push_back(*limit);
        }
        return result;
    }

    base::Result<JobResult> operator()(const SilenceJob& job) const
    {
        return apart_after_silence(job.spec).map(
            [](double apart_m) -> JobResult { return SilenceResult{apart_m}; });
    }
};

} // namespace

std::vector<Job> make_jobs(const Experiment& experiment)
{
    std::vector<Job> jobs;
    std::visit(MakeJobs{experiment, jobs}, experiment.kind);
    return jobs;
}

base::Result<JobResult> run_job(const Job& job, const Experiment& experiment,
                                const metrics::Criteria& criteria, const PlaySession& play)
{
    return std::visit(RunJob{experiment, criteria, play}, job);
}

} // namespace hapnet::lab::experiment
