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
    const std::size_t bin = bin_of(nanoseconds);
    ++counts_[bin];
    ++count_;
    max_ = std::max(max_, nanoseconds);
    first_ = std::min(first_, bin);
}

void DurationHistogram::assign(const DurationHistogram& other)
{
    if (this == &other) return;
    const auto own = std::span{counts_};
    std::ranges::fill(own.subspan(first_, end_bin() - first_), 0);
    const auto filled =
        std::span{other.counts_}.subspan(other.first_, other.end_bin() - other.first_);
    std::ranges::copy(filled, own.subspan(other.first_).begin());
    count_ = other.count_;
    max_ = other.max_;
    first_ = other.first_;
}

std::size_t DurationHistogram::filled_bytes() const
{
    return (end_bin() - first_) * sizeof counts_.front();
}

void DurationHistogram::add(const DurationHistogram& other)
{
    for (std::size_t i = other.first_; i < other.end_bin(); ++i) counts_[i] += other.counts_[i];
    count_ += other.count_;
    max_ = std::max(max_, other.max_);
    first_ = std::min(first_, other.first_);
}

std::uint64_t DurationHistogram::rank_of(double q) const
{
    return std::max<std::uint64_t>(
        1, static_cast<std::uint64_t>(std::ceil(q * static_cast<double>(count_))));
}

std::optional<Duration> DurationHistogram::quantile(double q) const
{
    ensure(q > 0.0 && q <= 1.0);
    if (count_ == 0) return std::nullopt;
    const auto wanted = rank_of(q);
    std::uint64_t seen = 0;
    for (std::size_t bin = first_; bin < bins; ++bin) {
        seen += counts_[bin];
        if (seen >= wanted) return value_of(bin);
    }
    return max();
}

std::optional<Quantiles> DurationHistogram::quantiles() const
{
    if (count_ == 0) return std::nullopt;
    std::size_t bin = first_;
    std::uint64_t seen = counts_[bin];
    const auto next = [&](double q) { // not below the one before
        const auto wanted = rank_of(q);
        while (seen < wanted && bin + 1 < bins) seen += counts_[++bin];
        return value_of(bin);
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
        const auto low = bin == 0 ? 0 : upper_edge(bin - 1) + 1;
        filled.push_back({edge(low), edge(upper_edge(bin) + 1), counts_[bin]});
    }
    return filled;
}

std::optional<Duration> DurationHistogram::max() const
{
    if (count_ == 0) return std::nullopt;
    return Duration{static_cast<Duration::rep>(max_)};
}

std::uint64_t DurationHistogram::count_above(Duration limit) const
{
    if (limit < Duration{0}) return count_;
    const auto most = static_cast<std::uint64_t>(limit.count());
    std::uint64_t above = 0;
    for (std::size_t bin = 0; bin < bins; ++bin) {
        if (std::min(upper_edge(bin), max_) > most) above += counts_[bin];
    }
    return above;
}

} // namespace hapnet::base
