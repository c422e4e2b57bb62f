// SPDX-FileCopyrightText: 2026 The Hapnet authors
// SPDX-License-Identifier: MIT
#pragma once

#include "peer/core/sync/algorithm.hpp"
#include "proto/base/reading.hpp"

#include <optional>
#include <string>
#include <string_view>

namespace hapnet::peer {

// Algorithms as TOML: `algorithm = "dead-reckoning"` and the keys of its parameters. What is left
// out has its named default.

/// Reads the table at `node`; nullopt when a complaint was made.
[[nodiscard]] std::optional<Algorithm> read_algorithm(const base::Node& node,
                                                      base::Reading& reading);

/// A name ("base", "sep", "dead-reckoning") with all defaults, or a TOML file.
[[nodiscard]] base::Result<Algorithm> load_algorithm(const std::string& name_or_file,
                                                     const base::OpenFile& open);

/// TOML that reads back as the same algorithm; of every parameter, also the defaults.
[[nodiscard]] std::string print_algorithm(const Algorithm& algorithm);

/// "base", "sep", "dead-reckoning"
[[nodiscard]] std::string_view name_of(const Algorithm& algorithm);

} // namespace hapnet::peer
