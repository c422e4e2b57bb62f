// SPDX-FileCopyrightText: 2026 The Hapnet authors
// SPDX-License-Identifier: MIT
#pragma once

#include "lab/cli/options.hpp"
#include "lab/results/compared_rows.hpp"
#include "proto/base/describe.hpp"
#include "proto/base/result.hpp"
#include "proto/base/value_kind.hpp"

#include <string>
#include <vector>

namespace hapnet::lab {

/// What `compare --json` prints.
struct Comparison {
    std::vector<results::ComparedRow> compared;
};
constexpr auto fields_of(base::Tag<Comparison>)
{
    return base::fields("comparison",
                        base::member("compared", &Comparison::compared,
                                     "A row for each measure of each algorithm and task, under "
                                     "each condition and under all."));
}

/// What two folders of results differ in, as a table, CSV or JSON. The error: one has no sessions,
/// or files that its B2SUMS does not match; or they have no sessions in common.
[[nodiscard]] base::Result<std::string> compare_folders(const CompareCommand& command);

} // namespace hapnet::lab
