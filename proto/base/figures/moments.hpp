// SPDX-FileCopyrightText: 2026 The Hapnet authors
// SPDX-License-Identifier: MIT
#pragma once

#include "proto/base/describe.hpp"
#include "proto/base/time.hpp"

#include <cstdint>
#include <optional>

namespace hapnet::base {

/// The mean and standard deviation of a sample of durations, to the nearest nanosecond.
struct Moments {
    Duration mean{};
    std::optional<Duration> sd; // standard deviation (n - 1); nullopt for a single value

    friend bool operator==(const Moments&, const Moments&) = default;
};
constexpr auto fields_of(Tag<Moments>)
{
    return fields("moments", member("mean", &Moments::mean), member("sd", &Moments::sd));
}

/// Returns the duration nearest to a number of nanoseconds. Half a nanosecond is rounded up.
[[nodiscard]] Duration nearest_duration(double nanoseconds);

/// Accumulates mean and variance in one pass (Welford, Technometrics 4, 1962).
class RunningMoments {
public:
    void add(Duration value)
    {
        ++count_;
        const double deviation = to_nanoseconds(value) - mean_ns_;
        mean_ns_ += deviation / static_cast<double>(count_);
        squares_ += deviation * (to_nanoseconds(value) - mean_ns_);
    }

    [[nodiscard]] std::uint64_t count() const { return count_; }

    /// Returns nullopt when nothing was added.
    [[nodiscard]] std::optional<Moments> moments() const;

private:
    std::uint64_t count_ = 0;
    double mean_ns_ = 0.0;
    double squares_ = 0.0; // sum of the squared deviations from the mean, ns^2
};

} // namespace hapnet::base
