// SPDX-FileCopyrightText: 2026 The Hapnet authors
// SPDX-License-Identifier: MIT
#include "lab/results/found.hpp"

#include "lab/experiment/grid.hpp"
#include "lab/metrics/calibration.hpp"
#include "lab/results/claim_tables.hpp"
#include "lab/results/limit_tables.hpp"
#include "lab/results/paper.hpp"
#include "lab/results/party_columns.hpp"
#include "lab/results/replay.hpp"
#include "lab/results/requirements.hpp"
#include "lab/results/session_rows.hpp"
#include "lab/results/shipped.hpp"
#include "lab/results/summary.hpp"
#include "proto/base/math.hpp"
#include "scene/text/text.hpp"

#include <algorithm>
#include <array>
#include <spdlog/fmt/fmt.h>
#include <string_view>
#include <utility>

namespace hapnet::lab::results {

namespace {

/// The findings about the sessions of one algorithm and task, in the order of the trials and the
/// seeds.
struct Group {
    std::string_view algorithm;
    device::Task task{};
    std::vector<metrics::Scores> scores{};
    std::string_view rows{}; // rows of the replay of the first seed
    experiment::Party party{};
    scene::Description scene{};
    std::vector<std::string> subjects{}; // subject of each session; empty with simulated hands
};

/// Returns the results of single sessions, by algorithm and task. Each point of a grid starts a new
/// group.
std::vector<Group> groups_of(const experiment::Experiment& experiment,
                             std::span<const experiment::JobResult> results)
{
    const auto jobs = make_jobs(experiment);
    std::vector<Group> groups;
    for (std::size_t i = 0; i < jobs.size(); ++i) {
        const auto& job = std::get<experiment::SessionJob>(jobs[i]);
        const auto& result = std::get<experiment::SessionResult>(results[i]);
        if (job.trial == 0 && job.spec.setting.seed.value() == experiment.first_seed) {
            groups.push_back({experiment.algorithms[job.algorithm].name,
                              job.task,
                              {},
                              result.rows,
                              job.party,
                              job.spec.setting.scene});
        }
        groups.back().scores.push_back(scores_of(result.metrics, result.reference));
        if (const hands::Trial* trial = experiment.hands.trial(job.trial))
            groups.back().subjects.push_back(trial->subject);
    }
    return groups;
}

metrics::Spread in_mm(const metrics::Spread& metres)
{
    return {1e3 * metres.mean, 1e3 * metres.min, 1e3 * metres.max, 1e3 * metres.std};
}

std::optional<metrics::Spread> base_in_mm(const std::vector<Group>& groups,
                                          const metrics::Criteria& criteria)
{
    for (const Group& group : groups) {
        if (group.algorithm != "base" || group.task != device::Task::p1) continue;
        const auto typical = summarize(group.scores, criteria, group.subjects).typical_m;
        if (typical) return in_mm(*typical);
    }
    return std::nullopt;
}

std::optional<double> in_thousandths(std::optional<double> value)
{
    return value ? std::optional{1e3 * *value} : std::nullopt;
}

std::optional<double> in_thousands(std::optional<double> value)
{
    return value ? std::optional{1e-3 * *value} : std::nullopt;
}

/// Adds a row of Table 1. `is_papers` is true if it was played like the paper's table.
void add_table1_row(const Group& group, const Summary& summary,
                    const std::optional<metrics::Spread>& base_mm, bool is_papers, Table& table)
{
    const metrics::Spread mm = in_mm(summary.typical_m.value_or(metrics::Spread{}));
    const auto paper = is_papers ? paper_table1(group.algorithm) : std::nullopt;
    const auto papers = [&](double PaperRow::*value) {
        return paper ? std::optional{(*paper).*value} : std::nullopt;
    };
    const Table1Provenance provenance =
        paper ? table1_provenance(group.algorithm) : Table1Provenance{};
    Claim verdict{};
    if (paper)
        verdict = summary.typical_m ? table1_verdict(group.algorithm, mm, base_mm) : Claim::missed;
    const auto bands = paper ? table1_bands(group.algorithm, base_mm) : std::nullopt;
    const auto end = [&](Band Table1Bands::*of, double Band::*side) {
        return bands ? std::optional{(*bands).*of.*side} : std::nullopt;
    };
    table.add(group.algorithm, mm.mean, mm.min, mm.max, mm.std, papers(&PaperRow::mean_mm),
              papers(&PaperRow::max_mm), papers(&PaperRow::std_mm), verdict, provenance.typical,
              provenance.max, end(&Table1Bands::mean_mm, &Band::low),
              end(&Table1Bands::mean_mm, &Band::high), end(&Table1Bands::std_mm, &Band::low),
              end(&Table1Bands::std_mm, &Band::high), end(&Table1Bands::max_mm, &Band::low),
              end(&Table1Bands::max_mm, &Band::high));
}

/// True if a row was played like the paper's table: by the built-in algorithm of that name, under
/// the built-in conditions.
bool is_papers_row(const experiment::Experiment& experiment, const metrics::Criteria& criteria,
                   std::string_view algorithm)
{
    const auto& all = experiment.algorithms;
    const auto named = std::ranges::find(all, algorithm, &experiment::NamedAlgorithm::name);
    return named != all.end() && is_built_in(*named) &&
           plays_as_shipped(experiment, criteria, "table1");
}

/// Adds a row with the values of the worst seed, but mean and std as their mean over the seeds.
void add_task_row(const Group& group, const Summary& summary, const metrics::Criteria& criteria,
                  const PartyCells& party, Table& table)
{
    const Judged judged = make_judged(summary, criteria);
    std::optional<double> std_mm, turned_deg, swings_n, low_m, high_m;
    if (summary.mean_m) {
        low_m = summary.mean_m->low;
        high_m = summary.mean_m->high;
    }
    if (summary.typical_m) std_mm = 1e3 * summary.typical_m->std;
    if (const auto& turned = summary.turned_apart_max_rad)
        turned_deg = *turned * (360.0 / base::two_pi);
    if (const auto& swings = summary.worst.force_above_2hz_added_n)
        swings_n = at_order(*swings, criteria.filter_order);
    table.add(
        group.algorithm, name_of(group.task), group.scores.size(), judged.mean_mm, std_mm,
        in_thousandths(summary.discrepancy_max_m), judged.vibration_mm, judged.stiffness_ratio,
        judged.force_vibration_n, summary.worst.force_discrepancy, summary.worst.contact_lost,
        summary.force_step_n, summary.worst.drag_n, in_thousandths(summary.worst.energy_taken_j),
        judged.tier, summary.limited_by, turned_deg, party.scene, swings_n, judged.stiffness_error,
        judged.slow_stiffness_error, in_thousandths(low_m), in_thousandths(high_m), summary.usable,
        in_thousands(summary.worst.rate_bit_per_s), party.subjects, party.trials);
}

/// Returns a comment of TOML that names the command which wrote the criteria.
std::string origin_of(const experiment::Experiment& experiment)
{
    std::vector<std::string_view> tasks;
    for (const device::Task task : experiment.tasks) tasks.push_back(name_of(task));
    return fmt::format("# Written by `scripts/calibrate.sh`: {}, {} seeds of {}, {}.\n",
                       experiment.algorithms.front().name, experiment.seeds, fmt::join(tasks, ", "),
                       name_of(experiment.hands));
}

struct ResultsOf {
    const experiment::Experiment& experiment;
    const metrics::Criteria& criteria;
    std::span<const experiment::JobResult> results;

    base::Result<Found> operator()(const experiment::Table1&) const
    {
        const auto groups = groups_of(experiment, results);
        const auto base_mm = base_in_mm(groups, criteria);
        Table table1{"table1",
                     columns_in("algorithm,mean_mm:3,min_mm:3,max_mm:3,std_mm:3,paper_mean_mm:3,"
                                "paper_max_mm:3,paper_std_mm:3,verdict,class,max_class,"
                                "mean_low_mm+,mean_high_mm+,std_low_mm+,std_high_mm+,max_low_mm+,"
                                "max_high_mm+")};
        Table tasks{"tasks",
                    columns_in("algorithm,task,seeds,mean_mm:3,std_mm:3,max_mm:3,vibration_mm:3,"
                               "stiffness_ratio:4,force_vibration_n:4,force_discrepancy:4,"
                               "contact_lost:4,force_step_n:4,drag_n:4,energy_mj:3,tier,"
                               "limited_by,turned_apart_deg:3?,scene?,force_above_2hz_n:4?,"
                               "stiffness_error:4?,slow_stiffness_error:4?,ci_low_mm:3?,ci_high_mm:"
                               "3?,usable_seeds,rate_kbit_s:1?,subjects?,trials?")};
        Found found;
        Table scenes = replay_scenes();
        for (const Group& group : groups) {
            const Summary summary = summarize(group.scores, criteria, group.subjects);
            if (group.task == device::Task::p1) {
                add_table1_row(group, summary, base_mm,
                               is_papers_row(experiment, criteria, group.algorithm), table1);
            } else {
                add_task_row(group, summary, criteria, party_cells(experiment, group.party), tasks);
            }
            const auto replay = fmt::format("{}-{}", group.algorithm, name_of(group.task));
            found.tables.push_back(from_kept_lines("replay/" + replay, group.rows));
            if (group.scene != scene::paper_scene())
                scenes.add(replay, group.scene.name, scene::to_text(group.scene));
        }
        if (!scenes.is_empty()) found.tables.push_back(std::move(scenes));
        const auto sessions = make_session_rows(experiment, criteria, results);
        found.tables.push_back(std::move(table1));
        found.tables.push_back(std::move(tasks));
        found.tables.push_back(table_of("sessions", sessions));
        found.tables.push_back(paired_table(sessions));
        return found;
    }

    base::Result<Found> operator()(const experiment::Limits& limits) const
    {
        Found found;
        found.tables = {limits_table(experiment, criteria, results),
                        paired_limits_table(experiment, criteria, results),
                        curves_table(experiment, criteria, results), sessions()};
        if (has_requirements(limits)) {
            found.tables.push_back(requirements_table(
                make_requirements(experiment, task_limits(experiment, criteria, results))));
            found.tables.push_back(network_classes_table());
        }
        if (limits.sensitivity && limits.sensitivity->seeds > 0) {
            found.tables.push_back(sensitivity_table(experiment, *limits.sensitivity, results));
        }
        return found;
    }

    base::Result<Found> operator()(const experiment::Trajectories&) const
    {
        // The quantities along x.
        constexpr std::array<std::pair<std::string_view, std::string_view>, 7> columns{
            {{"time_s", "time_s"},
             {"cube_l_mm", "lx"},
             {"cube_r_mm", "rx"},
             {"hand_l_mm", "lhx"},
             {"hand_r_mm", "rhx"},
             {"force_l_n", "lfx"},
             {"force_r_n", "rfx"}}};
        Table table{"trajectories", {{"algorithm"}}};
        for (const Group& group : groups_of(experiment, results)) {
            const Table replay = from_kept_lines("", group.rows);
            Table part{"", {{"algorithm"}}};
            for (const auto& [key, of_replay] : columns)
                part.columns.push_back(
                    {std::string{key}, replay.columns[*replay.place_of(of_replay)].decimals});
            for (const TableRow& row : rows_of(replay)) {
                auto& cells = part.rows.emplace_back();
                cells.push_back(to_cell(group.algorithm));
                for (const auto& [key, of_replay] : columns) cells.push_back(row[of_replay]);
            }
            append(table, part);
        }
        return Found{{std::move(table), sessions()}, {}};
    }

    base::Result<Found> operator()(const experiment::ImpairmentGrid& grid) const
    {
        const auto groups = groups_of(experiment, results);
        const auto points = grid_points(grid);
        const std::size_t groups_per_point = groups.size() / points.size();
        Table table{
            "qos", columns_in(fmt::format("algorithm,task,delay_ms,jitter_ms,loss_percent,{},{},"
                                          "{},limited_by+,subjects?,trials?",
                                          judged_columns, party_columns, stiffness_error_columns))};
        for (std::size_t i = 0; i < groups.size(); ++i) {
            const experiment::GridPoint& point = points[i / groups_per_point];
            const Summary summary = summarize(groups[i].scores, criteria, groups[i].subjects);
            const Judged judged = make_judged(summary, criteria);
            const auto party = party_cells(experiment, groups[i].party);
            table.add(groups[i].algorithm, name_of(groups[i].task), in_units(point.delay),
                      in_units(point.jitter), in_units(point.loss), judged.mean_mm,
                      judged.vibration_mm, judged.stiffness_ratio, judged.force_vibration_n,
                      judged.tier, judged.turned_apart_deg, party.peers, party.scene,
                      judged.stiffness_error, judged.slow_stiffness_error, summary.limited_by,
                      party.subjects, party.trials);
        }
        return Found{{std::move(table), sessions()}, {}};
    }

    base::Result<Found> operator()(const experiment::Claims&) const
    {
        const auto sessions = claim_sessions_of(experiment, results);
        auto tables = claim_tables(experiment, criteria, sessions);
        tables.push_back(claim_sessions_table(criteria, sessions));
        return Found{std::move(tables), {}};
    }

    base::Result<Found> operator()(const experiment::Calibration&) const
    {
        std::vector<metrics::Scores> scores;
        for (const experiment::JobResult& result : results) {
            const auto& session = std::get<experiment::SessionResult>(result);
            scores.push_back(scores_of(session.metrics, session.reference));
        }
        // The first half of the sessions belongs to the first of two conditions.
        const auto half = std::span{scores}.first(scores.size() / 2);
        const auto rest = std::span{scores}.subspan(half.size());
        return calibrated({half, rest}, criteria).map([this](const metrics::Criteria& found) {
            return Found{{sessions()},
                         {{"criteria.toml", origin_of(experiment) + print_criteria(found)}}};
        });
    }

private:
    [[nodiscard]] Table sessions() const
    {
        return table_of("sessions", make_session_rows(experiment, criteria, results));
    }
};

} // namespace

base::Result<Found> find_results(const experiment::Experiment& experiment,
                                 const metrics::Criteria& criteria,
                                 std::span<const experiment::JobResult> results)
{
    return std::visit(ResultsOf{experiment, criteria, results}, experiment.kind);
}

} // namespace hapnet::lab::results
