// SPDX-FileCopyrightText: 2026 The Hapnet authors
// SPDX-License-Identifier: MIT
#pragma once

namespace hapnet::scene {

/// What pulls a coordinate back: x'' = A + R t - damping x' - stiffness x, per unit of mass. Both
/// may be 0: a parabola; without stiffness: an exponential; otherwise an oscillator, under-,
/// critically or over-damped.
struct Oscillator {
    double damping = 0.0;   // 1/s, >= 0
    double stiffness = 0.0; // 1/s^2, >= 0
};

/// How a coordinate that rests at 0 answers under a law, at one moment t: `step` is where it is
/// after a kick of speed 1, S(t); `rate` is S'; `push` the integral of S, the answer to a steady
/// acceleration of 1; `ramp` the integral of that, the answer to one that grows by 1 per second.
/// Everything linear follows by adding: no equilibrium is subtracted, so nothing is lost where
/// stiffness or damping is small.
struct StepResponse {
    double rate = 1.0;
    double step = 0.0;
    double push = 0.0;
    double ramp = 0.0;
};

/// The response after `time` >= 0 seconds. Within 2e-14 of the true values, relative to those of a
/// free body (1, t, t^2/2, t^3/6), for stiffness time^2 up to 1e5; beyond that the phase itself is
/// only known to its rounding, 1e-16 of the angle.
[[nodiscard]] StepResponse step_response(const Oscillator& oscillator, double time);

} // namespace hapnet::scene
