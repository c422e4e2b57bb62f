// SPDX-FileCopyrightText: 2026 The Hapnet authors
// SPDX-License-Identifier: MIT
#include "lab/results/result_files.hpp"

#include "lab/experiment/plane.hpp"
#include "lab/metrics/calibration.hpp"
#include "lab/results/cells.hpp"
#include "lab/results/limits_csv.hpp"
#include "lab/results/paper.hpp"
#include "lab/results/replay_rows.hpp"
#include "lab/results/summary.hpp"

#include <algorithm>
#include <spdlog/fmt/fmt.h>

namespace hapnet::lab {

namespace {

/// What the sessions of one algorithm and task found, in the order of the seeds.
struct Group {
    std::string_view algorithm;
    device::Task task{};
    std::vector<Scores> scores{};
    std::string_view rows{}; // of the first seed
};

/// The findings of single sessions, by algorithm and task; each plane cell begins anew.
std::vector<Group> groups_of(const Experiment& experiment, std::span<const Finding> findings)
{
    const auto parts = parts_of(experiment);
    std::vector<Group> groups;
    for (std::size_t i = 0; i < parts.size(); ++i) {
        const auto& part = std::get<SessionPart>(parts[i]);
        const auto& finding = std::get<SessionFinding>(findings[i]);
        if (part.spec.setting.seed.value() == experiment.first_seed) {
            groups.push_back(
                {experiment.algorithms[part.algorithm].name, part.task, {}, finding.rows});
        }
        groups.back().scores.push_back(scores_of(finding.metrics, finding.perfect));
    }
    return groups;
}

Spread in_mm(const Spread& metres)
{
    return {1e3 * metres.mean, 1e3 * metres.min, 1e3 * metres.max, 1e3 * metres.std};
}

std::optional<Spread> base_in_mm(const std::vector<Group>& groups, const Criteria& criteria)
{
    for (const Group& group : groups) {
        if (group.algorithm != "base" || group.task != device::Task::p1) continue;
        const auto typical = summary_of(group.scores, criteria).typical_m;
        if (typical) return in_mm(*typical);
    }
    return std::nullopt;
}

std::string table1_row(const Group& group, const Summary& summary,
                       const std::optional<Spread>& base_mm)
{
    const auto paper = paper_table1(group.algorithm);
    const auto mm = [](std::optional<double> value) {
        return value ? fmt::format("{:.3f}", *value) : std::string{};
    };
    const auto typical = summary.typical_m.value_or(Spread{});
    const auto verdict =
        summary.typical_m ? table1_verdict(group.algorithm, in_mm(typical), base_mm) : "missed";
    return fmt::format("{},{},{},{},{},{},{},{},{}\n", group.algorithm, milli_cell(typical.mean),
                       milli_cell(typical.min), milli_cell(typical.max), milli_cell(typical.std),
                       mm(paper ? std::optional{paper->mean_mm} : std::nullopt),
                       mm(paper ? std::optional{paper->max_mm} : std::nullopt),
                       mm(paper ? std::optional{paper->std_mm} : std::nullopt), verdict);
}

std::string task_row(const Group& group, const Summary& summary, const Criteria& criteria)
{
    const auto typical = summary.typical_m;
    return fmt::format(
        "{},{},{},{},{},{},{},{},{},{},{},{},{},{},{},{}\n", group.algorithm, name_of(group.task),
        group.scores.size(), milli_cell(typical ? std::optional{typical->mean} : std::nullopt),
        milli_cell(typical ? std::optional{typical->std} : std::nullopt),
        milli_cell(summary.discrepancy_max_m), milli_cell(vibration_m(summary, criteria)),
        number_cell(summary.worst.stiffness_ratio[judged_press]),
        number_cell(force_vibration_n(summary, criteria)),
        number_cell(summary.worst.force_discrepancy), number_cell(summary.worst.contact_lost),
        number_cell(summary.force_step_n), number_cell(summary.worst.drag_n),
        milli_cell(summary.worst.energy_taken_j), to_text(summary.tier),
        text_cell(summary.limited_by));
}

/// Which command wrote the criteria.
std::string origin_of(const Experiment& experiment)
{
    std::vector<std::string_view> tasks;
    for (const device::Task task : experiment.tasks) tasks.push_back(name_of(task));
    return fmt::format("# Written by `hapnet-lab run calibration`: {}, {} seeds of {}, {}.\n",
                       experiment.algorithms.front().name, experiment.seeds, fmt::join(tasks, ", "),
                       name_of(experiment.hands));
}

struct ResultsOf {
    const Experiment& experiment;
    const Criteria& criteria;
    std::span<const Finding> findings;

    base::Result<std::vector<ResultText>> operator()(const Table1&) const
    {
        const auto groups = groups_of(experiment, findings);
        const auto base_mm = base_in_mm(groups, criteria);
        std::string table = "algorithm,mean_mm,min_mm,max_mm,std_mm,paper_mean_mm,paper_max_mm,"
                            "paper_std_mm,verdict\n";
        std::string tasks = "algorithm,task,seeds,mean_mm,std_mm,max_mm,vibration_mm,"
                            "stiffness_ratio,force_vibration_n,force_discrepancy,contact_lost,"
                            "force_step_n,drag_n,energy_mj,tier,limited_by\n";
        std::vector<ResultText> files;
        for (const Group& group : groups) {
            const Summary summary = summary_of(group.scores, criteria);
            if (group.task == device::Task::p1) {
                table += table1_row(group, summary, base_mm);
            } else {
                tasks += task_row(group, summary, criteria);
            }
            files.push_back({fmt::format("replay/{}-{}.csv", group.algorithm, name_of(group.task)),
                             fmt::format("{}\n{}", replay_header, group.rows)});
        }
        files.push_back({"table1.csv", std::move(table)});
        files.push_back({"tasks.csv", std::move(tasks)});
        return files;
    }

    base::Result<std::vector<ResultText>> operator()(const Limits& limits) const
    {
        std::vector<ResultText> files;
        files.push_back({"limits.csv", limits_csv(experiment, findings)});
        files.push_back({"curves.csv", curves_csv(experiment, criteria, findings)});
        if (limits.convention) {
            files.push_back({"limits_by_convention.csv",
                             convention_csv(experiment, *limits.convention, findings)});
        }
        return files;
    }

    base::Result<std::vector<ResultText>> operator()(const Trajectories&) const
    {
        std::string out = std::string{trajectory_header} + '\n';
        for (const Group& group : groups_of(experiment, findings)) {
            out += trajectory_rows(group.rows, group.algorithm);
        }
        return std::vector<ResultText>{{"trajectories.csv", std::move(out)}};
    }

    base::Result<std::vector<ResultText>> operator()(const Plane& plane) const
    {
        const auto groups = groups_of(experiment, findings);
        const auto cells = cells_of(plane);
        const std::size_t groups_per_cell = groups.size() / cells.size();
        std::string out = "algorithm,task,delay_ms,jitter_ms,loss_percent,mean_mm,vibration_mm,"
                          "stiffness_ratio,force_vibration_n,tier\n";
        for (std::size_t i = 0; i < groups.size(); ++i) {
            const PlaneCell& cell = cells[i / groups_per_cell];
            const Summary summary = summary_of(groups[i].scores, criteria);
            const auto typical = summary.typical_m;
            out += fmt::format(
                "{},{},{},{},{},{},{},{},{},{}\n", groups[i].algorithm, name_of(groups[i].task),
                to_text(cell.delay), to_text(cell.jitter), to_text(cell.loss),
                milli_cell(typical ? std::optional{typical->mean} : std::nullopt),
                milli_cell(vibration_m(summary, criteria)),
                number_cell(summary.worst.stiffness_ratio[judged_press]),
                number_cell(force_vibration_n(summary, criteria)), to_text(summary.tier));
        }
        return std::vector<ResultText>{{"qos.csv", std::move(out)}};
    }

    base::Result<std::vector<ResultText>> operator()(const Calibration&) const
    {
        std::vector<Scores> scores;
        for (const Finding& finding : findings) {
            const auto& session = std::get<SessionFinding>(finding);
            scores.push_back(scores_of(session.metrics, session.perfect));
        }
        const auto half = std::span{scores}.first(scores.size() / 2); // the first of two conditions
        const auto rest = std::span{scores}.subspan(half.size());
        return calibrated({half, rest}, criteria).map([this](const Criteria& found) {
            return std::vector<ResultText>{
                {"criteria.toml", origin_of(experiment) + print_criteria(found)}};
        });
    }
};

} // namespace

base::Result<std::vector<ResultText>> results_of(const Experiment& experiment,
                                                 const Criteria& criteria,
                                                 std::span<const Finding> findings)
{
    return std::visit(ResultsOf{experiment, criteria, findings}, experiment.kind);
}

} // namespace hapnet::lab
