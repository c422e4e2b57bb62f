// SPDX-FileCopyrightText: 2026 The Hapnet authors
// SPDX-License-Identifier: MIT
#pragma once

#include "lab/results/table.hpp"

#include <string>

namespace hapnet::lab::results {

/// The cell under `conditions` in a row about all conditions.
inline constexpr const char* all_conditions = "all";

/// The sessions of a folder.
struct SessionsTable {
    const Table& table; // the table sessions, or sessions_by_axis
    std::string path;   // path of the table's file, for error messages
};

/// Returns the table compared: measures of the sessions that two folders have in common. Sessions
/// of the two tables are pairs if they are equal in every column except the measures. `conditions`
/// holds the other columns in which the sessions differ, such as "delay_ms=40". Where there are
/// several conditions, one row, all_conditions, covers them together. `difference` is the median of
/// B - A, with its 95 % interval. Fails when a table has no sessions, or when the two have no
/// session in common.
[[nodiscard]] base::Result<Table> compare_sessions(const SessionsTable& a, const SessionsTable& b);

} // namespace hapnet::lab::results
