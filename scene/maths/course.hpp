// SPDX-FileCopyrightText: 2026 The Hapnet authors
// SPDX-License-Identifier: MIT
#pragma once

#include "scene/maths/response.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

namespace hapnet::scene {

/// A law with what is derived from it, and its response at the end of a tick: what most ticks need.
struct Propagator {
    Oscillator oscillator;
    double frequency = 0.0; // of the undamped oscillator, 1/s
    double period = 0.0;    // 1/frequency; infinity without stiffness
    double tick = 0.0;      // seconds
    StepResponse at_tick;

    Propagator() = default;
    Propagator(const Oscillator& of, double tick_s)
        : oscillator{of},
          frequency{std::sqrt(of.stiffness)},
          period{of.stiffness > 0.0 ? 1.0 / frequency : std::numeric_limits<double>::infinity()},
          tick{tick_s},
          at_tick{step_response(of, tick_s)}
    {}
    [[nodiscard]] StepResponse after(double time) const
    {
        return time == tick ? at_tick : step_response(oscillator, time);
    }
};

/// How far a coordinate has come, and how fast it is.
struct TrajectoryPoint {
    double displacement = 0.0;
    double speed = 0.0;
};

/// A coordinate's motion in closed form from a moment on: way'' = push + ramp t - damping way' -
/// stiffness way. A course without a kernel stays where it is.
struct Trajectory {
    const Propagator* propagator;
    double speed; // at the start
    double push;  // acceleration at the start, but for the damping
    double ramp;  // by which `push` grows, m/s^3

    [[nodiscard]] bool moves() const { return propagator != nullptr; }
    /// Whether it stays where it is under any kernel.
    [[nodiscard]] bool is_idle() const { return speed == 0.0 && push == 0.0 && ramp == 0.0; }
    [[nodiscard]] TrajectoryPoint at(const StepResponse& r) const
    {
        return {speed * r.step + push * r.push + ramp * r.ramp,
                speed * r.rate + push * r.step + ramp * r.push};
    }
    [[nodiscard]] TrajectoryPoint after(double time) const
    {
        return moves() ? at(propagator->after(time)) : TrajectoryPoint{};
    }
    [[nodiscard]] double acceleration(double time, const TrajectoryPoint& motion) const
    {
        if (!moves()) return 0.0;
        return push + ramp * time - propagator->oscillator.damping * motion.speed -
               propagator->oscillator.stiffness * motion.displacement;
    }
    [[nodiscard]] double jerk(double acceleration, double speed_then) const
    {
        if (!moves()) return 0.0;
        return ramp - propagator->oscillator.damping * acceleration -
               propagator->oscillator.stiffness * speed_then;
    }
};

/// What acceleration and its rate cannot exceed from a moment on for `time` seconds. Acceleration
/// a obeys the law without forces, a'' + damping a' + stiffness a = 0, whose energy a'^2 +
/// stiffness a^2 never grows.
struct Bounds {
    double acceleration;
    double jerk;
};

[[nodiscard]] inline Bounds bounds(const Propagator& propagator, double acceleration, double jerk,
                                   double time)
{
    const double most = std::abs(jerk) + propagator.frequency * std::abs(acceleration);
    return {std::abs(acceleration) + most * std::min(time, propagator.period), most};
}

} // namespace hapnet::scene
