// SPDX-FileCopyrightText: 2026 The Hapnet authors
// SPDX-License-Identifier: MIT
#include "lab/experiment/search.hpp"

#include <algorithm>
#include <optional>

namespace hapnet::lab::experiment {

namespace {

using Thousandths = std::int64_t;

constexpr Thousandths gaps = counted_levels - 1;

/// The levels between which sessions begin to fail: the last one without failures before the first
/// one with failures, and the first one at which all fail, or else the last tried level.
struct Onset {
    Thousandths low = 0;
    Thousandths high = 0;
    bool is_any = false; // true if any session failed
};

Thousandths rounded_up(Thousandths value, Thousandths unit)
{
    return (value + unit - 1) / unit * unit;
}

/// A search in progress.
class LevelSearch {
public:
    LevelSearch(const SearchRange& range, std::uint32_t seeds, const Failures& failures)
        : to_{range.to.thousandths},
          resolution_{range.resolution.thousandths},
          seeds_{seeds},
          failures_{failures}
    {}

    base::Result<std::vector<ImpairmentLevel>> run(const SearchRange& range)
    {
        auto onset = scanned(range.from.thousandths, to_, range.step.thousandths);
        if (onset && onset->is_any && onset->low == -1) {
            onset = scanned(0, to_, range.step.thousandths);
        }
        if (onset && !onset->is_any) return only_top(*onset);
        for (Thousandths step = range.step.thousandths; onset && step > resolution_;) {
            const Thousandths span = onset->high - std::max<Thousandths>(onset->low, 0);
            const Thousandths finer = std::max(resolution_, rounded_up(span / 8, resolution_));
            // A scan need not be finer than the distance of the levels that count.
            if (finer >= step || span <= 4 * finer) break;
            step = finer;
            onset = scanned(std::max<Thousandths>(onset->low, 0), onset->high, step);
        }
        if (!onset) return tl::unexpected{onset.error()};
        return widened(*onset);
    }

private:
    /// Scans the range. `low` is -1 when the first level has failures.
    base::Result<Onset> scanned(Thousandths from, Thousandths to, Thousandths step)
    {
        const std::uint32_t seeds = std::min(scan_seeds, seeds_);
        Onset onset{-1, to, false};
        for (Thousandths level = from;; level = std::min(level + step, to)) {
            const auto failed = failures_({level}, seeds);
            if (!failed) return tl::unexpected{failed.error()};
            onset.is_any = onset.is_any || *failed > 0;
            if (!onset.is_any) onset.low = level;
            if (*failed == seeds || level >= to) {
                onset.high = level;
                return onset;
            }
        }
    }

    /// Plays all seeds at the top level if the scan found no failures. Adds levels if one of them
    /// fails.
    base::Result<std::vector<ImpairmentLevel>> only_top(const Onset& onset)
    {
        const auto failed = failures_({to_}, seeds_);
        if (!failed) return tl::unexpected{failed.error()};
        if (*failed == 0) return std::vector<ImpairmentLevel>(1, ImpairmentLevel{to_});
        return widened({onset.low - gaps * resolution_, to_, true});
    }

    /// Returns eight levels across the onset, and further ones.
    base::Result<std::vector<ImpairmentLevel>> widened(const Onset& onset)
    {
        const Thousandths low = std::max<Thousandths>(onset.low, 0);
        const Thousandths gap =
            std::max(resolution_, rounded_up((onset.high - low + gaps - 1) / gaps, resolution_));
        const Thousandths centre = (low + onset.high) / 2;
        Thousandths first = (centre - gaps * gap / 2) / resolution_ * resolution_;
        first = std::max<Thousandths>(std::min(first, to_ - gaps * gap), 0);
        std::vector<ImpairmentLevel> levels;
        for (Thousandths i = 0; i <= gaps && first + i * gap <= to_; ++i)
            levels.push_back({first + i * gap});
        const auto lower = add_lower(levels, gap);
        if (!lower) return tl::unexpected{lower.error()};
        const auto higher = add_higher(levels, gap);
        if (!higher) return tl::unexpected{higher.error()};
        return levels;
    }

    base::Result<void> add_lower(std::vector<ImpairmentLevel>& levels, Thousandths gap)
    {
        for (std::size_t added = 1;; ++added) {
            const ImpairmentLevel lowest = levels.front();
            if (lowest == ImpairmentLevel{}) return {};
            const auto failed = failures_(lowest, seeds_);
            if (!failed) return tl::unexpected{failed.error()};
            if (10 * *failed <= seeds_) return {};
            if (added > further_levels) gap *= 2;
            const Thousandths lower = std::max<Thousandths>(lowest.thousandths - gap, 0);
            levels.insert(levels.begin(), ImpairmentLevel{lower});
        }
    }

    base::Result<void> add_higher(std::vector<ImpairmentLevel>& levels, Thousandths gap)
    {
        for (std::size_t added = 1;; ++added) {
            const ImpairmentLevel highest = levels.back();
            if (highest.thousandths >= to_) return {};
            const auto failed = failures_(highest, seeds_);
            if (!failed) return tl::unexpected{failed.error()};
            if (2 * *failed >= seeds_) return {};
            if (added > further_levels) gap *= 2;
            levels.push_back({std::min(highest.thousandths + gap, to_)});
        }
    }

    Thousandths to_;
    Thousandths resolution_;
    std::uint32_t seeds_;
    const Failures& failures_;
};

} // namespace

base::Result<std::vector<ImpairmentLevel>>
levels_to_count(const SearchRange& range, std::uint32_t seeds, const Failures& failures)
{
    return LevelSearch{range, seeds, failures}.run(range);
}

} // namespace hapnet::lab::experiment
