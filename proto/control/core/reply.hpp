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

// The replies that are the same for every program. Each is a JSON object on one line, without a
// newline.

/// Returns JSON on one line. Bytes that are not UTF-8 are replaced, so that every text can be
/// printed.
[[nodiscard]] std::string line_of(const nlohmann::ordered_json& json);

/// Returns {"ok":false,"error":"..."}. A text that is too long to be read is cut.
[[nodiscard]] std::string refusal(std::string_view error);

/// Returns the refusal of a client beyond the limit: {"ok":false,"busy":true,"error":"..."}.
[[nodiscard]] std::string busy_refusal();

/// Returns the reply to stats, which is also each line of a watch.
[[nodiscard]] std::string statistics_reply(const nlohmann::ordered_json& statistics);

/// Returns the reply to wait. It contains the time that the statistics give.
[[nodiscard]] std::string wait_reply(const base::Condition& until, bool is_met,
                                     const nlohmann::ordered_json& statistics);

/// Returns the reply to keep: the path of the file, or the reason why there is no file.
[[nodiscard]] std::string keep_reply(const base::Result<std::string>& file, base::TimePoint from,
                                     base::TimePoint to);

} // namespace hapnet::control
