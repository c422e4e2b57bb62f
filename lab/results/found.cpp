// SPDX-FileCopyrightText: 2026 The Hapnet authors
// SPDX-License-Identifier: MIT
#include "lab/results/found.hpp"

#include "lab/experiment/grid.hpp"
#include "lab/metrics/calibration.hpp"
#include "lab/results/claim_rows.hpp"
#include "lab/results/limit_rows.hpp"
#include "lab/results/paper.hpp"
#include "lab/results/party_columns.hpp"
#include "lab/results/session_rows.hpp"
#include "lab/results/shipped.hpp"
#include "lab/results/summary.hpp"
#include "proto/base/math.hpp"

#include <algorithm>
#include <spdlog/fmt/fmt.h>

namespace hapnet::lab::results {

namespace {

/// What the sessions of one algorithm and task found, in the order of the seeds.
struct Group {
    std::string_view algorithm;
    device::Task task{};
    std::vector<metrics::Scores> scores{};
    std::string_view rows{}; // of the first seed
    experiment::Party party{};
};

/// The results of single sessions, by algorithm and task; each point of a grid begins anew.
std::vector<Group> groups_of(const experiment::Experiment& experiment,
                             std::span<const experiment::JobResult> results)
{
    const auto jobs = make_jobs(experiment);
    std::vector<Group> groups;
    for (std::size_t i = 0; i < jobs.size(); ++i) {
        const auto& job = std::get<experiment::SessionJob>(jobs[i]);
        const auto& result = std::get<experiment::SessionResult>(results[i]);
        if (job.spec.setting.seed.value() == experiment.first_seed) {
            groups.push_back(
                {experiment.algorithms[job.algorithm].name, job.task, {}, result.rows, job.party});
        }
        groups.back().scores.push_back(scores_of(result.metrics, result.perfect));
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
        const auto typical = summarize(group.scores, criteria).typical_m;
        if (typical) return in_mm(*typical);
    }
    return std::nullopt;
}

std::optional<double> in_thousandths(std::optional<double> value)
{
    return value ? std::optional{1e3 * *value} : std::nullopt;
}

/// `is_papers`: it was played as the paper's table is.
Table1Row table1_row(const Group& group, const Summary& summary,
                     const std::optional<metrics::Spread>& base_mm, bool is_papers)
{
    const metrics::Spread mm = in_mm(summary.typical_m.value_or(metrics::Spread{}));
    Table1Row row{.algorithm = std::string{group.algorithm},
                  .mean_mm = mm.mean,
                  .min_mm = mm.min,
                  .max_mm = mm.max,
                  .std_mm = mm.std};
    const auto paper = paper_table1(group.algorithm);
    if (!paper || !is_papers) return row;
    row.paper_mean_mm = paper->mean_mm;
    row.paper_max_mm = paper->max_mm;
    row.paper_std_mm = paper->std_mm;
    row.verdict = summary.typical_m ? table1_verdict(group.algorithm, mm, base_mm) : Claim::missed;
    const Table1Provenance provenance = table1_provenance(group.algorithm);
    row.provenance = provenance.typical;
    row.max_provenance = provenance.max;
    return row;
}

/// As in the paper's table: the built-in algorithm of that name, under the built-in conditions.
bool is_papers_row(const experiment::Experiment& experiment, const metrics::Criteria& criteria,
                   std::string_view algorithm)
{
    const auto& all = experiment.algorithms;
    const auto named = std::ranges::find(all, algorithm, &experiment::NamedAlgorithm::name);
    return named != all.end() && is_built_in(*named) &&
           plays_as_shipped(experiment, criteria, "table1");
}

TaskRow task_row(const Group& group, const Summary& summary, const metrics::Criteria& criteria)
{
    const Judged judged = make_judged(summary, criteria);
    TaskRow row{.algorithm = std::string{group.algorithm},
                .task = std::string{name_of(group.task)},
                .seeds = static_cast<std::uint32_t>(group.scores.size()),
                .mean_mm = judged.mean_mm,
                .max_mm = in_thousandths(summary.discrepancy_max_m),
                .vibration_mm = judged.vibration_mm,
                .stiffness_ratio = judged.stiffness_ratio,
                .force_vibration_n = judged.force_vibration_n,
                .force_discrepancy = summary.worst.force_discrepancy,
                .contact_lost = summary.worst.contact_lost,
                .force_step_n = summary.force_step_n,
                .drag_n = summary.worst.drag_n,
                .energy_mj = in_thousandths(summary.worst.energy_taken_j),
                .tier = judged.tier,
                .limited_by = summary.limited_by};
    if (const auto& swings = summary.worst.force_above_2hz_added_n)
        row.force_above_2hz_n = at_order(*swings, criteria.filter_order);
    if (summary.typical_m) row.std_mm = 1e3 * summary.typical_m->std;
    if (summary.turned_apart_max_rad)
        row.turned_apart_deg = *summary.turned_apart_max_rad * (360.0 / base::two_pi);
    return row;
}

/// The rows that a session kept: CSV without a header.
std::vector<ReplayRow> parse_rows(std::string_view rows)
{
    auto parsed = base::read_csv<ReplayRow>(
        fmt::format("{}\n{}", base::csv_header<ReplayRow>(), rows), "rows of a session");
    return parsed ? *std::move(parsed) : std::vector<ReplayRow>{};
}

/// Which command wrote the criteria.
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
        std::vector<Table1Row> table;
        std::vector<TaskRow> tasks;
        Found found;
        for (const Group& group : groups) {
            const Summary summary = summarize(group.scores, criteria);
            if (group.task == device::Task::p1) {
                table.push_back(table1_row(group, summary, base_mm,
                                           is_papers_row(experiment, criteria, group.algorithm)));
            } else {
                tasks.push_back(task_row(group, summary, criteria));
                if (group.party.scene)
                    tasks.back().scene = experiment.scenes[*group.party.scene].name;
            }
            found.tables.push_back(
                table_of(fmt::format("replay/{}-{}", group.algorithm, name_of(group.task)),
                         parse_rows(group.rows)));
        }
        found.tables.push_back(table_of("table1", table));
        found.tables.push_back(table_of("tasks", tasks));
        const auto sessions = make_session_rows(experiment, criteria, results);
        found.tables.push_back(table_of("sessions", sessions));
        found.tables.push_back(table_of("paired", make_paired_rows(sessions)));
        return found;
    }

    base::Result<Found> operator()(const experiment::Limits& limits) const
    {
        Found found;
        found.tables = {table_of("limits", make_limit_rows(experiment, criteria, results)),
                        table_of("paired", make_paired_limit_rows(experiment, results)),
                        table_of("curves", make_curve_rows(experiment, criteria, results)),
                        sessions()};
        if (limits.sensitivity && limits.sensitivity->seeds > 0) {
            found.tables.push_back(
                table_of("limits_by_convention",
                         make_sensitivity_rows(experiment, *limits.sensitivity, results)));
        }
        return found;
    }

    base::Result<Found> operator()(const experiment::Trajectories&) const
    {
        std::vector<TrajectoryRow> rows;
        for (const Group& group : groups_of(experiment, results)) {
            for (const ReplayRow& row : parse_rows(group.rows)) {
                rows.push_back(to_trajectory(std::string{group.algorithm}, row));
            }
        }
        return Found{{table_of("trajectories", rows), sessions()}, {}};
    }

    base::Result<Found> operator()(const experiment::ImpairmentGrid& grid) const
    {
        const auto groups = groups_of(experiment, results);
        const auto points = grid_points(grid);
        const std::size_t groups_per_point = groups.size() / points.size();
        std::vector<QosRow> rows;
        for (std::size_t i = 0; i < groups.size(); ++i) {
            const experiment::GridPoint& point = points[i / groups_per_point];
            QosRow& row = rows.emplace_back(
                QosRow{.algorithm = std::string{groups[i].algorithm},
                       .task = std::string{name_of(groups[i].task)},
                       .delay_ms = in_units(point.delay),
                       .jitter_ms = in_units(point.jitter),
                       .loss_percent = in_units(point.loss),
                       .judged = make_judged(summarize(groups[i].scores, criteria), criteria)});
            note_party(experiment, groups[i].party, row);
        }
        return Found{{table_of("qos", rows), sessions()}, {}};
    }

    base::Result<Found> operator()(const experiment::Claims&) const
    {
        const auto sessions = claim_sessions_of(experiment, results);
        const ClaimTables tables = make_claim_tables(experiment, criteria, sessions);
        return Found{{table_of("claims", tables.claims),
                      table_of("claims_quantiles", tables.quantiles),
                      table_of("sessions", make_claim_session_rows(criteria, sessions))},
                     {}};
    }

    base::Result<Found> operator()(const experiment::Calibration&) const
    {
        std::vector<metrics::Scores> scores;
        for (const experiment::JobResult& result : results) {
            const auto& session = std::get<experiment::SessionResult>(result);
            scores.push_back(scores_of(session.metrics, session.perfect));
        }
        const auto half = std::span{scores}.first(scores.size() / 2); // the first of two conditions
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
