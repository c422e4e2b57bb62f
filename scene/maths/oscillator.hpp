// SPDX-FileCopyrightText: 2026 The Hapnet authors
// SPDX-License-Identifier: MIT
#pragma once

#include <algorithm>
#include <cmath>
#include <limits>

namespace hapnet::scene {

/// A damped oscillator: x'' = A + R t - damping x' - stiffness x, per unit of mass. Without damping
/// and stiffness its motion is a parabola, without stiffness an exponential, otherwise an under-,
/// critically or over-damped oscillation.
struct Oscillator {
    double damping = 0.0;   // 1/s, >= 0
    double stiffness = 0.0; // 1/s^2, >= 0
};

/// The response of an oscillator that rests at 0, at one moment t. `step` is its displacement S(t)
/// after a kick of speed 1; `rate` is S'. `push` is the integral of S, the response to a steady
/// acceleration of 1. `ramp` is the integral of `push`, the response to an acceleration that grows
/// by 1 per second. Every linear response is a sum of these. No equilibrium is subtracted, so
/// nothing is lost where stiffness or damping is small.
struct StepResponse {
    double rate = 1.0;
    double step = 0.0;
    double push = 0.0;
    double ramp = 0.0;
};

/// Returns the response after `time` >= 0 seconds. Its error is within 2e-14, relative to the
/// response of a free body (1, t, t^2/2, t^3/6), for stiffness time^2 up to 1e5. Beyond that the
/// phase itself is known only to its rounding, 1e-16 of the angle.
[[nodiscard]] StepResponse step_response(const Oscillator& oscillator, double time);

/// An oscillator with its response at the end of a tick, which most ticks need.
struct Propagator {
    Oscillator oscillator;
    double frequency = 0.0; // angular frequency without damping, 1/s
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

/// The displacement of a coordinate since the start, and its speed.
struct TrajectoryPoint {
    double displacement = 0.0;
    double speed = 0.0;
};

/// A coordinate's motion in closed form from a moment on: x'' = push + ramp t - damping x' -
/// stiffness x. A trajectory without a propagator stays where it is.
struct Trajectory {
    const Propagator* propagator;
    double speed; // at the start
    double push;  // acceleration at the start, without the damping's part
    double ramp;  // rate at which `push` grows, m/s^3

    [[nodiscard]] bool moves() const { return propagator != nullptr; }
    /// True if the coordinate stays where it is, whatever the propagator is.
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

/// The greatest acceleration, and its greatest rate, for `time` seconds from a moment on. The
/// acceleration a obeys the oscillator without forces, a'' + damping a' + stiffness a = 0, whose
/// energy a'^2 + stiffness a^2 never grows.
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
