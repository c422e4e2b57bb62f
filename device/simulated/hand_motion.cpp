// SPDX-FileCopyrightText: 2026 The Hapnet authors
// SPDX-License-Identifier: MIT
#include "device/simulated/hand_motion.hpp"

#include "proto/base/ensure.hpp"
#include "proto/base/math.hpp"

#include <algorithm>
#include <cmath>

namespace hapnet::device {

namespace {

/// exp(-decay) times cos(sqrt(z)) and sin(sqrt(z)) / sqrt(z), z = spring - decay^2. For z < 0 they
/// are the hyperbolic continuations, without overflow and without a difference of large numbers.
struct Swing {
    double even = 1.0;
    double odd = 1.0;
};

Swing swing_of(double spring, double decay)
{
    const double z = spring - decay * decay;
    constexpr double small = 1e-2; // the next terms of the series are below 1e-16
    if (z < -small) {
        const double rate = std::sqrt(-z);
        const double slow = base::exp(-spring / (rate + decay)); // exp(rate - decay)
        const double fast = base::exp(-rate - decay);
        return {0.5 * (slow + fast), 0.5 * (slow - fast) / rate};
    }
    const double fade = base::exp(-decay);
    if (z > small) {
        const double angle = std::sqrt(z);
        return {fade * base::cos(angle), fade * base::sin(angle) / angle};
    }
    const double even =
        1.0 - z / 2.0 * (1.0 - z / 12.0 * (1.0 - z / 30.0 * (1.0 - z / 56.0 * (1.0 - z / 90.0))));
    const double odd =
        1.0 - z / 6.0 * (1.0 - z / 20.0 * (1.0 - z / 42.0 * (1.0 - z / 72.0 * (1.0 - z / 110.0))));
    return {fade * even, fade * odd};
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
    const double decay = half_damping_ * seconds;
    const Swing swing = swing_of(stiffness_ * seconds * seconds, decay);
    HandResponse response;
    response.position_by_velocity = seconds * swing.odd;
    response.velocity_by_velocity = swing.even - decay * swing.odd;
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
    const bool passes_rest = velocity * axis.velocity_m_per_s <= 0.0 && friction_ > 0.0;
    if (!passes_rest) return move(axis, response_, pull);
    const double rest = rest_between(axis.velocity_m_per_s, velocity, pull);
    move(axis, response_after(rest), pull);
    axis.velocity_m_per_s = 0.0;
    start(axis, drive, rest);
}

double HandMotion::rest_between(double velocity, double velocity_at_end, const Pull& pull) const
{
    // The velocity is almost linear over a step, so this is the method of false position. Where the
    // velocity is not linear, the end that stays counts half (Dowell, Jarratt 1971).
    constexpr int rounds_max = 8;
    const double enough = 1e-9 * std::abs(velocity);
    double low = 0.0;
    double high = step_s_;
    double above = velocity;
    double below = velocity_at_end;
    double time = high;
    bool was_above = false;
    for (int round = 0; round < rounds_max; ++round) {
        time = low + (high - low) * above / (above - below);
        const double at_time = velocity_after(response_after(time), velocity, pull);
        if (std::abs(at_time) <= enough) break;
        const bool is_above = at_time * velocity > 0.0;
        (is_above ? low : high) = time;
        (is_above ? above : below) = at_time;
        if (round > 0 && is_above == was_above) (is_above ? below : above) *= 0.5;
        was_above = is_above;
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
        // The target moves away until the pull is as strong as the friction.
        const double holds = (std::copysign(friction_, at_end) - pull) / jerk;
        move(axis, response_after(left - holds), {0.0, jerk});
    }
}

} // namespace hapnet::device
