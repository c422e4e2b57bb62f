// SPDX-FileCopyrightText: 2026 The Hapnet authors
// SPDX-License-Identifier: MIT
#pragma once

#include "proto/page/figure.hpp"

#include <cstddef>
#include <span>
#include <string>
#include <vector>

namespace hapnet::page {

/// A stretch of values, and how many lie in it.
struct Bin {
    double low = 0.0;
    double high = 0.0;
    double count = 0.0;
};

/// The counts of ascending bins in bins that are all wide enough to be seen. Where a bin is
/// narrower than a 400th of the whole, each count is spread evenly over 200 bins of equal width.
/// Bins of relative width are that narrow near zero. Otherwise the bins stay as they are.
[[nodiscard]] std::vector<Bin> without_narrow(std::vector<Bin> bins);

/// The density of the values in ascending bins, as stairs: no bin is hidden in a slope.
[[nodiscard]] std::vector<Point> density_of(std::span<const Bin> bins);

/// The share of the values in ascending bins that are below the end of each bin.
[[nodiscard]] std::vector<Point> shares_below(std::span<const Bin> bins);

/// The share of the values that are at most as large as each of them, from a point at zero on; of
/// many values about `count_max`, the smallest and the largest among them.
[[nodiscard]] std::vector<Point> shares_at_most(std::vector<double> values, std::size_t count_max);

/// Shares of lateness in microseconds, and the budget that 99 % of the `things` are to keep. The
/// figure still lacks its title and its caption.
[[nodiscard]] Figure lateness_figure(std::string id, std::string_view things,
                                     std::vector<Curve> shares, double budget_us);

/// A curve for each stretch of finite values, all with the same name: nothing is drawn over a gap.
[[nodiscard]] std::vector<Curve> parts_of(const Curve& curve);

} // namespace hapnet::page
