// SPDX-FileCopyrightText: 2026 The Hapnet authors
// SPDX-License-Identifier: MIT
#pragma once

#include "proto/base/time.hpp"

#include <algorithm>

namespace hapnet::peer {

/// The largest recent age of a peer's newest message. It rises at once and is forgotten with a time
/// constant of 5 s. Ages above 400 ms count as 400 ms.
class RecentAge {
public:
    static constexpr double most_s = 0.4;
    static constexpr double memory_s = 5.0;

    void add(double age_s) { largest_s_ = std::max(largest_s_, std::min(age_s, most_s)); }
    /// Advances the time by a tick. Call it once per tick.
    void fade(double tick_s) { largest_s_ -= largest_s_ * tick_s / memory_s; }

    [[nodiscard]] double seconds() const { return largest_s_; }

private:
    double largest_s_ = 0.0;
};

} // namespace hapnet::peer
