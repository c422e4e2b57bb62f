// SPDX-FileCopyrightText: 2026 The Hapnet authors
// SPDX-License-Identifier: MIT
#pragma once

#include "proto/base/time.hpp"

#include <algorithm>
#include <array>
#include <chrono>
#include <cstddef>
#include <optional>

namespace hapnet::emulator {

/// Proportional integral controller enhanced (RFC 8033, sections 4.1 to 4.4, with time stamps for
/// the delay): drops arriving datagrams with a probability that a controller sets every 15 ms.
class Pie {
public:
    static constexpr base::Duration update_every = std::chrono::milliseconds{15};
    static constexpr base::Duration burst_max = std::chrono::milliseconds{150};
    static constexpr std::size_t bytes_min = 2048; // two datagrams of the mean size
    /// The greatest drop probability at which datagrams are marked. Above it all are dropped
    /// instead, because the sender apparently does not respond to marks (section 5.1).
    static constexpr double marked_up_to = 0.1;

    explicit Pie(base::Duration target) : target_{base::to_seconds(target)} {}

    /// Returns true if a datagram that arrives is dropped. `uniform`: its draw, from 0 to 1.
    [[nodiscard]] bool drops(base::TimePoint now, std::size_t bytes_waiting, double uniform)
    {
        advance(now);
        if (probability_ <= 0.0 && delay_ < target_ / 2 && delay_before_ < target_ / 2) {
            burst_ = burst_max;
        }
        if (burst_ > base::Duration{0}) return false;
        const bool is_calm = delay_before_ < target_ / 2 && probability_ < 0.2;
        if (is_calm || bytes_waiting <= bytes_min) return false;
        return uniform < probability_;
    }

    /// Notes that a datagram leaves the queue after it has waited this long.
    void on_departure(base::TimePoint now, base::Duration waited)
    {
        advance(now);
        delay_ = base::to_seconds(waited);
    }

    void change(base::Duration target) { target_ = base::to_seconds(target); }

    [[nodiscard]] double probability() const { return probability_; }

private:
    /// Runs all updates that were due by `now`. The first one is 15 ms after the first datagram.
    void advance(base::TimePoint now)
    {
        if (!next_update_) next_update_ = now + update_every;
        // The number of steps after which nothing is left of the probability in a long idle time.
        // Each step reduces it by 2 % and by the change of the controller.
        constexpr int steps_max = 10'000;
        for (int step = 0; *next_update_ <= now; ++step) {
            if (step == steps_max) {
                next_update_ = now + update_every;
                return;
            }
            update();
            *next_update_ += update_every;
        }
    }

    void update()
    {
        constexpr double alpha = 0.125;
        constexpr double beta = 1.25;
        double change = alpha * (delay_ - target_) + beta * (delay_ - delay_before_);
        change /= scale();
        if (probability_ >= 0.1) change = std::min(change, 0.02);
        probability_ += change;
        if (delay_ == 0.0 && delay_before_ == 0.0) probability_ *= 0.98;
        probability_ = std::clamp(probability_, 0.0, 1.0);
        delay_before_ = delay_;
        burst_ = std::max(burst_ - update_every, base::Duration{0});
    }

    /// Returns the divisor that makes a small probability change more slowly.
    [[nodiscard]] double scale() const
    {
        struct Scale {
            double below;
            double divisor;
        };
        constexpr std::array<Scale, 6> scales{
            {{1e-6, 2048.0}, {1e-5, 512.0}, {1e-4, 128.0}, {1e-3, 32.0}, {1e-2, 8.0}, {1e-1, 2.0}}};
        for (const Scale& one : scales) {
            if (probability_ < one.below) return one.divisor;
        }
        return 1.0;
    }

    double target_; // in seconds, as delay_
    double delay_ = 0.0;
    double delay_before_ = 0.0; // delay_ at the last update
    double probability_ = 0.0;
    base::Duration burst_{};
    std::optional<base::TimePoint> next_update_;
};

} // namespace hapnet::emulator
