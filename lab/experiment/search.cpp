// SPDX-FileCopyrightText: 2026 The Hapnet authors
// SPDX-License-Identifier: MIT
#include "lab/experiment/search.hpp"

#include <algorithm>
#include <optional>

namespace hapnet::lab::experiment {

namespace {

/// What a scan ended with: the last level that passed, if any, and the first that failed, if any.
struct Scan {
    std::optional<ImpairmentLevel> passed{};
    std::optional<ImpairmentLevel> failed{};
};

ImpairmentLevel above(ImpairmentLevel level, const SearchRange& range)
{
    return {std::min(level.thousandths + range.step.thousandths, range.to.thousandths)};
}

base::Result<Scan> scan_up(const SearchRange& range, const Passes& passes)
{
    Scan scan;
    for (ImpairmentLevel level = range.from;; level = above(level, range)) {
        const auto passed = passes(level);
        if (!passed) return tl::unexpected{passed.error()};
        if (!*passed) {
            scan.failed = level;
            return scan;
        }
        scan.passed = level;
        if (level >= range.to) return scan;
    }
}

/// What lies below a `from` that failed.
base::Result<Scan> scan_below(const SearchRange& range, const Passes& passes)
{
    if (range.from == ImpairmentLevel{}) return Scan{std::nullopt, range.from};
    SearchRange below = range;
    below.from = {};
    below.to = {(range.from.thousandths - 1) / range.step.thousandths * range.step.thousandths};
    auto scan = scan_up(below, passes);
    if (scan && !scan->failed) scan->failed = range.from;
    return scan;
}

base::Result<ImpairmentLevel> halve(ImpairmentLevel passed, ImpairmentLevel failed,
                                    const SearchRange& range, const Passes& passes)
{
    const std::int64_t resolution = range.resolution.thousandths;
    while (failed.thousandths - passed.thousandths > resolution) {
        const std::int64_t steps = (failed.thousandths - passed.thousandths) / resolution;
        const ImpairmentLevel middle{passed.thousandths +
                                     std::max<std::int64_t>(steps / 2, 1) * resolution};
        const auto is_passed = passes(middle);
        if (!is_passed) return tl::unexpected{is_passed.error()};
        (*is_passed ? passed : failed) = middle;
    }
    return passed;
}

} // namespace

base::Result<Limit> find_limit(const SearchRange& range, const Passes& passes)
{
    auto scan = scan_up(range, passes);
    if (scan && !scan->passed) scan = scan_below(range, passes);
    if (!scan) return tl::unexpected{scan.error()};
    if (!scan->failed) return Limit{*scan->passed, false};
    if (!scan->passed) return Limit{ImpairmentLevel{}, true};
    return halve(*scan->passed, *scan->failed, range, passes).map([](ImpairmentLevel level) {
        return Limit{level, true};
    });
}

} // namespace hapnet::lab::experiment
