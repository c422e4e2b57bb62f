// SPDX-FileCopyrightText: 2026 The Hapnet authors
// SPDX-License-Identifier: MIT
#pragma once

#include "proto/base/space.hpp"
#include "proto/base/time.hpp"

#include <algorithm>

namespace hapnet::device {

/// Estimates the heat of the motors from the square of the force over time (I2t), because no device
/// measures it well: heat' = (|f|^2 / continuous^2 - heat) / time. A heat of 1 is the temperature
/// at the continuous force. Above 1 the limit decreases linearly from the peak to the continuous
/// force. This causes no fault, and in the steady state the force exceeds the continuous force by
/// at most 5 %.
class MotorHeat {
public:
    /// `continuous_n`: the force that the motors can hold without limit in time, N; infinity: any
    /// force. `heat`: the heat at the start.
    MotorHeat(double continuous_n, base::Duration time, double heat = 0.0)
        : continuous_n_{continuous_n},
          heating_{continuous_n > 0.0 ? 1.0 / (continuous_n * continuous_n) : 0.0},
          per_s_{1.0 / base::to_seconds(time)},
          heat_{heat}
    {}

    /// Accounts for a force that was held for this time.
    void pass(const base::Force& force, base::Duration duration)
    {
        const glm::dvec3& f = force.value;
        const double goal = heating_ * (f.x * f.x + f.y * f.y + f.z * f.z);
        if (duration != duration_) {
            duration_ = duration;
            share_ = std::min(1.0, per_s_ * base::to_seconds(duration));
        }
        heat_ += share_ * (goal - heat_);
    }

    /// Returns the largest force that the motors may give now. `peak_n` is the largest force of
    /// all.
    [[nodiscard]] double force_max_n(double peak_n) const
    {
        if (heat_ <= 1.0 || continuous_n_ >= peak_n) return peak_n;
        const double share = std::min(1.0, (heat_ - 1.0) / band);
        return peak_n + share * (continuous_n_ - peak_n);
    }

    [[nodiscard]] double heat() const { return heat_; }

    static constexpr double band = 0.1; // range of heat above 1 in which the limit decreases

private:
    double continuous_n_;
    double heating_;
    double per_s_;
    double heat_;
    base::Duration duration_{}; // duration that share_ was computed for; constant in a steady loop
    double share_ = 0.0;
};

} // namespace hapnet::device
