// SPDX-FileCopyrightText: 2026 The Hapnet authors
// SPDX-License-Identifier: MIT
#pragma once

#include "lab/results/rows.hpp"
#include "lab/results/table.hpp"

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

namespace hapnet::lab::results {

/// The conditions of a row over all of them.
inline constexpr const char* all_conditions = "all";

/// A measure of the sessions that two folders of results have in common, seed by seed.
struct ComparedRow {
    std::string algorithm;
    std::string task;
    std::string
        conditions;      // what else differs among the sessions: "delay_ms=40"; or all_conditions
    std::string measure; // with its unit
    std::uint32_t sessions = 0;
    double median_a = 0.0;
    double median_b = 0.0;
    double difference = 0.0; // median of b - a
    double ci_low = 0.0;     // 95 %
    double ci_high = 0.0;
    double sign_test_p = 1.0;
};
constexpr auto fields_of(base::Tag<ComparedRow>)
{
    using Row = ComparedRow;
    constexpr base::Decimals four{4};
    return base::fields(
        "compared", base::field("algorithm", &Row::algorithm), base::field("task", &Row::task),
        base::field("conditions", &Row::conditions), base::field("measure", &Row::measure),
        base::field("sessions", &Row::sessions), base::field("median_a", &Row::median_a, four),
        base::field("median_b", &Row::median_b, four),
        base::field("difference", &Row::difference, four),
        base::field("ci_low", &Row::ci_low, four), base::field("ci_high", &Row::ci_high, four),
        base::field("sign_test_p", &Row::sign_test_p));
}

/// The sessions of a folder.
struct SessionsTable {
    const Table& table; // sessions, or sessions_by_axis
    std::string path;   // of its file, for errors
};

/// Pairs the sessions of two tables that are alike in every column but those that a session is
/// measured by. Conditions together have a row "all" where there are several. The error: a table
/// has no sessions, or they have no session in common.
[[nodiscard]] base::Result<std::vector<ComparedRow>> compare_sessions(const SessionsTable& a,
                                                                      const SessionsTable& b);

} // namespace hapnet::lab::results
