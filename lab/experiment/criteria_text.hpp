// SPDX-FileCopyrightText: 2026 The Hapnet authors
// SPDX-License-Identifier: MIT
#pragma once

#include "lab/metrics/criteria.hpp"
#include "proto/base/reading.hpp"

#include <span>
#include <string>
#include <string_view>

namespace hapnet::lab::experiment {

/// Criteria that are built into every program: a file of scripts/criteria.
struct BuiltInCriteria {
    std::string_view name; // file name without .toml
    std::string_view text;
};

/// All built-in criteria, by name.
[[nodiscard]] std::span<const BuiltInCriteria> built_in_criteria();

/// Reads the built-in criteria of that name, or else the file whose text `open` returns. "paper"
/// are the criteria that were calibrated on the paper's two numbers.
[[nodiscard]] base::Result<metrics::Criteria> load_criteria(const std::string& file_or_name,
                                                            const base::OpenFile& open);

} // namespace hapnet::lab::experiment
