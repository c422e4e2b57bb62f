// SPDX-FileCopyrightText: 2026 The Hapnet authors
// SPDX-License-Identifier: MIT
#pragma once

#include "proto/base/result.hpp"
#include "proto/record/codec.hpp"

#include <nlohmann/json.hpp>
#include <string>
#include <string_view>

namespace hapnet::record {

/// Returns the first line of a record, without its line end. It is JSON that names the format,
/// describes every field of every row (type, offset, unit) and contains `config`, the configuration
/// of the peer that writes the record. The layout is of the newest version.
[[nodiscard]] std::string header_line(const nlohmann::json& config, const Layout& layout = {});

struct Header {
    nlohmann::json config;
    Layout layout;
};
/// Parses a header. Refuses another format and another layout.
[[nodiscard]] base::Result<Header> parse_header(std::string_view line);

} // namespace hapnet::record
