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

/// A whole record in memory; the rows of each kind in the order in which they were written.
struct Record {
    nlohmann::json config;
    std::vector<TickRow> ticks;
    std::vector<MessageRow> messages;
    std::vector<SessionRow> sessions;
    /// Ascending in their ticks.
    std::vector<BodyRow> bodies{};
    /// The number of `ticks` that were written before each of the `sessions`.
    std::vector<std::size_t> ticks_before_session;
    /// The file ends inside a row: the writer was killed. Nothing before that row is harmed.
    bool cut_off = false;
};

/// Reads a record; an error names the file and what was expected in it.
[[nodiscard]] base::Result<Record> read(const std::string& path);

} // namespace hapnet::record
