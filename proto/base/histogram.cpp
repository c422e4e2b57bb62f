// SPDX-FileCopyrightText: 2026 The Hapnet authors
// SPDX-License-Identifier: MIT
#include "proto/base/histogram.hpp"

#include "proto/base/ensure.hpp"

#include <algorithm>
#include <bit>
#include <cmath>
#include <span>

namespace hapnet::base {

// Bins 0..63 hold the values 0..63 exactly; after that each octave [2^k, 2^(k+1)) has 64 bins.
std::size_t DurationHistogram::bin_of(std::uint64_t nanoseconds)
{
    const int octave = std::max(0, static_cast<int>(std::bit_width(nanoseconds)) - sub_bits - 1);
    const auto within = nanoseconds >> octave; // 64..127 once octave > 0
    const auto bin = (static_cast<std::uint64_t>(octave) << sub_bits) + within;
    return static_cast<std::size_t>(std::min<std::uint64_t>(bin, bins - 1));
}

std::uint64_t DurationHistogram::lower_edge(std::size_t bin)
{
    return bin == 0 ? 0 : upper_edge(bin - 1) + 1;
}

std::uint64_t DurationHistogram::upper_edge(std::size_t bin)
{
    constexpr std::size_t per_octave = 1U << sub_bits;
    if (bin < 2 * per_octave) return bin;
    const auto octave = bin / per_octave - 1;
    const auto within = bin - octave * per_octave;
    return ((within + 1) << octave) - 1;
}

void DurationHistogram::add(Duration duration)
{
    const auto nanoseconds =
        static_cast<std::uint64_t>(std::max<Duration::rep>(0, duration.count()));
    ++counts_[bin_of(nanoseconds)];
    ++count_;
    min_ = std::min(min_, nanoseconds);
    max_ = std::max(max_, nanoseconds);
}

void DurationHistogram::assign(const DurationHistogram& other)
{
    if (this == &other) return;
    const auto own = std::span{counts_};
    std::ranges::fill(own.subspan(first_bin(), end_bin() - first_bin()), 0);
    const std::size_t first = other.first_bin();
    const auto filled = std::span{other.counts_}.subspan(first, other.end_bin() - first);
    std::ranges::copy(filled, own.subspan(first).begin());
    count_ = other.count_;
    min_ = other.min_;
    max_ = other.max_;
}

std::size_t DurationHistogram::filled_bytes() const
{
    return (end_bin() - first_bin()) * sizeof counts_.front();
}

void DurationHistogram::add(const DurationHistogram& other)
{
    for (std::size_t i = other.first_bin(); i < other.end_bin(); ++i)
        counts_[i] += other.counts_[i];
    count_ += other.count_;
    min_ = std::min(min_, other.min_);
    max_ = std::max(max_, other.max_);
}

std::uint64_t DurationHistogram::rank_of(double q) const
{
    return std::max<std::uint64_t>(
        1, static_cast<std::uint64_t>(std::ceil(q * static_cast<double>(count_))));
}

Duration DurationHistogram::value_of(std::uint64_t rank, std::size_t bin, std::uint64_t below) const
{
    const auto duration = [](std::uint64_t nanoseconds) {
        return Duration{static_cast<Duration::rep>(nanoseconds)};
    };
    if (rank <= 1) return duration(min_);
    if (rank >= count_) return duration(max_);
    const std::uint64_t low = std::max(lower_edge(bin), min_);
    const std::uint64_t high = std::min(upper_edge(bin), max_);
    const double place = static_cast<double>(rank - below) - 0.5; // middle of the share
    const double share = place / static_cast<double>(counts_[bin]);
    return duration(low + static_cast<std::uint64_t>(share * static_cast<double>(high - low)));
}

std::optional<Duration> DurationHistogram::quantile(double q) const
{
    ensure(q > 0.0 && q <= 1.0);
    if (count_ == 0) return std::nullopt;
    const auto wanted = rank_of(q);
    std::size_t bin = first_bin();
    std::uint64_t below = 0;
    for (; bin + 1 < bins && below + counts_[bin] < wanted; ++bin) below += counts_[bin];
    return value_of(wanted, bin, below);
}

std::optional<Quantiles> DurationHistogram::quantiles() const
{
    if (count_ == 0) return std::nullopt;
    std::size_t bin = first_bin();
    std::uint64_t below = 0;
    const auto next = [&](double q) { // each q must not be below the previous one
        const auto wanted = rank_of(q);
        for (; bin + 1 < bins && below + counts_[bin] < wanted; ++bin) below += counts_[bin];
        return value_of(wanted, bin, below);
    };
    const auto p50 = next(0.5), p90 = next(0.9), p99 = next(0.99), p999 = next(0.999);
    return Quantiles{p50, p90, p99, p999, *max()};
}

std::vector<DurationHistogram::Bin> DurationHistogram::filled_bins() const
{
    std::vector<Bin> filled;
    const auto edge = [](std::uint64_t value) {
        return Duration{static_cast<Duration::rep>(value)};
    };
    for (std::size_t bin = 0; bin < bins; ++bin) {
        if (counts_[bin] == 0) continue;
        filled.push_back({edge(lower_edge(bin)), edge(upper_edge(bin) + 1), counts_[bin]});
    }
    return filled;
}

std::optional<Duration> DurationHistogram::min() const
{
    if (count_ == 0) return std::nullopt;
    return Duration{static_cast<Duration::rep>(min_)};
}

std::optional<Duration> DurationHistogram::max() const
{
    if (count_ == 0) return std::nullopt;
    return Duration{static_cast<Duration::rep>(max_)};
}

std::uint64_t DurationHistogram::count_above(Duration limit) const
{
    std::uint64_t below = 0; // number of values in the earlier bins
    for (std::size_t bin = first_bin(); bin < end_bin(); ++bin) {
        const std::uint64_t last = below + counts_[bin];
        if (last > below && value_of(last, bin, below) > limit) {
            std::uint64_t within = below; // the last rank that is not above the limit
            for (std::uint64_t step = counts_[bin]; step > 0; step /= 2) {
                while (within + step < last && value_of(within + step, bin, below) <= limit)
                    within += step;
            }
            return count_ - within;
        }
        below = last;
    }
    return 0;
}

} // namespace hapnet::base
