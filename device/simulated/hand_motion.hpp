// SPDX-FileCopyrightText: 2026 The Hapnet authors
// SPDX-License-Identifier: MIT
#pragma once

#include "device/simulated/operator.hpp"

namespace hapnet::device {

/// One axis of a hand on a device.
struct HandAxis {
    double position_m = 0.0;
    double velocity_m_per_s = 0.0;
};

/// The inputs of an axis during a step: a constant force, and a target that moves at constant
/// speed.
struct HandDrive {
    double force_n = 0.0;
    double target_m = 0.0; // target at the start of the step
    double target_velocity_m_per_s = 0.0;
};

/// The response of a mass on a damped spring after a time: the contributions to x' and x of the
/// initial velocity, of the initial acceleration by spring and forces, and of the constant growth
/// of that acceleration. Exact for damping below, at and above the critical damping.
struct HandResponse {
    double position_by_velocity = 0.0;     // s
    double velocity_by_velocity = 1.0;     // no unit
    double position_by_acceleration = 0.0; // s^2; velocity_by_acceleration = position_by_velocity
    double position_by_jerk = 0.0;         // s^3; velocity_by_jerk = position_by_acceleration
};

/// The hand's motion along one axis, m x'' + b x' + k (x - target) = force + friction, in closed
/// form over a step. Coulomb friction keeps its sign until the motion ends. Then the hand sticks
/// while the pull is weaker than the friction (Karnopp 1985); otherwise it moves in the other
/// direction within the same step. At most one end of a motion in a step is computed, so steps must
/// be short compared with the hand's own periods.
class HandMotion {
public:
    /// Mass and stiffness must be above 0; damping and friction must not be negative.
    HandMotion(const HandImpedance& hand, double friction_n);

    /// Sets the length of the steps from now on. Costs an exponential and two sines, or nothing
    /// when the length has not changed.
    void set_step(double seconds);

    void advance(HandAxis& axis, const HandDrive& drive) const;

private:
    /// The acceleration of an axis whose friction keeps its sign, at the start of a step.
    struct Pull {
        double acceleration = 0.0; // due to spring, force and friction
        double jerk = 0.0;         // due to the target's motion
    };
    [[nodiscard]] static double velocity_after(const HandResponse& response, double velocity,
                                               const Pull& pull);
    static void move(HandAxis& axis, const HandResponse& response, const Pull& pull);

    [[nodiscard]] HandResponse response_after(double seconds) const;
    /// Returns the time in a step at which a motion ends whose velocity has the opposite sign at
    /// the step's end.
    [[nodiscard]] double rest_between(double velocity, double velocity_at_end,
                                      const Pull& pull) const;
    /// Starts the motion from rest, after a part of the step has passed.
    void start(HandAxis& axis, const HandDrive& drive, double passed) const;

    double half_damping_; // b / 2m, 1/s
    double stiffness_;    // k / m, 1/s^2
    double inverse_mass_; // 1/kg
    double friction_;     // c / m, m/s^2
    double step_s_ = 0.0; // length of the step that response_ is for
    HandResponse response_;
};

} // namespace hapnet::device
