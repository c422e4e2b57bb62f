// SPDX-FileCopyrightText: 2026 The Hapnet authors
// SPDX-License-Identifier: MIT
#pragma once

#include "peer/core/sync/algorithm.hpp"
#include "proto/base/reading.hpp"

#include <optional>
#include <string>
#include <string_view>

namespace hapnet::peer {

// Algorithms as TOML: `algorithm = "dead-reckoning"` and the keys of its parameters. A missing
// parameter has its named default. docs/design/algorithms.md lists them.

/// Reads the table at `node`, or the name of an algorithm or of a file of one; nullopt when a
/// complaint was made.
[[nodiscard]] std::optional<Algorithm> read_algorithm(const base::Node& node,
                                                      base::Reading& reading);

/// Reads a whole text. `source` names it in errors, which begin with "FILE:LINE:COLUMN: " and say
/// what is wrong and what would be right.
[[nodiscard]] base::Result<Algorithm> parse_algorithm(std::string_view text,
                                                      const std::string& source);

/// Returns the algorithm of that name ("base", "sep", "dead-reckoning") with all defaults, or that
/// of a file whose text `open` gives. A name that ends in ".so" is a shared object, and is not
/// loaded here.
[[nodiscard]] base::Result<Algorithm> load_algorithm(const std::string& file_or_name,
                                                     const base::OpenFile& open);

/// TOML that reads back as the same algorithm; of every parameter, also the defaults.
[[nodiscard]] std::string print_algorithm(const Algorithm& algorithm);

/// The algorithm's text with a few words about every parameter, for a person who wants to change
/// it.
[[nodiscard]] std::string explain_algorithm(const Algorithm& algorithm);

} // namespace hapnet::peer
