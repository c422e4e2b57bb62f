// SPDX-FileCopyrightText: 2026 The Hapnet authors
// SPDX-License-Identifier: MIT
#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>

namespace hapnet::scene {

/// A lower bound of a gap from one moment on. After a time t the room is at least room + sum |part|
/// - t approach - sum |part + t speed| - t^2 bend / 2.
struct Forecast {
    static constexpr std::size_t parts_max = 4;
    double room = 0.0;     // m: how much the gap may shrink
    double approach = 0.0; // m/s
    double bend = 0.0;     // m/s^2
    std::array<double, parts_max> parts{};
    std::array<double, parts_max> speeds{};

    /// Returns the time for which there is certainly room, at most `most`.
    [[nodiscard]] double time_left(double most) const
    {
        double size = 0.0;
        for (const double part : parts) size += std::abs(part);
        // The remaining room is concave in time. So it is used up once, and not later than its
        // slope at the beginning predicts. Newton's method approaches that moment from above. Below
        // the chord from the beginning there certainly is room.
        const double speed = approach + slope(0.0);
        const double sum = speed + std::sqrt(speed * speed + 2.0 * bend * room);
        double until = sum > 0.0 ? std::min(most, 2.0 * room / sum) : most;
        double safe = 0.0;
        constexpr int iterations = 6;
        constexpr double nearly = 0.99;
        for (int i = 0; i < iterations; ++i) {
            double there = room + size - until * approach - 0.5 * until * until * bend;
            for (std::size_t k = 0; k < parts_max; ++k)
                there -= std::abs(parts[k] + until * speeds[k]);
            if (there >= 0.0) return std::max(safe, until);
            safe = std::max(safe, until * (room / (room - there)));
            if (safe >= nearly * until) break;
            const double faster = approach + slope(until) + until * bend;
            if (!(faster > 0.0)) break; // rounding
            until = std::max(safe, until + there / faster);
        }
        return safe;
    }

private:
    /// Returns the speed at which the sum of the parts' sizes grows.
    [[nodiscard]] double slope(double time) const
    {
        double sum = 0.0;
        for (std::size_t k = 0; k < parts_max; ++k)
            sum += std::copysign(speeds[k], speeds[k] * (parts[k] + time * speeds[k]));
        return sum;
    }
};

} // namespace hapnet::scene
