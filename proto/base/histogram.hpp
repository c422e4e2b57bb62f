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
/// fixed 20 KiB: adding never allocates. The smallest and the largest value are kept exactly.
/// Negative durations count as zero, longer ones in the last bin.
///
/// A quantile takes the values of a bin to lie evenly in it. It is never outside [min(), max()],
/// and differs from the quantile of the values themselves by less than the width of their bin: by
/// at most 1/64 of it, which is 1.6 %, either way. It is exact for 1 and for count() values.
class DurationHistogram {
public:
    void add(Duration duration);
    /// Adds the counts of another histogram.
    void add(const DurationHistogram& other);

    [[nodiscard]] std::uint64_t count() const { return count_; }

    /// Becomes the same as the other. Costs as much as there is between the smallest and the
    /// largest value of both, and not all of the 20 KiB.
    void assign(const DurationHistogram& other);
    /// Number of bytes that assigning this histogram copies.
    [[nodiscard]] std::size_t filled_bytes() const;

    /// The value that a share q of all do not exceed (0 < q <= 1), to 1.6 %; nullopt when nothing
    /// was added.
    [[nodiscard]] std::optional<Duration> quantile(double q) const;

    /// The smallest value; nullopt when nothing was added.
    [[nodiscard]] std::optional<Duration> min() const;
    /// The largest value; nullopt when nothing was added.
    [[nodiscard]] std::optional<Duration> max() const;

    /// The quantiles above in a single pass; nullopt when nothing was added.
    [[nodiscard]] std::optional<Quantiles> quantiles() const;

    /// Returns the number of ranks whose quantile is longer than `limit`.
    [[nodiscard]] std::uint64_t count_above(Duration limit) const;

    /// A bin with something in it: the values from `low` on that are below `high`.
    struct Bin {
        Duration low{};
        Duration high{};
        std::uint64_t count = 0;
    };
    /// The bins that hold a value, ascending.
    [[nodiscard]] std::vector<Bin> filled_bins() const;

private:
    static constexpr int sub_bits = 6; // 64 bins to an octave
    static constexpr std::size_t bins = (43U - sub_bits) << sub_bits;

    [[nodiscard]] static std::size_t bin_of(std::uint64_t nanoseconds);
    [[nodiscard]] static std::uint64_t lower_edge(std::size_t bin);
    [[nodiscard]] static std::uint64_t upper_edge(std::size_t bin);
    /// The number of values that quantile `q` is to reach; count() is not 0.
    [[nodiscard]] std::uint64_t rank_of(double q) const;
    /// Returns the value of that rank, when `below` values are in the bins below; count() is not 0.
    [[nodiscard]] Duration value_of(std::uint64_t rank, std::size_t bin, std::uint64_t below) const;
    /// The bin of the smallest value.
    [[nodiscard]] std::size_t first_bin() const { return count_ > 0 ? bin_of(min_) : bins; }
    /// One more than the bin of the largest value.
    [[nodiscard]] std::size_t end_bin() const { return count_ > 0 ? bin_of(max_) + 1 : bins; }

    std::array<std::uint64_t, bins> counts_{};
    std::uint64_t count_ = 0;
    std::uint64_t min_ = std::numeric_limits<std::uint64_t>::max();
    std::uint64_t max_ = 0;
};

/// A histogram that is copied by assign(), so that its user does not wait for the copy.
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
