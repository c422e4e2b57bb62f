// SPDX-FileCopyrightText: 2026 The Hapnet authors
// SPDX-License-Identifier: MIT
#pragma once

#include "lab/experiment/claims.hpp"
#include "lab/metrics/scores.hpp"
#include "lab/results/rows.hpp"

#include <cstdint>
#include <optional>
#include <span>
#include <string>
#include <vector>

namespace hapnet::lab::results {

/// How a claim was judged; undecided: a number that it is about was not measured.
enum class ClaimVerdict : std::uint8_t { met, missed, undecided };
constexpr auto names_of(base::Tag<ClaimVerdict>)
{
    return base::names("met", "missed", "undecided");
}

/// Of claims.csv: a claim, of the first of the algorithms. It is met when all its numbers are, for
/// the seeds that judge.
struct ClaimRow {
    std::string claim;
    std::string value;  // its numbers: of the worst seed, or of their mean where the claim says so
    std::string accept; // what they have to keep
    ClaimVerdict verdict{};
};
constexpr auto fields_of(base::Tag<ClaimRow>)
{
    using Row = ClaimRow;
    return base::fields("claims", base::field("claim", &Row::claim),
                        base::field("value", &Row::value), base::field("accept", &Row::accept),
                        base::field("verdict", &Row::verdict));
}

/// Of claims_quantiles.csv: the numbers of the same claim in all seeds, which do not judge.
struct ClaimQuantileRow {
    std::string claim;
    std::string quantile; // that which 9 of 10 seeds keep, or the mean
    std::uint32_t seeds = 0;
};
constexpr auto fields_of(base::Tag<ClaimQuantileRow>)
{
    using Row = ClaimQuantileRow;
    return base::fields("claims' quantiles", base::field("claim", &Row::claim),
                        base::field("quantile", &Row::quantile), base::field("seeds", &Row::seeds));
}

/// Of sessions.csv: a session of a claim's conditions.
struct ClaimSessionRow {
    std::string algorithm;
    std::string condition;
    std::string task;
    std::string hands;
    std::uint32_t peers = 2;
    double delay_ms = 0.0;
    double jitter_ms = 0.0;
    double loss_percent = 0.0;
    double burst_of_100 = 0.0;
    std::uint32_t seed = 0;
    std::optional<double> mean_mm{};
    std::optional<double> max_mm{};
    std::optional<double> vibration_mm{};
    std::optional<double> stiffness_ratio{};
    std::optional<double> force_vibration_n{}; // added by the network
    std::optional<double> force_above_2hz_n{}; // likewise
    std::optional<double> force_discrepancy{};
    std::optional<double> contact_lost{};
    std::optional<double> energy_mj{};
    double scored_share = 0.0; // of the time that both would run on a perfect network
    metrics::Tier tier{};
};
constexpr auto fields_of(base::Tag<ClaimSessionRow>)
{
    using Row = ClaimSessionRow;
    return base::fields(
        "claim sessions", base::field("algorithm", &Row::algorithm),
        base::field("condition", &Row::condition), base::field("task", &Row::task),
        base::field("hands", &Row::hands), base::field("peers", &Row::peers),
        base::field("delay_ms", &Row::delay_ms), base::field("jitter_ms", &Row::jitter_ms),
        base::field("loss_percent", &Row::loss_percent),
        base::field("burst_of_100", &Row::burst_of_100), base::field("seed", &Row::seed),
        base::field("mean_mm", &Row::mean_mm, base::Decimals{3}),
        base::field("max_mm", &Row::max_mm, base::Decimals{3}),
        base::field("vibration_mm", &Row::vibration_mm, base::Decimals{3}),
        base::field("stiffness_ratio", &Row::stiffness_ratio, base::Decimals{4}),
        base::field("force_vibration_n", &Row::force_vibration_n, base::Decimals{4}),
        base::field("force_above_2hz_n", &Row::force_above_2hz_n,
                    base::Spare<base::Decimals>{base::Decimals{4}}),
        base::field("force_discrepancy", &Row::force_discrepancy, base::Decimals{4}),
        base::field("contact_lost", &Row::contact_lost, base::Decimals{4}),
        base::field("energy_mj", &Row::energy_mj, base::Decimals{4}),
        base::field("scored_share", &Row::scored_share, base::Decimals{4}),
        base::field("tier", &Row::tier));
}

/// A session of a claim's conditions, and what came of it.
struct ClaimSession {
    const experiment::ClaimCell* cell = nullptr;
    std::string algorithm;
    device::Task task{};
    std::uint32_t seed = 0;
    metrics::Scores scores{};
};

struct ClaimSessions {
    std::vector<ClaimSession> sessions; // in the order of the jobs
    std::vector<double> silence_m;      // how far apart, of the first algorithm
};

[[nodiscard]] ClaimSessions claim_sessions_of(const experiment::Experiment& experiment,
                                              std::span<const experiment::JobResult> results);

/// One row for each claim, in both.
struct ClaimTables {
    std::vector<ClaimRow> claims;
    std::vector<ClaimQuantileRow> quantiles;
};
[[nodiscard]] ClaimTables make_claim_tables(const experiment::Experiment& experiment,
                                            const metrics::Criteria& criteria,
                                            const ClaimSessions& sessions);

[[nodiscard]] std::vector<ClaimSessionRow>
make_claim_session_rows(const metrics::Criteria& criteria, const ClaimSessions& sessions);

} // namespace hapnet::lab::results
