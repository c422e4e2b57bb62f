// SPDX-FileCopyrightText: 2026 The Hapnet authors
// SPDX-License-Identifier: MIT
#pragma once

#include "lab/results/rows.hpp"

#include <optional>
#include <string_view>

namespace hapnet::lab::report {

// What counts as agreeing with the paper, for people to read beside a verdict. The verdicts
// themselves stand in the files.

/// From low to high, ends included.
struct Band {
    double low = 0.0;
    double high = 0.0;

    [[nodiscard]] bool holds(double value) const { return value >= low && value <= high; }
};

/// The bands of a row of Table 1; `base` is the row of base, which sep is held against.
struct Table1Bands {
    std::optional<Band> mean_mm{};
    std::optional<Band> std_mm{};
    std::optional<Band> max_mm{};
};
[[nodiscard]] Table1Bands table1_bands(const Table1Row& row, const Table1Row* base);

/// "130 to 155, less than base"; empty for what the paper does not know.
[[nodiscard]] std::string_view limit_band(std::string_view algorithm, std::string_view impairment);

} // namespace hapnet::lab::report
