// SPDX-FileCopyrightText: 2026 The Hapnet authors
// SPDX-License-Identifier: MIT
#pragma once

#include "lab/results/table.hpp"
#include "scene/description.hpp"

#include <array>
#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace hapnet::lab::report {

// The rows of the files of a result folder, as docs/use/experiments.md defines their columns. Names
// end with the unit. What a task does not exercise is nullopt.

/// How a result stands to what the paper says.
enum class Claim : std::uint8_t { none, calibrated, met, missed };

/// What two simulated people can do under some condition.
enum class Rating : std::uint8_t { unusable, usable, good };

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
};

/// By what a session is judged.
struct Judged {
    std::optional<double> mean_mm{};
    std::optional<double> vibration_mm{};
    std::optional<double> stiffness_ratio{};
    std::optional<double> force_vibration_n{};
    Rating tier{};
};

struct TaskRow {
    std::string algorithm;
    std::string task;
    double seeds = 0.0;
    Judged judged{};
    std::optional<double> std_mm{};
    std::optional<double> max_mm{};
    std::optional<double> force_discrepancy{};
    std::optional<double> contact_lost{};
    std::optional<double> force_step_n{};
    std::optional<double> drag_n{};
    std::optional<double> energy_mj{};
    std::string limited_by;
};

struct LimitRow {
    std::string algorithm;
    std::string impairment;
    std::string task; // or "worst"
    double limit = 0.0;
    bool is_open = false; // never failed within the range
    std::string unit;
    std::optional<double> paper_limit{};
    Claim status{};
};

/// A limit by another convention.
struct ConventionRow {
    std::string algorithm;
    std::string impairment;
    std::string task;
    double filter_order = 0.0;
    std::string hand;
    double limit = 0.0;
    bool is_open = false;
    std::string unit;
};

/// A session that a search played.
struct CurveRow {
    std::string algorithm;
    std::string impairment;
    std::string task;
    double level = 0.0;
    std::string unit;
    Judged judged{};
};

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

struct QosRow {
    std::string algorithm;
    std::string task;
    double delay_ms = 0.0;
    double jitter_ms = 0.0;
    double loss_percent = 0.0;
    Judged judged{};
};

struct RealTimeRow {
    std::string algorithm;
    std::string where;
    std::optional<double> mean_mm{};
    std::optional<double> std_mm{};
    std::optional<double> max_mm{};
    std::optional<double> virtual_mean_mm{};
    std::optional<double> virtual_std_mm{};
    std::optional<double> virtual_max_mm{};
    bool is_valid = false;
    std::string invalid_because;
};

/// The columns of a replay after its time, in their order.
inline constexpr std::array<std::string_view, 14> replay_columns{
    "lx", "ly", "lz", "lhx", "lhy", "lhz", "lfx", "rx", "ry", "rz", "rhx", "rhy", "rhz", "rfx"};

/// What both sides did, in equal steps of time.
struct Replay {
    std::string algorithm;
    std::string task;
    double start_s = 0.0;
    double step_s = 0.01;
    std::array<std::vector<double>, replay_columns.size()> columns{}; // equally long
    scene::Description scene = scene::paper_scene();                  // in which it was played
};

[[nodiscard]] base::Result<std::vector<Table1Row>> read_table1(const File& file);
[[nodiscard]] base::Result<std::vector<TaskRow>> read_tasks(const File& file);
[[nodiscard]] base::Result<std::vector<LimitRow>> read_limits(const File& file);
[[nodiscard]] base::Result<std::vector<ConventionRow>> read_conventions(const File& file);
[[nodiscard]] base::Result<std::vector<CurveRow>> read_curves(const File& file);
/// The times of each algorithm increase.
[[nodiscard]] base::Result<std::vector<TrajectoryRow>> read_trajectories(const File& file);
[[nodiscard]] base::Result<std::vector<QosRow>> read_qos(const File& file);
[[nodiscard]] base::Result<std::vector<RealTimeRow>> read_real_time(const File& file);
/// Algorithm and task stand in the file's name.
[[nodiscard]] base::Result<Replay> read_replay(const File& file);

} // namespace hapnet::lab::report
