// SPDX-FileCopyrightText: 2026 The Hapnet authors
// SPDX-License-Identifier: MIT
#pragma once

#include "proto/base/time.hpp"

#include <glm/vec3.hpp>

namespace hapnet::peer {

/// An alpha-beta filter for samples at irregular times. It estimates a signal and its slope, is
/// critically damped, and follows a ramp without lag (P. R. Kalata: The tracking index, 1984;
/// fading memory with the share theta = exp(-dt / time constant), N. Morrison: Introduction to
/// sequential smoothing and prediction, 1969).
class AlphaBeta {
public:
    /// `time_constant_s` is the time constant with which samples lose weight, 0 or more.
    explicit AlphaBeta(double time_constant_s) : time_constant_s_{time_constant_s} {}

    /// Restarts the filter from this sample with a slope of zero.
    void restart(const glm::dvec3& sample, base::TimePoint at);
    /// Adds a sample. It is ignored unless it is later than the last one.
    void add(const glm::dvec3& sample, base::TimePoint at);

    [[nodiscard]] base::TimePoint at() const { return at_; } // time of the last sample
    [[nodiscard]] const glm::dvec3& value() const { return value_; }
    [[nodiscard]] const glm::dvec3& slope() const { return slope_; } // per second

private:
    /// The gains for the interval between samples. They are stored, because the interval is usually
    /// one tick, and the exponential costs more than the rest.
    struct Gains {
        base::Duration apart{};
        double alpha = 0.0;
        double beta_per_s = 0.0;
    };

    [[nodiscard]] Gains gains_for(base::Duration apart) const;

    double time_constant_s_;
    base::TimePoint at_;
    glm::dvec3 value_{0.0};
    glm::dvec3 slope_{0.0};
    Gains gains_;
};

} // namespace hapnet::peer
