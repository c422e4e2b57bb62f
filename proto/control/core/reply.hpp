// SPDX-FileCopyrightText: 2026 The Hapnet authors
// SPDX-License-Identifier: MIT
#pragma once

#include "proto/base/condition.hpp"
#include "proto/base/result.hpp"
#include "proto/base/time.hpp"

#include <nlohmann/json.hpp>
#include <string>
#include <string_view>

namespace hapnet::control {

// The lines that answer requests, each a JSON object without a newline, as far as they are the
// same for every program.

/// Returns JSON on one line. Bytes that are not UTF-8 are replaced, so that every text can be
/// printed.
[[nodiscard]] std::string line_of(const nlohmann::ordered_json& json);

/// {"ok":false,"error":"..."}; what is too long to be read is cut.
[[nodiscard]] std::string refusal(std::string_view error);

/// The refusal of a client beyond the limit: {"ok":false,"busy":true,"error":"..."}.
[[nodiscard]] std::string busy_refusal();

/// The answer to stats, and each line of a watch.
[[nodiscard]] std::string statistics_reply(const nlohmann::ordered_json& statistics);

/// The answer to wait; says when it is by the statistics.
[[nodiscard]] std::string wait_reply(const base::Condition& until, bool is_met,
                                     const nlohmann::ordered_json& statistics);

/// The answer to keep: the path of the file, or why there is none.
[[nodiscard]] std::string keep_reply(const base::Result<std::string>& file, base::TimePoint from,
                                     base::TimePoint to);

} // namespace hapnet::control
