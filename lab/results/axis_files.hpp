// SPDX-FileCopyrightText: 2026 The Hapnet authors
// SPDX-License-Identifier: MIT
#pragma once

#include "lab/results/file.hpp"

#include <span>
#include <string>
#include <string_view>
#include <vector>

namespace hapnet::lab::results {

/// What an experiment found at one value of its axis.
struct AxisFiles {
    std::string value;
    std::vector<File> files;
};

/// The tables of all values, each in one file NAME_by_axis.csv, with the columns `parameter` and
/// `value` before the others. Replays and what is no table are left out.
[[nodiscard]] std::vector<File> joined_by_axis(std::string_view parameter,
                                               std::span<const AxisFiles> points);

} // namespace hapnet::lab::results
