// SPDX-FileCopyrightText: 2026 The Hapnet authors
// SPDX-License-Identifier: MIT
#include "device/simulated/hand_motion.hpp"

#include "proto/base/ensure.hpp"
#include "proto/base/math.hpp"

#include <algorithm>
#include <cmath>

namespace hapnet::device {

namespace {

/// cos(sqrt(z)) and sin(sqrt(z)) / sqrt(z); for z < 0 their hyperbolic continuations.
struct Swing {
    double even = 1.0;
    double odd = 1.0;
};

Swing swing_of(double z)
{
    constexpr double small = 1e-2; // the next terms of the series are below 1e-16
    if (std::abs(z) < small) {
        return {
            1.0 - z / 2.0 * (1.0 - z / 12.0 * (1.0 - z / 30.0 * (1.0 - z / 56.0 * (1 - z / 90)))),
            1.0 - z / 6.0 * (1.0 - z / 20.0 * (1.0 - z / 42.0 * (1.0 - z / 72.0 * (1 - z / 110))))};
    }
    if (z > 0.0) {
        const double angle = std::sqrt(z);
        return {base::cos(angle), base::sin(angle) / angle};
    }
    const double rate = std::sqrt(-z);
    const double up = base::exp(rate);
    const double down = base::exp(-rate);
    return {0.5 * (up + down), 0.5 * (up - down) / rate};
}

} // namespace

HandMotion::HandMotion(const HandImpedance& hand, double friction_n)
    : half_damping_{0.5 * hand.damping_ns_per_m / hand.mass_kg},
      stiffness_{hand.stiffness_n_per_m / hand.mass_kg},
      inverse_mass_{1.0 / hand.mass_kg},
      friction_{friction_n / hand.mass_kg}
{
    base::ensure(hand.mass_kg > 0.0 && hand.stiffness_n_per_m > 0.0 &&
                 hand.damping_ns_per_m >= 0.0 && friction_n >= 0.0);
}

double HandMotion::velocity_after(const HandResponse& response, double velocity, const Pull& pull)
{
    return response.velocity_by_velocity * velocity +
           response.position_by_velocity * pull.acceleration +
           response.position_by_acceleration * pull.jerk;
}

void HandMotion::move(HandAxis& axis, const HandResponse& response, const Pull& pull)
{
    const double velocity = axis.velocity_m_per_s;
    axis.velocity_m_per_s = velocity_after(response, velocity, pull);
    axis.position_m += response.position_by_velocity * velocity +
                       response.position_by_acceleration * pull.acceleration +
                       response.position_by_jerk * pull.jerk;
}

void HandMotion::set_step(double seconds)
{
    if (seconds == step_s_) return;
    step_s_ = seconds;
    response_ = response_after(seconds);
}

HandResponse HandMotion::response_after(double seconds) const
{
    // x'' + 2 h x' + w x = 0 from rest at speed 1: exp(-h t) sin(f t) / f with f^2 = w - h^2. Its
    // integrals follow from the equation.
    const double fade = base::exp(-half_damping_ * seconds);
    const Swing swing = swing_of((stiffness_ - half_damping_ * half_damping_) * seconds * seconds);
    HandResponse response;
    response.position_by_velocity = fade * seconds * swing.odd;
    response.velocity_by_velocity = fade * (swing.even - half_damping_ * seconds * swing.odd);
    response.position_by_acceleration = (1.0 - response.velocity_by_velocity -
                                         2.0 * half_damping_ * response.position_by_velocity) /
                                        stiffness_;
    response.position_by_jerk = (seconds - response.position_by_velocity -
                                 2.0 * half_damping_ * response.position_by_acceleration) /
                                stiffness_;
    return response;
}

void HandMotion::advance(HandAxis& axis, const HandDrive& drive) const
{
    if (axis.velocity_m_per_s == 0.0) return start(axis, drive, 0.0);
    const Pull pull{drive.force_n * inverse_mass_ -
                        stiffness_ * (axis.position_m - drive.target_m) -
                        std::copysign(friction_, axis.velocity_m_per_s),
                    stiffness_ * drive.target_velocity_m_per_s};
    const double velocity = velocity_after(response_, axis.velocity_m_per_s, pull);
    if (velocity * axis.velocity_m_per_s > 0.0) return move(axis, response_, pull);
    const double rest = rest_between(axis.velocity_m_per_s, velocity, pull);
    move(axis, response_after(rest), pull);
    axis.velocity_m_per_s = 0.0;
    start(axis, drive, rest);
}

double HandMotion::rest_between(double velocity, double velocity_at_end, const Pull& pull) const
{
    // The velocity is almost straight over a step: three false positions leave 1e-6 of the step.
    double low = 0.0;
    double high = step_s_;
    double above = velocity;
    double below = velocity_at_end;
    double time = high;
    for (int round = 0; round < 3; ++round) {
        time = low + (high - low) * above / (above - below);
        const double at_time = velocity_after(response_after(time), velocity, pull);
        if (at_time * velocity > 0.0) {
            low = time;
            above = at_time;
        } else {
            high = time;
            below = at_time;
        }
    }
    return time;
}

void HandMotion::start(HandAxis& axis, const HandDrive& drive, double passed) const
{
    const double target = drive.target_m + passed * drive.target_velocity_m_per_s;
    const double jerk = stiffness_ * drive.target_velocity_m_per_s;
    const double left = step_s_ - passed;
    const double pull = drive.force_n * inverse_mass_ - stiffness_ * (axis.position_m - target);
    const double at_end = pull + left * jerk;
    if (std::abs(pull) > friction_) {
        const double direction = std::copysign(1.0, pull);
        move(axis, passed == 0.0 ? response_ : response_after(left),
             {pull - direction * friction_, jerk});
        if (axis.velocity_m_per_s * direction < 0.0) axis.velocity_m_per_s = 0.0;
    } else if (std::abs(at_end) > friction_) {
        // The target draws away until the pull is as strong as the friction.
        const double holds = (std::copysign(friction_, at_end) - pull) / jerk;
        move(axis, response_after(left - holds), {0.0, jerk});
    }
}

} // namespace hapnet::device
