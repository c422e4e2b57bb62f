// SPDX-FileCopyrightText: 2026 The Hapnet authors
// SPDX-License-Identifier: MIT
#pragma once

#include "lab/experiment/experiment.hpp"
#include "proto/base/result.hpp"

#include <functional>

namespace hapnet::lab::experiment {

/// The last level that passed before the first that failed.
struct Limit {
    ImpairmentLevel level{}; // 0 also when nothing passed
    bool ever_failed = true;

    friend bool operator==(const Limit&, const Limit&) = default;
};

/// Whether a task can be done at a level; an error ends the search.
using Passes = std::function<base::Result<bool>(ImpairmentLevel)>;

/// Scans upward from `from` in steps to the first level that fails, then halves the gap below it
/// until it is no more than the resolution. What passes again beyond is not looked for. When
/// `from` itself fails, the scan begins at 0.
[[nodiscard]] base::Result<Limit> find_limit(const SearchRange& range, const Passes& passes);

} // namespace hapnet::lab::experiment
