// SPDX-FileCopyrightText: 2026 The Hapnet authors
// SPDX-License-Identifier: MIT
#pragma once

#include "peer/core/sync/algorithm.hpp"
#include "proto/base/reading.hpp"

#include <optional>
#include <string>
#include <string_view>

namespace hapnet::peer {

// Algorithms as TOML: `algorithm = "dead-reckoning"` and the keys of its parameters. Missing
// parameters have the defaults that docs/design/algorithms.md lists.

/// Reads an algorithm from `node`: a table, the name of an algorithm, or the name of its file.
/// Returns nullopt after a complaint.
[[nodiscard]] std::optional<Algorithm> read_algorithm(const base::Node& node,
                                                      base::Reading& reading);

/// Parses a whole text. `source` names it in errors, which begin with "FILE:LINE:COLUMN: " and say
/// what is wrong and what would be right.
[[nodiscard]] base::Result<Algorithm> parse_algorithm(std::string_view text,
                                                      const std::string& source);

/// Returns the algorithm with that name ("base", "sep", "dead-reckoning") and all defaults, or the
/// one in a file whose content `open` returns. A name that ends in ".so" is a shared object, which
/// this function does not load.
[[nodiscard]] base::Result<Algorithm> load_algorithm(const std::string& file_or_name,
                                                     const base::OpenFile& open);

/// Returns TOML that reads back as the same algorithm. It contains every parameter, including the
/// defaults.
[[nodiscard]] std::string print_algorithm(const Algorithm& algorithm);

/// Returns the algorithm's text with a short description of each parameter, for a person who wants
/// to change it.
[[nodiscard]] std::string explain_algorithm(const Algorithm& algorithm);

} // namespace hapnet::peer
