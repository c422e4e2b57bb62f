// SPDX-FileCopyrightText: 2026 The Hapnet authors
// SPDX-License-Identifier: MIT
#pragma once

#include "proto/base/result.hpp"
#include "proto/record/codec.hpp"

#include <nlohmann/json.hpp>
#include <string>
#include <string_view>

namespace hapnet::record {

/// The first line of a record, without its end of line: JSON that names the format, describes
/// every field of every row (type, offset, unit) and carries `config`, the configuration of the
/// peer that writes. The layout is of the newest version.
[[nodiscard]] std::string header_line(const nlohmann::json& config, const Layout& layout = {});

struct Header {
    nlohmann::json config;
    Layout layout;
};
/// Refuses a header of another format or layout.
[[nodiscard]] base::Result<Header> parse_header(std::string_view line);

} // namespace hapnet::record
