// SPDX-FileCopyrightText: 2026 The Hapnet authors
// SPDX-License-Identifier: MIT
#pragma once

#include "proto/base/figures/quantiles.hpp"
#include "proto/base/time.hpp"

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <vector>

namespace hapnet::base {

/// Counts durations in bins whose width is at most 1/64 of their value, from 1 ns to an hour,
/// in a fixed 20 KiB: adding never allocates. Quantiles err by at most 1.6 %; the largest value
/// is kept exactly. Negative durations count as zero, longer ones in the last bin.
class DurationHistogram {
public:
    void add(Duration duration);
    /// All that another one has counted.
    void add(const DurationHistogram& other);

    [[nodiscard]] std::uint64_t count() const { return count_; }

    /// Becomes the same as the other. Costs as much as there is between the smallest and the
    /// largest value of both, and not all of the 20 KiB.
    void assign(const DurationHistogram& other);
    /// How many bytes of it another one is assigned.
    [[nodiscard]] std::size_t filled_bytes() const;

    /// The upper edge of the bin that holds quantile q (0 < q <= 1), at most max(); nullopt
    /// when nothing was added.
    [[nodiscard]] std::optional<Duration> quantile(double q) const;

    [[nodiscard]] std::optional<Duration> max() const;

    /// The quantiles above in a single pass; nullopt when nothing was added.
    [[nodiscard]] std::optional<Quantiles> quantiles() const;

    /// How many are longer than `limit`, by whole bins: those for which a quantile would say so.
    [[nodiscard]] std::uint64_t count_above(Duration limit) const;

    /// A bin with something in it: the values from `low` on that are below `high`.
    struct Bin {
        Duration low{};
        Duration high{};
        std::uint64_t count = 0;
    };
    /// Those with something in them, ascending.
    [[nodiscard]] std::vector<Bin> filled_bins() const;

private:
    static constexpr int sub_bits = 6; // 64 bins to an octave
    static constexpr std::size_t bins = (43U - sub_bits) << sub_bits;

    [[nodiscard]] static std::size_t bin_of(std::uint64_t nanoseconds);
    [[nodiscard]] static std::uint64_t upper_edge(std::size_t bin);
    /// The number of values that quantile `q` is to reach; count() is not 0.
    [[nodiscard]] std::uint64_t rank_of(double q) const;
    [[nodiscard]] Duration value_of(std::size_t bin) const
    {
        return Duration{static_cast<Duration::rep>(std::min(upper_edge(bin), max_))};
    }
    /// One more than that of the largest value.
    [[nodiscard]] std::size_t end_bin() const { return count_ > 0 ? bin_of(max_) + 1 : first_; }

    std::array<std::uint64_t, bins> counts_{};
    std::uint64_t count_ = 0;
    std::uint64_t max_ = 0;
    std::size_t first_ = bins; // the bin of the smallest value
};

/// The same, copied by assign(): for who must not be kept waiting while it is copied.
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
