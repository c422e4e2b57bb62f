// SPDX-FileCopyrightText: 2026 The Hapnet authors
// SPDX-License-Identifier: MIT
#pragma once

#include "proto/base/result.hpp"
#include "proto/record/rows.hpp"

#include <cstddef>
#include <nlohmann/json.hpp>
#include <string>
#include <vector>

namespace hapnet::record {

/// A whole record in memory. The rows of each kind are in the order in which they were written.
struct Record {
    nlohmann::json config;
    std::vector<TickRow> ticks;
    std::vector<MessageRow> messages;
    std::vector<SessionRow> sessions;
    /// Sorted by their ticks.
    std::vector<BodyRow> bodies{};
    /// For each of the `sessions`, the number of `ticks` that were written before it.
    std::vector<std::size_t> ticks_before_session;
    /// True if the file ends inside a row, because the writer was killed. All rows before it are
    /// complete.
    bool cut_off = false;
};

/// Reads a record. An error names the file and says what was expected in it.
[[nodiscard]] base::Result<Record> read(const std::string& path);

} // namespace hapnet::record
