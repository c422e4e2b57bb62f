// SPDX-FileCopyrightText: 2026 The Hapnet authors
// SPDX-License-Identifier: MIT
#pragma once

#include "proto/base/result.hpp"

#include <nlohmann/json.hpp>
#include <string>
#include <string_view>

namespace hapnet::record {

/// The first line of a record, without its end of line: JSON that names the format, describes
/// every field of every row (type, offset, unit) and carries `config`, the configuration of the
/// peer that writes.
[[nodiscard]] std::string header_line(const nlohmann::json& config);

/// The `config` of a header line; refuses a header of another format or layout.
[[nodiscard]] base::Result<nlohmann::json> parse_header(std::string_view line);

} // namespace hapnet::record
