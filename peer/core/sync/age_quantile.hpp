// SPDX-FileCopyrightText: 2026 The Hapnet authors
// SPDX-License-Identifier: MIT
#pragma once

#include "proto/base/time.hpp"

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>

namespace hapnet::peer {

/// The recent ages of some information, in ticks, and their quantiles. Ages are forgotten in fifths
/// of the memory.
class AgeQuantile {
public:
    static constexpr std::int64_t age_max = 1023;

    void add(std::int64_t age)
    {
        const auto bin = static_cast<std::size_t>(std::clamp<std::int64_t>(age, 0, age_max));
        ++parts_[part_][bin];
        ++sum_[bin];
        ++count_;
    }
    /// Advances the time by a tick. Call it once per tick.
    void pass(base::Duration tick, base::Duration memory)
    {
        passed_ += tick;
        if (passed_ < memory / static_cast<std::int64_t>(parts_.size())) return;
        passed_ = {};
        part_ = (part_ + 1) % parts_.size();
        for (std::size_t bin = 0; bin < sum_.size(); ++bin) {
            sum_[bin] -= parts_[part_][bin];
            count_ -= parts_[part_][bin];
        }
        parts_[part_].fill(0);
    }
    void forget() { *this = AgeQuantile{}; }

    /// Returns the smallest age that this share of them does not exceed; 0 if there are none.
    [[nodiscard]] std::int64_t value(double share) const
    {
        const double above_max = (1.0 - share) * static_cast<double>(count_);
        std::uint64_t above = 0;
        for (std::int64_t age = age_max; age > 0; --age) {
            above += sum_[static_cast<std::size_t>(age)];
            if (static_cast<double>(above) > above_max) return age;
        }
        return 0;
    }

private:
    using Bins = std::array<std::uint32_t, age_max + 1>;
    std::array<Bins, 5> parts_{};
    Bins sum_{};
    std::uint64_t count_ = 0;
    std::size_t part_ = 0;
    base::Duration passed_{};
};

} // namespace hapnet::peer
