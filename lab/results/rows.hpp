// SPDX-FileCopyrightText: 2026 The Hapnet authors
// SPDX-License-Identifier: MIT
#pragma once

#include "lab/metrics/verdict.hpp"
#include "lab/results/file.hpp"
#include "lab/virtual_time/trace.hpp"
#include "proto/base/csv.hpp"
#include "scene/description.hpp"

#include <cstddef>
#include <cstdint>
#include <glm/vec3.hpp>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

namespace hapnet::lab::results {

// The rows of the files of a result folder: docs/use/experiments.md says what each column means.
// Names end with the unit. What a task does not exercise is nullopt. Each struct is written and
// read by the description of its fields: base::csv_text() and base::read_csv().

/// How many played, and where: columns of a table in which that is not two in the task's own scene.
inline constexpr base::Spare<base::Count> peers_column{};
inline constexpr base::Spare<base::Text> scene_column{};

/// How a result stands to what the paper says; undecided: its interval lies across the edge of what
/// would agree.
enum class Claim : std::uint8_t { none, calibrated, met, missed, undecided };
constexpr auto names_of(base::Tag<Claim>)
{
    return base::names("", "calibrated", "met", "missed", "undecided");
}

/// How a number that stands beside one of the paper's came about.
enum class Provenance : std::uint8_t {
    none,            // the paper has nothing that it stands beside
    calibrated,      // fitted to it
    selected,        // follows from a reading chosen among several with a look at it
    by_construction, // another number again
    predicted,       // it had no part in it
};
constexpr auto names_of(base::Tag<Provenance>)
{
    return base::names("", "calibrated", "selected", "by-construction", "predicted");
}

/// Of a limit: both at once.
enum class LimitStatus : std::uint8_t {
    none,
    calibrated,
    calibrated_missed,
    selected_met,
    selected_missed,
    by_construction_met,
    by_construction_missed,
    predicted_met,
    predicted_missed,
    undecided,
};
constexpr auto names_of(base::Tag<LimitStatus>)
{
    return base::names("", "calibrated", "calibrated-missed", "selected-met", "selected-missed",
                       "by-construction-met", "by-construction-missed", "predicted-met",
                       "predicted-missed", "undecided");
}
[[nodiscard]] constexpr Claim to_claim(LimitStatus status)
{
    switch (status) {
    case LimitStatus::none: break;
    case LimitStatus::calibrated: return Claim::calibrated;
    case LimitStatus::selected_met:
    case LimitStatus::by_construction_met:
    case LimitStatus::predicted_met: return Claim::met;
    case LimitStatus::calibrated_missed:
    case LimitStatus::selected_missed:
    case LimitStatus::by_construction_missed:
    case LimitStatus::predicted_missed: return Claim::missed;
    case LimitStatus::undecided: return Claim::undecided;
    }
    return Claim::none;
}

/// Whether a limit was found, or nothing failed as far as was tried.
enum class Bound : std::uint8_t { found, open };
constexpr auto names_of(base::Tag<Bound>) { return base::names("=", ">"); }

inline constexpr base::Decimals thousandths{3};
inline constexpr base::Decimals ten_thousandths{4};
inline constexpr base::Decimals level_cell{2}; // of a limit, in the impairment's unit

/// Of table1.csv.
struct Table1Row {
    std::string algorithm;
    double mean_mm = 0.0;
    double min_mm = 0.0;
    double max_mm = 0.0;
    double std_mm = 0.0;
    std::optional<double> paper_mean_mm{};
    std::optional<double> paper_max_mm{};
    std::optional<double> paper_std_mm{};
    Claim verdict{};
    Provenance provenance{};     // of mean and standard deviation
    Provenance max_provenance{}; // of the maximum
};
constexpr auto fields_of(base::Tag<Table1Row>)
{
    using Row = Table1Row;
    return base::fields("table1", base::field("algorithm", &Row::algorithm),
                        base::field("mean_mm", &Row::mean_mm, thousandths),
                        base::field("min_mm", &Row::min_mm, thousandths),
                        base::field("max_mm", &Row::max_mm, thousandths),
                        base::field("std_mm", &Row::std_mm, thousandths),
                        base::field("paper_mean_mm", &Row::paper_mean_mm, thousandths),
                        base::field("paper_max_mm", &Row::paper_max_mm, thousandths),
                        base::field("paper_std_mm", &Row::paper_std_mm, thousandths),
                        base::field("verdict", &Row::verdict),
                        base::field("class", &Row::provenance),
                        base::field("max_class", &Row::max_provenance));
}

/// Of tasks.csv: the worst of the seeds, mean and std as their mean.
struct TaskRow {
    std::string algorithm;
    std::string task;
    std::uint32_t seeds = 0;
    std::optional<double> mean_mm{};
    std::optional<double> std_mm{};
    std::optional<double> max_mm{};
    std::optional<double> vibration_mm{};
    std::optional<double> stiffness_ratio{};
    std::optional<double> force_vibration_n{};
    std::optional<double> force_discrepancy{};
    std::optional<double> contact_lost{};
    std::optional<double> force_step_n{};
    std::optional<double> drag_n{};
    std::optional<double> energy_mj{};
    metrics::Tier tier{};
    std::string limited_by;
    std::optional<double> turned_apart_deg{}; // the largest; where the body turns
    std::optional<std::string> scene{};
    std::optional<double> force_above_2hz_n{}; // that the network adds
};
constexpr auto fields_of(base::Tag<TaskRow>)
{
    using Row = TaskRow;
    return base::fields(
        "tasks", base::field("algorithm", &Row::algorithm), base::field("task", &Row::task),
        base::field("seeds", &Row::seeds), base::field("mean_mm", &Row::mean_mm, thousandths),
        base::field("std_mm", &Row::std_mm, thousandths),
        base::field("max_mm", &Row::max_mm, thousandths),
        base::field("vibration_mm", &Row::vibration_mm, thousandths),
        base::field("stiffness_ratio", &Row::stiffness_ratio, ten_thousandths),
        base::field("force_vibration_n", &Row::force_vibration_n, ten_thousandths),
        base::field("force_discrepancy", &Row::force_discrepancy, ten_thousandths),
        base::field("contact_lost", &Row::contact_lost, ten_thousandths),
        base::field("force_step_n", &Row::force_step_n, ten_thousandths),
        base::field("drag_n", &Row::drag_n, ten_thousandths),
        base::field("energy_mj", &Row::energy_mj, thousandths), base::field("tier", &Row::tier),
        base::field("limited_by", &Row::limited_by),
        base::field("turned_apart_deg", &Row::turned_apart_deg,
                    base::Spare<base::Decimals>{thousandths}),
        base::field("scene", &Row::scene, scene_column),
        base::field("force_above_2hz_n", &Row::force_above_2hz_n,
                    base::Spare<base::Decimals>{ten_thousandths}));
}

/// In limits.csv, where the limit of the worst of the tasks stands.
inline constexpr std::string_view worst_task = "worst";

/// Of limits.csv: `limit` is p50, the level at which half of the seeds fail.
struct LimitRow {
    std::string algorithm;
    std::string impairment;
    std::string task; // or "worst"
    double limit = 0.0;
    Bound bound{};
    std::string unit;
    std::optional<double> paper_limit{};
    LimitStatus status{};
    Provenance provenance{};
    double p50 = 0.0;
    std::optional<double> p10{};
    std::optional<double> ci_low{};  // of p50, 95 %
    std::optional<double> ci_high{}; // nullopt: above the range
    std::uint32_t seeds = 0;
    std::optional<std::uint32_t> peers{};
    std::optional<std::string> scene{};

    [[nodiscard]] bool is_open() const { return bound == Bound::open; }
};
constexpr auto fields_of(base::Tag<LimitRow>)
{
    using Row = LimitRow;
    return base::fields(
        "limits", base::field("algorithm", &Row::algorithm),
        base::field("impairment", &Row::impairment), base::field("task", &Row::task),
        base::field("limit", &Row::limit, level_cell), base::field("bound", &Row::bound),
        base::field("unit", &Row::unit), base::field("paper_limit", &Row::paper_limit),
        base::field("status", &Row::status), base::field("class", &Row::provenance),
        base::field("p50", &Row::p50, level_cell), base::field("p10", &Row::p10, level_cell),
        base::field("ci_low", &Row::ci_low, level_cell),
        base::field("ci_high", &Row::ci_high, level_cell), base::field("seeds", &Row::seeds),
        base::field("peers", &Row::peers, peers_column),
        base::field("scene", &Row::scene, scene_column));
}

/// Of limits_by_axis.csv: the limits at one value of a parameter.
struct AxisLimitRow {
    std::string parameter; // "both.delay"
    std::string value;
    LimitRow limit{};
};
constexpr auto fields_of(base::Tag<AxisLimitRow>)
{
    return base::fields("limits by axis", base::field("parameter", &AxisLimitRow::parameter),
                        base::field("value", &AxisLimitRow::value),
                        base::part(&AxisLimitRow::limit));
}

/// Of limits_by_convention.csv: how sensitive a limit is to the filter and to the hands.
struct SensitivityRow {
    std::string algorithm;
    std::string impairment;
    std::string task;
    std::uint32_t filter_order = 0;
    std::string hand;
    double limit = 0.0;
    Bound bound{};
    std::string unit;
    std::optional<double> ci_low{};
    std::optional<double> ci_high{};
    std::uint32_t seeds = 0;
    std::optional<std::uint32_t> peers{};
    std::optional<std::string> scene{};

    [[nodiscard]] bool is_open() const { return bound == Bound::open; }
};
constexpr auto fields_of(base::Tag<SensitivityRow>)
{
    using Row = SensitivityRow;
    return base::fields(
        "limits by convention", base::field("algorithm", &Row::algorithm),
        base::field("impairment", &Row::impairment), base::field("task", &Row::task),
        base::field("filter_order", &Row::filter_order), base::field("hand", &Row::hand),
        base::field("limit", &Row::limit, level_cell), base::field("bound", &Row::bound),
        base::field("unit", &Row::unit), base::field("ci_low", &Row::ci_low, level_cell),
        base::field("ci_high", &Row::ci_high, level_cell), base::field("seeds", &Row::seeds),
        base::field("peers", &Row::peers, peers_column),
        base::field("scene", &Row::scene, scene_column));
}

/// By what a session is judged.
struct Judged {
    std::optional<double> mean_mm{};
    std::optional<double> vibration_mm{};
    std::optional<double> stiffness_ratio{};
    std::optional<double> force_vibration_n{};
    metrics::Tier tier{};
    std::optional<double> turned_apart_deg{}; // mean of the worst seed; where a body turns
};
constexpr auto fields_of(base::Tag<Judged>)
{
    return base::fields(
        "judged", base::field("mean_mm", &Judged::mean_mm, thousandths),
        base::field("vibration_mm", &Judged::vibration_mm, thousandths),
        base::field("stiffness_ratio", &Judged::stiffness_ratio, ten_thousandths),
        base::field("force_vibration_n", &Judged::force_vibration_n, ten_thousandths),
        base::field("tier", &Judged::tier),
        base::field("turned_apart_deg", &Judged::turned_apart_deg,
                    base::Spare<base::Decimals>{thousandths}));
}

/// Of curves.csv: a session that a search played.
struct CurveRow {
    std::string algorithm;
    std::string impairment;
    std::string task;
    double level = 0.0;
    std::string unit;
    std::uint32_t seed = 0;
    bool counts = true; // false: of the coarse scan alone
    Judged judged{};
    std::optional<std::uint32_t> peers{};
    std::optional<std::string> scene{};
};
constexpr auto fields_of(base::Tag<CurveRow>)
{
    using Row = CurveRow;
    return base::fields("curves", base::field("algorithm", &Row::algorithm),
                        base::field("impairment", &Row::impairment),
                        base::field("task", &Row::task), base::field("level", &Row::level),
                        base::field("unit", &Row::unit), base::field("seed", &Row::seed),
                        base::field("counts", &Row::counts), base::part(&Row::judged),
                        base::field("peers", &Row::peers, peers_column),
                        base::field("scene", &Row::scene, scene_column));
}

/// Of qos.csv: a point of the grid of delay, jitter and loss.
struct QosRow {
    std::string algorithm;
    std::string task;
    double delay_ms = 0.0;
    double jitter_ms = 0.0;
    double loss_percent = 0.0;
    Judged judged{};
    std::optional<std::uint32_t> peers{};
    std::optional<std::string> scene{};
};
constexpr auto fields_of(base::Tag<QosRow>)
{
    using Row = QosRow;
    return base::fields("qos", base::field("algorithm", &Row::algorithm),
                        base::field("task", &Row::task), base::field("delay_ms", &Row::delay_ms),
                        base::field("jitter_ms", &Row::jitter_ms),
                        base::field("loss_percent", &Row::loss_percent), base::part(&Row::judged),
                        base::field("peers", &Row::peers, peers_column),
                        base::field("scene", &Row::scene, scene_column));
}

/// Of qos_by_point.csv: a cell at a point of several parameters. Their columns are passed over.
struct PointQosRow {
    std::uint32_t point = 0;
    QosRow cell{};
};
constexpr auto fields_of(base::Tag<PointQosRow>)
{
    return base::fields("qos by point", base::field("point", &PointQosRow::point),
                        base::part(&PointQosRow::cell));
}

/// Of trajectories.csv: Fig. 7.
struct TrajectoryRow {
    std::string algorithm;
    double time_s = 0.0;
    double cube_l_mm = 0.0;
    double cube_r_mm = 0.0;
    double hand_l_mm = 0.0;
    double hand_r_mm = 0.0;
    double force_l_n = 0.0;
    double force_r_n = 0.0;
};
constexpr auto fields_of(base::Tag<TrajectoryRow>)
{
    using Row = TrajectoryRow;
    return base::fields("trajectories", base::field("algorithm", &Row::algorithm),
                        base::field("time_s", &Row::time_s, ten_thousandths),
                        base::field("cube_l_mm", &Row::cube_l_mm, thousandths),
                        base::field("cube_r_mm", &Row::cube_r_mm, thousandths),
                        base::field("hand_l_mm", &Row::hand_l_mm, thousandths),
                        base::field("hand_r_mm", &Row::hand_r_mm, thousandths),
                        base::field("force_l_n", &Row::force_l_n, ten_thousandths),
                        base::field("force_r_n", &Row::force_r_n, ten_thousandths));
}

/// Of real_time.csv: a session of the programs beside the same in virtual time.
struct RealTimeRow {
    std::string algorithm;
    std::string where;
    std::optional<double> mean_mm{};
    std::optional<double> std_mm{};
    std::optional<double> max_mm{};
    std::optional<double> virtual_mean_mm{};
    std::optional<double> virtual_std_mm{};
    std::optional<double> virtual_max_mm{};
    std::optional<double> difference_percent{};
    bool is_valid = false;
    std::string invalid_because;
};
constexpr auto fields_of(base::Tag<RealTimeRow>)
{
    using Row = RealTimeRow;
    return base::fields(
        "real time", base::field("algorithm", &Row::algorithm), base::field("where", &Row::where),
        base::field("mean_mm", &Row::mean_mm, ten_thousandths),
        base::field("std_mm", &Row::std_mm, ten_thousandths),
        base::field("max_mm", &Row::max_mm, ten_thousandths),
        base::field("virtual_mean_mm", &Row::virtual_mean_mm, ten_thousandths),
        base::field("virtual_std_mm", &Row::virtual_std_mm, ten_thousandths),
        base::field("virtual_max_mm", &Row::virtual_max_mm, ten_thousandths),
        base::field("difference_percent", &Row::difference_percent, base::Decimals{2}),
        base::field("valid", &Row::is_valid),
        base::field("invalid_because", &Row::invalid_because));
}

/// Of replay/ALGORITHM-TASK.csv: of each side, L and R, the places of the cube and of the hand in
/// mm and the force on the hand along x in N.
struct ReplayRow {
    double time_s = 0.0;
    double lx = 0.0, ly = 0.0, lz = 0.0, lhx = 0.0, lhy = 0.0, lhz = 0.0, lfx = 0.0;
    double rx = 0.0, ry = 0.0, rz = 0.0, rhx = 0.0, rhy = 0.0, rhz = 0.0, rfx = 0.0;
};
constexpr auto fields_of(base::Tag<ReplayRow>)
{
    using Row = ReplayRow;
    return base::fields(
        "replay", base::field("time_s", &Row::time_s, ten_thousandths),
        base::field("lx", &Row::lx, thousandths), base::field("ly", &Row::ly, thousandths),
        base::field("lz", &Row::lz, thousandths), base::field("lhx", &Row::lhx, thousandths),
        base::field("lhy", &Row::lhy, thousandths), base::field("lhz", &Row::lhz, thousandths),
        base::field("lfx", &Row::lfx, ten_thousandths), base::field("rx", &Row::rx, thousandths),
        base::field("ry", &Row::ry, thousandths), base::field("rz", &Row::rz, thousandths),
        base::field("rhx", &Row::rhx, thousandths), base::field("rhy", &Row::rhy, thousandths),
        base::field("rhz", &Row::rhz, thousandths), base::field("rfx", &Row::rfx, ten_thousandths));
}

/// Samples of a trace as rows, `rows_per_s` a second or all when there are fewer.
[[nodiscard]] std::vector<ReplayRow> make_replay_rows(const virtual_time::Trace& trace,
                                                      std::uint32_t rows_per_s);

/// The rows as CSV without a header.
[[nodiscard]] std::string to_lines(const std::vector<ReplayRow>& rows);

/// What lies along x.
[[nodiscard]] TrajectoryRow to_trajectory(const std::string& algorithm, const ReplayRow& row);

/// One of those who played, with its copy of what is shared, in equal steps of time.
struct ReplaySide {
    std::string name; // "L", or "peer 3"
    bool is_left = true;
    std::vector<glm::dvec3> hand_mm{};
    std::vector<glm::dvec3> force_n{}; // on the hand
    /// Of each shared body the steps.
    std::vector<std::vector<virtual_time::Pose>> bodies{};
};

/// What all sides did, in equal steps of time.
struct Replay {
    std::string algorithm;
    std::string task;
    double start_s = 0.0;
    double step_s = 0.01;
    std::vector<ReplaySide> sides{};                 // two or more, of at least two steps
    scene::Description scene = scene::paper_scene(); // in which it was played
    std::vector<std::size_t> shared{};               // which of its bodies; they stand there

    [[nodiscard]] std::size_t steps() const { return sides.front().hand_mm.size(); }
};

/// The number of the first movable body.
[[nodiscard]] std::size_t first_movable(const scene::Description& scene);

/// Every so many ticks of a trace; `names` are those of its sides.
[[nodiscard]] std::vector<ReplaySide> replay_sides(const virtual_time::Trace& trace,
                                                   std::span<const std::string> names,
                                                   std::size_t every);

/// The error: the times of an algorithm do not increase.
[[nodiscard]] base::Result<void> require_increasing(const std::vector<TrajectoryRow>& rows);
/// Of the table replay/ALGORITHM-TASK.
[[nodiscard]] base::Result<Replay> replay_of(std::string_view name,
                                             const std::vector<ReplayRow>& rows);

} // namespace hapnet::lab::results
