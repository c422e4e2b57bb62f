// SPDX-FileCopyrightText: 2026 The Hapnet authors
// SPDX-License-Identifier: MIT
#pragma once

#include "lab/results/table.hpp"

#include <string>

namespace hapnet::lab::results {

/// The cell under `conditions` in a row over all of them.
inline constexpr const char* all_conditions = "all";

/// The sessions of a folder.
struct SessionsTable {
    const Table& table; // the table sessions, or sessions_by_axis
    std::string path;   // path of the table's file, for error messages
};

/// The table compared: measures of the sessions that two folders have in common. It pairs the
/// sessions of two tables that are equal in every column except the measures. `conditions` is what
/// else differs among the sessions, "delay_ms=40"; conditions together have a row all_conditions
/// where there are several. `difference` is the median of B - A, with its 95 % interval. The error:
/// a table has no sessions, or they have no session in common.
[[nodiscard]] base::Result<Table> compare_sessions(const SessionsTable& a, const SessionsTable& b);

} // namespace hapnet::lab::results
