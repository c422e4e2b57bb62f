// SPDX-FileCopyrightText: 2026 The Hapnet authors
// SPDX-License-Identifier: MIT
#pragma once

#include "proto/base/describe.hpp"

#include <cstddef>
#include <cstdint>
#include <optional>
#include <vector>

namespace hapnet::emulator::tools {

/// The precision of a series' mean and standard deviation, as shares of their values: half the
/// width of a 95 % interval.
struct Precision {
    double mean = 0.0;
    double sd = 0.0; // 0 if all values are equal
};
constexpr auto fields_of(base::Tag<Precision>)
{
    return base::fields("precision", base::member("mean", &Precision::mean),
                        base::member("sd", &Precision::sd));
}

/// Estimates by the method of batch means (Law, "Simulation Modeling and Analysis", 9.5.3) how
/// precisely the mean and deviation of a series are known. Neighbouring values may be correlated.
/// It keeps 32 to 63 batches of equal length: when there would be more, neighbours are joined. The
/// remaining correlation between the batches widens the interval as for an autoregressive series of
/// first order.
class BatchMeans {
public:
    static constexpr std::size_t batches_min = 32;

    void add(double value);

    [[nodiscard]] std::uint64_t count() const { return count_; }
    /// Returns nullopt for fewer values than batches_min.
    [[nodiscard]] std::optional<Precision> precision() const;

private:
    struct Sums {
        double count = 0.0;
        double first = 0.0;  // sum of value - origin_: numbers stay small
        double second = 0.0; // sum of the squares of value - origin_

        void add(const Sums& other);
    };

    double origin_ = 0.0;
    std::uint64_t count_ = 0;
    double batch_size_ = 1.0;
    Sums open_; // the batch that is being filled
    std::vector<Sums> batches_;
};

} // namespace hapnet::emulator::tools
