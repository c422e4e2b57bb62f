// SPDX-FileCopyrightText: 2026 The Hapnet authors
// SPDX-License-Identifier: MIT
#pragma once

#include "proto/base/describe.hpp"
#include "proto/base/time.hpp"

#include <cstddef>
#include <optional>
#include <vector>

namespace hapnet::base {

/// Quantiles of durations by nearest rank: the smallest value such that at least this share of all
/// values are not larger. DurationSample returns exact quantiles. Those of DurationHistogram are
/// within 1.6 % either way and never outside the range of its values. `max` is always exact.
struct Quantiles {
    Duration p50{};
    Duration p90{};
    Duration p99{};
    Duration p999{};
    Duration max{};

    friend bool operator==(const Quantiles&, const Quantiles&) = default;
};
constexpr auto fields_of(Tag<Quantiles>)
{
    return fields("quantiles", member("p50", &Quantiles::p50), member("p90", &Quantiles::p90),
                  member("p99", &Quantiles::p99), member("p999", &Quantiles::p999),
                  member("max", &Quantiles::max));
}

/// The quantiles that reports on paths and loops contain.
struct MainQuantiles {
    Duration p50{};
    Duration p99{};
    Duration max{};

    MainQuantiles() = default;
    // NOLINTNEXTLINE(*-explicit-*): it is the same with less in it
    MainQuantiles(const Quantiles& all) : p50{all.p50}, p99{all.p99}, max{all.max} {}
};
constexpr auto fields_of(Tag<MainQuantiles>)
{
    return fields("main quantiles", member("p50", &MainQuantiles::p50),
                  member("p99", &MainQuantiles::p99), member("max", &MainQuantiles::max));
}

/// Keeps all durations, for exact quantiles. Its memory grows with their number.
class DurationSample {
public:
    void add(Duration value) { values_.push_back(value); }

    [[nodiscard]] std::size_t count() const { return values_.size(); }
    /// Returns the values in the order in which they were added.
    [[nodiscard]] const std::vector<Duration>& values() const { return values_; }

    /// Returns nullopt when nothing was added.
    [[nodiscard]] std::optional<Quantiles> quantiles() const;

private:
    std::vector<Duration> values_;
};

} // namespace hapnet::base
