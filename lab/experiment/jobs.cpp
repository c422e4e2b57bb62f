// SPDX-FileCopyrightText: 2026 The Hapnet authors
// SPDX-License-Identifier: MIT
#include "lab/experiment/jobs.hpp"

#include "lab/experiment/claims.hpp"
#include "lab/experiment/grid.hpp"
#include "lab/metrics/exercise.hpp"

#include <algorithm>
#include <array>
#include <functional>
#include <map>
#include <span>
#include <utility>

namespace hapnet::lab::experiment {

namespace {

std::uint32_t seeds_end(const Experiment& experiment, std::uint32_t seeds)
{
    return experiment.first_seed + seeds;
}

/// A range of seeds.
struct Seeds {
    std::uint32_t first = 1;
    std::uint32_t count = 1;
};

/// True if the network may draw random numbers: only a constant delay never does.
bool has_chance(const emulator::Path& path)
{
    emulator::Path delayed;
    delayed.up.delay = path.up.delay;
    delayed.down.delay = path.down.delay;
    const auto is_constant = [](const emulator::Conditions& conditions) {
        return std::holds_alternative<emulator::ConstantLaw>(conditions.delay.law);
    };
    return path != delayed || !is_constant(path.up) || !is_constant(path.down);
}

/// The sessions of all algorithms, tasks, trials and seeds under the same conditions.
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
        // P1 has a prescribed path. Without random draws every seed gives the same bits.
        const bool is_one =
            one.task == device::Task::p1 && !has_chance(path) && experiment.links.empty();
        for (one.trial = 0; one.trial < one.hands.trials(); ++one.trial) {
            one.seed = experiment.first_seed;
            for (; one.seed < seeds_end(experiment, is_one ? 1 : experiment.seeds); ++one.seed) {
                auto spec = make_session_spec(experiment, one, path);
                const bool is_first = one.trial == 0 && one.seed == experiment.first_seed;
                spec.rows_per_s = is_first ? rows_per_s_of_first_seed : 0;
                jobs.emplace_back(
                    SessionJob{algorithm, one.task, std::move(spec), one.party, one.trial});
            }
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
        if (!limits.sensitivity || limits.sensitivity->seeds == 0) return;
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

/// Returns the reference for a session's scores. The session in one shared world is played only
/// where stiffness is measured.
base::Result<metrics::Metrics> reference_of(const SessionSpec& spec, const PlaySession& play)
{
    auto perfect = play(perfect_twin(spec));
    if (!perfect) return tl::unexpected{std::move(perfect).error()};
    if (!metrics::exercise_of(spec.setting.task).presses) return std::move(perfect->metrics);
    const auto one_world = play(one_world_twin(spec));
    if (!one_world) return tl::unexpected{one_world.error()};
    return make_reference(std::move(perfect->metrics), one_world->metrics);
}

/// One search: plays sessions on demand, and keeps their scores.
class LevelPlayer {
public:
    LevelPlayer(const Experiment& experiment, SessionCase session, Impairment impairment,
                const PlaySession& play)
        : experiment_{experiment}, session_{session}, impairment_{impairment}, play_{play}
    {}

    base::Result<metrics::Scores> scores_at(ImpairmentLevel level, std::uint32_t seed)
    {
        const auto known = scores_.find({level, seed});
        if (known != scores_.end()) return known->second;
        session_.seed = seed;
        const auto order = std::get<Limits>(experiment_.kind).jitter_order;
        const auto path = impaired(experiment_.path, impairment_, level, order);
        // The effect of fewer messages counts, so the reference sends as the experiment states.
        const auto unthinned = make_session_spec(experiment_, session_, path);
        auto spec = unthinned;
        for (auto& player : spec.setting.players)
            player.send = thinned(player.send, impairment_, level);
        const auto played = play_(spec);
        if (!played) return tl::unexpected{played.error()};
        const auto reference = reference_of(unthinned, play_);
        if (!reference) return tl::unexpected{reference.error()};
        const auto scores = scores_of(played->metrics, *reference);
        scores_.emplace(std::pair{level, seed}, scores);
        return scores;
    }

    using Sessions = std::map<std::pair<ImpairmentLevel, std::uint32_t>, metrics::Scores>;
    [[nodiscard]] const Sessions& all() const { return scores_; }

private:
    const Experiment& experiment_;
    SessionCase session_;
    Impairment impairment_;
    const PlaySession& play_;
    Sessions scores_;
};

/// The demand on a session. The session fails if it is below the tier.
struct Demand {
    const metrics::Criteria& criteria;
    metrics::Tier tier = metrics::Tier::usable;
};

/// Searches the levels that count. Returns which seeds fail at them.
base::Result<std::vector<metrics::LevelOutcome>>
searched(LevelPlayer& player, const SearchRange& range, Seeds seeds, const Demand& demand)
{
    const auto fails = [&](ImpairmentLevel level, std::uint32_t index) -> base::Result<bool> {
        return player.scores_at(level, seeds.first + index).map([&](const auto& scores) {
            return judge(scores, demand.criteria).tier < demand.tier;
        });
    };
    const auto outcome_at = [&](ImpairmentLevel level,
                                std::uint32_t count) -> base::Result<metrics::LevelOutcome> {
        metrics::LevelOutcome outcome{in_units(level), {}};
        for (std::uint32_t index = 0; index < count; ++index) {
            const auto failed = fails(level, index);
            if (!failed) return tl::unexpected{failed.error()};
            outcome.failed.push_back(*failed);
        }
        return outcome;
    };
    const auto levels =
        levels_to_count(range, seeds.count, [&](ImpairmentLevel level, std::uint32_t count) {
            return outcome_at(level, count).map([](const metrics::LevelOutcome& outcome) {
                return static_cast<std::uint32_t>(std::ranges::count(outcome.failed, true));
            });
        });
    if (!levels) return tl::unexpected{levels.error()};
    std::vector<metrics::LevelOutcome> outcomes;
    for (const ImpairmentLevel level : *levels) {
        auto outcome = outcome_at(level, seeds.count);
        if (!outcome) return tl::unexpected{outcome.error()};
        outcomes.push_back(*std::move(outcome));
    }
    return outcomes;
}

/// Returns all sessions that were played for a search. `outcomes` are those of each tier.
std::vector<CurvePoint> curve_of(const LevelPlayer& player,
                                 std::span<const std::vector<metrics::LevelOutcome>> outcomes,
                                 const metrics::Criteria& criteria)
{
    std::vector<CurvePoint> curve;
    for (const auto& [which, scores] : player.all()) {
        const auto& [level, seed] = which;
        const bool counts = std::ranges::any_of(outcomes, [at = in_units(level)](const auto& tier) {
            return std::ranges::find(tier, at, &metrics::LevelOutcome::level) != tier.end();
        });
        curve.push_back({level, seed, counts, scores, judge(scores, criteria).tier});
    }
    return curve;
}

struct RunJob {
    const Experiment& experiment;
    const metrics::Criteria& criteria;
    const PlaySession& play;

    base::Result<JobResult> operator()(const SessionJob& job) const
    {
        auto played = play(job.spec);
        if (!played) return tl::unexpected{played.error()};
        auto reference = reference_of(job.spec, play);
        if (!reference) return tl::unexpected{reference.error()};
        return SessionResult{std::move(played->metrics), *std::move(reference),
                             std::move(played->rows)};
    }

    base::Result<JobResult> operator()(const SearchJob& job) const
    {
        LevelPlayer player{experiment,
                           {experiment.algorithms[job.algorithm], experiment.hands, job.task,
                            experiment.first_seed, job.party},
                           job.range.impairment,
                           play};
        SearchResult result;
        for (const metrics::Tier tier : std::get<Limits>(experiment.kind).tiers) {
            auto outcomes = searched(player, job.range, {experiment.first_seed, experiment.seeds},
                                     {criteria, tier});
            if (!outcomes) return tl::unexpected{outcomes.error()};
            result.outcomes.push_back(*std::move(outcomes));
        }
        result.curve = curve_of(player, result.outcomes, criteria);
        return result;
    }

    base::Result<JobResult> operator()(const SensitivityJob& job) const
    {
        const Sensitivity& sensitivity = *std::get<Limits>(experiment.kind).sensitivity;
        LevelPlayer player{experiment,
                           {experiment.algorithms[job.algorithm], job.hands, job.task,
                            experiment.first_seed, job.party},
                           job.range.impairment,
                           play};
        SensitivityResult result;
        for (const metrics::FilterOrder order : sensitivity.filter_orders) {
            metrics::Criteria by_order = criteria;
            by_order.filter_order = order;
            auto outcomes =
                searched(player, job.range, {experiment.first_seed, sensitivity.seeds}, {by_order});
            if (!outcomes) return tl::unexpected{outcomes.error()};
            result.outcomes.push_back(*std::move(outcomes));
        }
        return result;
    }

    base::Result<JobResult> operator()(const SilenceJob& job) const
    {
        const auto played = play(job.spec);
        if (!played) return tl::unexpected{played.error()};
        if (!played->apart_m) return base::fail("a session does not say how it ended in silence");
        return SilenceResult{*played->apart_m};
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
