// SPDX-FileCopyrightText: 2026 The Hapnet authors
// SPDX-License-Identifier: MIT
#pragma once

#include "proto/page/figure.hpp"

#include <cstddef>
#include <span>
#include <string>
#include <vector>

namespace hapnet::page {

/// A range of values, with the number of values in it.
struct Bin {
    double low = 0.0;
    double high = 0.0;
    double count = 0.0;
};

/// Returns ascending bins that are all wide enough to be seen. If a bin is narrower than a 400th of
/// the whole range, the counts are spread evenly over 200 bins of equal width. Bins of relative
/// width are that narrow near zero. Otherwise the bins are unchanged.
[[nodiscard]] std::vector<Bin> without_narrow(std::vector<Bin> bins);

/// Returns the density of the values in ascending bins as a step curve, so that each bin is
/// visible.
[[nodiscard]] std::vector<Point> density_of(std::span<const Bin> bins);

/// Returns, for the end of each of the ascending bins, the share of the values below it.
[[nodiscard]] std::vector<Point> shares_below(std::span<const Bin> bins);

/// Returns, for each value, the share of the values that are not larger. The curve begins with a
/// point at zero. Of many values, about `count_max` are used, including the smallest and the
/// largest.
[[nodiscard]] std::vector<Point> shares_at_most(std::vector<double> values, std::size_t count_max);

/// Returns a figure of shares over lateness in microseconds, with the budget that 99 % of the
/// `things` must meet. The caller adds the title and the caption.
[[nodiscard]] Figure lateness_figure(std::string id, std::string_view things,
                                     std::vector<Curve> shares, double budget_us);

/// Returns one curve for each range of finite values, all with the same name, so that gaps stay
/// empty.
[[nodiscard]] std::vector<Curve> parts_of(const Curve& curve);

} // namespace hapnet::page
