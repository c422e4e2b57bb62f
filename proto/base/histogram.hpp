// SPDX-FileCopyrightText: 2026 The Hapnet authors
// SPDX-License-Identifier: MIT
#pragma once

#include "proto/base/figures/quantiles.hpp"
#include "proto/base/time.hpp"

#include <array>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <optional>
#include <vector>

namespace hapnet::base {

/// Counts durations in bins whose width is at most 1/64 of their value, from 1 ns to an hour, in a
/// fixed 20 KiB. Adding never allocates. The smallest and the largest value are kept exactly.
/// Negative durations count as zero, and durations above an hour count in the last bin.
///
/// For a quantile, the values of a bin are assumed to be spread evenly over it. The quantile is
/// never outside [min(), max()]. It differs from the exact quantile of the values by less than the
/// width of their bin: by at most 1/64 of the value, which is 1.6 %, either way. It is exact for
/// the ranks 1 and count().
class DurationHistogram {
public:
    void add(Duration duration);
    /// Adds the counts of another histogram.
    void add(const DurationHistogram& other);

    [[nodiscard]] std::uint64_t count() const { return count_; }

    /// Copies the other histogram into this one. The cost grows with the range between the smallest
    /// and the largest value of both, so it is usually less than that of copying 20 KiB.
    void assign(const DurationHistogram& other);
    /// Returns the number of bytes that assigning this histogram copies.
    [[nodiscard]] std::size_t filled_bytes() const;

    /// Returns the value that a share q of all values do not exceed (0 < q <= 1), to 1.6 %; nullopt
    /// when nothing was added.
    [[nodiscard]] std::optional<Duration> quantile(double q) const;

    /// Returns the smallest value; nullopt when nothing was added.
    [[nodiscard]] std::optional<Duration> min() const;
    /// Returns the largest value; nullopt when nothing was added.
    [[nodiscard]] std::optional<Duration> max() const;

    /// Returns all Quantiles from a single pass; nullopt when nothing was added.
    [[nodiscard]] std::optional<Quantiles> quantiles() const;

    /// Returns the number of ranks whose value is longer than `limit`.
    [[nodiscard]] std::uint64_t count_above(Duration limit) const;

    /// A bin that is not empty. It counts values from `low` up to, but not including, `high`.
    struct Bin {
        Duration low{};
        Duration high{};
        std::uint64_t count = 0;
    };
    /// Returns the bins that are not empty, in ascending order.
    [[nodiscard]] std::vector<Bin> filled_bins() const;

private:
    static constexpr int sub_bits = 6; // 64 bins to an octave
    static constexpr std::size_t bins = (43U - sub_bits) << sub_bits;

    [[nodiscard]] static std::size_t bin_of(std::uint64_t nanoseconds);
    [[nodiscard]] static std::uint64_t lower_edge(std::size_t bin);
    [[nodiscard]] static std::uint64_t upper_edge(std::size_t bin);
    /// Returns the rank of quantile `q`: the number of values that do not exceed it. count() must
    /// not be 0.
    [[nodiscard]] std::uint64_t rank_of(double q) const;
    /// Returns the value of a rank that lies in `bin`. `below` is the number of values in the bins
    /// below. count() must not be 0.
    [[nodiscard]] Duration value_of(std::uint64_t rank, std::size_t bin, std::uint64_t below) const;
    /// Returns the index of the bin of the smallest value.
    [[nodiscard]] std::size_t first_bin() const { return count_ > 0 ? bin_of(min_) : bins; }
    /// Returns one more than the index of the bin of the largest value.
    [[nodiscard]] std::size_t end_bin() const { return count_ > 0 ? bin_of(max_) + 1 : bins; }

    std::array<std::uint64_t, bins> counts_{};
    std::uint64_t count_ = 0;
    std::uint64_t min_ = std::numeric_limits<std::uint64_t>::max();
    std::uint64_t max_ = 0;
};

/// A histogram that is copied with assign(), so that its user does not wait for a copy of 20 KiB.
class SnapshotHistogram : public DurationHistogram {
public:
    SnapshotHistogram() = default;
    ~SnapshotHistogram() = default;
    SnapshotHistogram(const SnapshotHistogram& other) : SnapshotHistogram{} { assign(other); }
    SnapshotHistogram(SnapshotHistogram&& other) noexcept : SnapshotHistogram{} { assign(other); }
    SnapshotHistogram& operator=(const SnapshotHistogram& other)
    {
        assign(other);
        return *this;
    }
    SnapshotHistogram& operator=(SnapshotHistogram&& other) noexcept
    {
        assign(other);
        return *this;
    }
};

} // namespace hapnet::base
