// SPDX-FileCopyrightText: 2026 The Hapnet authors
// SPDX-License-Identifier: MIT
#pragma once

#include "emulator/core/conditions.hpp"
#include "emulator/tools/learn/measurement.hpp"
#include "proto/base/result.hpp"
#include "proto/base/time.hpp"

#include <string>

namespace hapnet::emulator::tools {

/// A file with the delays and losses of one way, as laws read it.
struct MeasuredTable {
    std::string file;      // name of the file in a profile
    std::string text;      // contents of the file
    std::string columns{}; // names of its columns; see parse_columns()
    base::Duration slot{}; // time from row to row, if the file lacks it; else 0
    bool is_timed = false; // its rows have times or slots
    bool has_losses = false;
};

/// The series as a table: time_s where its spacing is known, and delay_ms, empty for a lost one.
[[nodiscard]] std::string table_of(const MeasuredWay& way);

/// The table that table_of() makes, under a name.
[[nodiscard]] MeasuredTable named_table(std::string file, const MeasuredWay& way);

/// Delays drawn from the table: `base` and a jitter, so that the whole is as measured. The error:
/// the table cannot be read.
[[nodiscard]] base::Result<Conditions> drawn_from(const MeasuredTable& table, base::Duration base,
                                                  base::Duration correlation_time);

/// Returns conditions that replay the measured delays and losses in their order. The error says why
/// the table cannot be read.
[[nodiscard]] base::Result<Conditions> replayed(const MeasuredTable& table);

} // namespace hapnet::emulator::tools
