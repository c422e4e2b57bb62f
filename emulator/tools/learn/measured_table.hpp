// SPDX-FileCopyrightText: 2026 The Hapnet authors
// SPDX-License-Identifier: MIT
#pragma once

#include "emulator/core/conditions.hpp"
#include "emulator/tools/learn/measurement.hpp"
#include "proto/base/result.hpp"
#include "proto/base/time.hpp"

#include <string>

namespace hapnet::emulator::tools {

/// A file with the delays and losses of one direction, as laws read it.
struct MeasuredTable {
    std::string file;      // name of the file in a profile
    std::string text;      // contents of the file
    std::string columns{}; // names of its columns; see parse_columns()
    base::Duration slot{}; // time from row to row, if the file lacks it; else 0
    bool is_timed = false; // its rows have times or slots
    bool has_losses = false;
};

/// Returns the series as a table: time_s where its spacing is known, and delay_ms, which is empty
/// for a lost datagram.
[[nodiscard]] std::string table_of(const MeasuredWay& way);

/// Returns the table that table_of() makes, with the name of its file.
[[nodiscard]] MeasuredTable named_table(std::string file, const MeasuredWay& way);

/// Returns conditions whose delays are drawn from the table: the delay `base` and a jitter, so that
/// their sum is distributed as measured. The error: the table cannot be read.
[[nodiscard]] base::Result<Conditions> drawn_from(const MeasuredTable& table, base::Duration base,
                                                  base::Duration correlation_time);

/// Returns conditions that replay the measured delays and losses in their order. The error says why
/// the table cannot be read.
[[nodiscard]] base::Result<Conditions> replayed(const MeasuredTable& table);

} // namespace hapnet::emulator::tools
