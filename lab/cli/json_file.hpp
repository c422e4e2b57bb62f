// SPDX-FileCopyrightText: 2026 The Hapnet authors
// SPDX-License-Identifier: MIT
#pragma once

#include "proto/base/result.hpp"

#include <nlohmann/json.hpp>
#include <string>

namespace hapnet::lab {

/// The object that a file holds. The error names the file.
[[nodiscard]] base::Result<nlohmann::ordered_json> read_json(const std::string& path);

} // namespace hapnet::lab
