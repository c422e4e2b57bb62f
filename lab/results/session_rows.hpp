// SPDX-FileCopyrightText: 2026 The Hapnet authors
// SPDX-License-Identifier: MIT
#pragma once

#include "lab/experiment/jobs.hpp"
#include "lab/metrics/paired.hpp"
#include "lab/results/table.hpp"
#include "proto/base/csv.hpp"

#include <span>
#include <string>
#include <vector>

namespace hapnet::lab::results {

/// A row of sessions.csv: a session with all its conditions, and its outcome. Delay, jitter and
/// loss are each empty where their columns cannot describe them, or where the directions differ.
/// `network` has the whole profile.
struct SessionRow {
    std::string algorithm;
    std::string task;
    std::string hands;
    std::uint32_t peers = 2;
    std::string scene{};
    double duration_s = 0.0;
    std::optional<double> delay_ms{};
    std::optional<double> jitter_ms{};
    std::optional<double> loss_percent{};
    std::optional<double> burst_of_100{};
    std::string network{};
    std::uint64_t seed = 0;
    std::optional<double> mean_mm{};
    std::optional<double> std_mm{};
    std::optional<double> max_mm{};
    std::optional<double> vibration_mm{};
    std::optional<double> stiffness_ratio{};
    std::optional<double> force_vibration_n{}; // vibration of the force that the network adds
    std::optional<double> force_above_2hz_n{}; // force above 2 Hz that the network adds
    std::optional<double> force_discrepancy{};
    std::optional<double> contact_lost{};
    std::optional<double> force_step_n{};
    std::optional<double> drag_n{};
    std::optional<double> energy_mj{};
    double scored_share = 0.0;
    metrics::Tier tier{};
    std::optional<double> stiffness_error{};
    std::optional<double> slow_stiffness_error{};
    std::optional<double> rate_kbit_s{};
    std::optional<std::string> subject{}; // person whose recorded hands played
    std::optional<std::string> trial{};
};
constexpr auto fields_of(base::Tag<SessionRow>)
{
    using Row = SessionRow;
    constexpr base::Decimals three{3};
    constexpr base::Decimals four{4};
    constexpr base::Spare<base::Decimals> four_or_none{four};
    constexpr base::Spare<base::Text> text_or_none{};
    return base::fields(
        "sessions", base::field("algorithm", &Row::algorithm), base::field("task", &Row::task),
        base::field("hands", &Row::hands), base::field("peers", &Row::peers),
        base::field("scene", &Row::scene), base::field("duration_s", &Row::duration_s),
        base::field("delay_ms", &Row::delay_ms), base::field("jitter_ms", &Row::jitter_ms),
        base::field("loss_percent", &Row::loss_percent),
        base::field("burst_of_100", &Row::burst_of_100), base::field("network", &Row::network),
        base::field("seed", &Row::seed), base::field("mean_mm", &Row::mean_mm, three),
        base::field("std_mm", &Row::std_mm, three), base::field("max_mm", &Row::max_mm, three),
        base::field("vibration_mm", &Row::vibration_mm, three),
        base::field("stiffness_ratio", &Row::stiffness_ratio, four),
        base::field("force_vibration_n", &Row::force_vibration_n, four),
        base::field("force_above_2hz_n", &Row::force_above_2hz_n, four_or_none),
        base::field("force_discrepancy", &Row::force_discrepancy, four),
        base::field("contact_lost", &Row::contact_lost, four),
        base::field("force_step_n", &Row::force_step_n, four),
        base::field("drag_n", &Row::drag_n, four), base::field("energy_mj", &Row::energy_mj, three),
        base::field("scored_share", &Row::scored_share, four), base::field("tier", &Row::tier),
        base::field("stiffness_error", &Row::stiffness_error, four_or_none),
        base::field("slow_stiffness_error", &Row::slow_stiffness_error, four_or_none),
        base::field("rate_kbit_s", &Row::rate_kbit_s, base::Decimals{1}),
        base::field("subject", &Row::subject, text_or_none),
        base::field("trial", &Row::trial, text_or_none));
}

/// Returns the row of one session of an experiment, whichever program played it.
[[nodiscard]] SessionRow make_session_row(const experiment::Experiment& experiment,
                                          const experiment::SessionJob& job,
                                          const metrics::Scores& scores,
                                          const metrics::Criteria& criteria);

/// Returns every session of an experiment of any kind but Claims, which has its own rows. `results`
/// are those of all its jobs.
[[nodiscard]] std::vector<SessionRow>
make_session_rows(const experiment::Experiment& experiment, const metrics::Criteria& criteria,
                  std::span<const experiment::JobResult> results);

/// The columns of the table paired. `difference` is `algorithm` - `reference` of a measure, seed by
/// seed, or subject by subject, where the mean of all sessions of a subject counts once. For limits
/// it is the difference of p50, and is empty where one of the two was not reached. Otherwise it is
/// the median over the seeds.
inline constexpr std::string_view paired_columns =
    "algorithm,reference,task,measure,seeds,difference:4,ci_low:4,ci_high:4,sign_test_p";
/// Compares each algorithm with the first, in each task and condition that both played.
[[nodiscard]] Table paired_table(const std::vector<SessionRow>& sessions);

} // namespace hapnet::lab::results
