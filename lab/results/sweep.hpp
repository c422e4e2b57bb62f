// SPDX-FileCopyrightText: 2026 The Hapnet authors
// SPDX-License-Identifier: MIT
#pragma once

#include "lab/experiment/jobs.hpp"
#include "lab/metrics/criteria.hpp"
#include "lab/results/session_rows.hpp"
#include "lab/results/table.hpp"
#include "proto/base/result.hpp"

#include <cstdint>
#include <nlohmann/json.hpp>
#include <optional>
#include <span>
#include <string>
#include <vector>

namespace hapnet::lab::results {

// An experiment that the daemons have played, with the same sessions in virtual time.

/// The outcome of a session that was played once.
struct PlayedCell {
    metrics::Metrics real{};
    metrics::Metrics simulated{}; // in virtual time, with the ticks of the daemons
    metrics::Metrics perfect{};   // in virtual time on a perfect network: the reference for scores
    std::uint64_t missed_ticks = 0;
    double longest_gap_ms = 0.0; // longest time between two ticks of a peer
    std::vector<std::string> invalid_because{};

    [[nodiscard]] bool valid() const { return invalid_because.empty(); }
};
[[nodiscard]] nlohmann::ordered_json to_json(const PlayedCell& played);
/// Reads an object. The error names the key that is missing or has another type.
[[nodiscard]] base::Result<PlayedCell> played_cell_from(const nlohmann::json& json);

/// A row of the table real_time_sessions: one attempt at a session.
struct SweepRow {
    std::string point; // point of the axes, such as "hands.stiffness=100N/m"
    SessionRow real{};
    SessionRow simulated{};
    std::uint32_t attempt = 1;
    std::uint64_t missed_ticks = 0;
    double longest_gap_ms = 0.0;
    bool is_valid = false;
    std::string invalid_because{};
};

/// The session of an experiment that a cell of the sweep plays.
struct SweepCell {
    const experiment::Experiment& experiment;
    const experiment::SessionJob& job;
    std::string point{};
};
[[nodiscard]] SweepRow make_sweep_row(const SweepCell& cell, const PlayedCell& played,
                                      const metrics::Criteria& criteria);

/// Returns the table real_time_sessions.
[[nodiscard]] Table sweep_table(std::span<const SweepRow> rows);

/// A row of the table real_time_conditions: a measure of all valid sessions of one condition.
struct ConditionRow {
    std::string point;
    std::string algorithm;
    std::string task;
    std::string hands;
    std::uint32_t peers = 2;
    std::string scene{};
    double duration_s = 0.0;
    std::string network{};
    std::string measure{};
    std::uint32_t sessions = 0; // number of valid sessions
    std::uint32_t left_out = 0; // number of seeds played without a valid session
    std::optional<double> real{};
    std::optional<double> simulated{};
    std::optional<double> difference_percent{};
    std::optional<double> ci_low_percent{}; // 95 % interval, by resampling the seeds
    std::optional<double> ci_high_percent{};
};
constexpr auto fields_of(base::Tag<ConditionRow>)
{
    using Row = ConditionRow;
    constexpr base::Decimals two{2};
    constexpr base::Decimals four{4};
    return base::fields(
        "conditions", base::field("point", &Row::point), base::field("algorithm", &Row::algorithm),
        base::field("task", &Row::task), base::field("hands", &Row::hands),
        base::field("peers", &Row::peers), base::field("scene", &Row::scene),
        base::field("duration_s", &Row::duration_s), base::field("network", &Row::network),
        base::field("measure", &Row::measure), base::field("sessions", &Row::sessions),
        base::field("left_out", &Row::left_out), base::field("real", &Row::real, four),
        base::field("virtual", &Row::simulated, four),
        base::field("difference_percent", &Row::difference_percent, two),
        base::field("ci_low_percent", &Row::ci_low_percent, two),
        base::field("ci_high_percent", &Row::ci_high_percent, two));
}
[[nodiscard]] std::vector<ConditionRow> make_condition_rows(std::span<const SweepRow> rows);
/// Returns the rows as lines of text for a person.
[[nodiscard]] std::string conditions_table(std::span<const ConditionRow> rows);

} // namespace hapnet::lab::results
