// SPDX-FileCopyrightText: 2026 The Hapnet authors
// SPDX-License-Identifier: MIT
#include "scene/maths/oscillator.hpp"

#include "proto/base/math.hpp"

#include <algorithm>
#include <array>
#include <cmath>

namespace hapnet::scene {

namespace {

constexpr std::array<double, 24> reciprocals = [] {
    std::array<double, 24> r{};
    for (std::size_t n = 1; n < r.size(); ++n) r[n] = 1.0 / static_cast<double>(n);
    return r;
}();

/// The values of 1/n!.
constexpr std::array<double, 24> inverse_factorials = [] {
    std::array<double, 24> all{1.0, 1.0};
    for (std::size_t n = 2; n < all.size(); ++n) all[n] = all[n - 1] / static_cast<double>(n);
    return all;
}();

/// The rate (n = 0), the step (1), the push (2), the ramp (3) and their further integrals, each in
/// units of time^n, follow from each other by the equation of motion: y_n = 1/n! - b y_(n+1) - k
/// y_(n+2) with b = damping time and k = stiffness time^2. From `last` on they are set to a free
/// body's 1/n!. Every step back from there reduces that error.
template <std::size_t last>
StepResponse series(double b, double k, double t)
{
    double ramp = inverse_factorials[last];
    double beyond = inverse_factorials[last + 1];
    const auto step_back = [&](std::size_t n, double next, double next_but_one) {
        return inverse_factorials[n] - k * next_but_one - b * next;
    };
    for (std::size_t n = last; n > 3; --n) {
        const double one = step_back(n - 1, ramp, beyond);
        beyond = ramp;
        ramp = one;
    }
    const double push = step_back(2, ramp, beyond);
    const double step = step_back(1, push, ramp);
    const double rate = step_back(0, step, push);
    const double square = t * t;
    return {rate, step * t, push * square, ramp * (square * t)};
}

/// Sums the series, for damping * time <= 1 and stiffness * time^2 <= 1. It has so many terms that
/// it omits less than 2e-17 of the free body's response.
StepResponse series(double b, double k, double t)
{
    return b <= 1.0 / 8.0 && k <= 1.0 / 32.0 ? series<12>(b, k, t) : series<19>(b, k, t);
}

/// The integrals of a decay: of exp(-rate t) once (1) and twice (2).
struct Decay {
    double value, once, twice;
};

Decay decay(double rate, double t)
{
    const double z = rate * t;
    if (z <= 1.0) {
        const StepResponse all = series(z, 0.0, t); // its step is the decay's integral
        return {all.rate, all.step, all.push};
    }
    const double value = base::exp(-std::min(z, 700.0));
    const double once = (1.0 - value) / rate;
    return {value, once, (t - once) / rate};
}

/// Two decays of clearly different rates, or one and a constant.
StepResponse overdamped(const Oscillator& oscillator, double half_width, double t)
{
    const double fast = 0.5 * oscillator.damping + half_width;
    const double slow = oscillator.stiffness / fast; // not the difference: it loses digits
    const Decay a = decay(slow, t);
    const Decay b = decay(fast, t);
    const double width = 2.0 * half_width;
    return {(fast * b.value - slow * a.value) / width, (a.value - b.value) / width,
            (a.once - b.once) / width, (a.twice - b.twice) / width};
}

/// The values cos(w t) and sin(w t) / w, or cosh and sinh where w^2 < 0, each times exp(-decay t).
struct Wave {
    double cosine, sine;
};

/// Computes the wave near w = 0, where cos and cosh meet, by their series, |w t| < 1.
Wave slow_wave(double decay, double square, double t)
{
    const double z = square * t * t;
    double cosine = 1.0;
    double sine = 1.0;
    double term = 1.0;
    for (std::size_t n = 1; n < 20; n += 2) {
        term *= -z * reciprocals[n] * reciprocals[n + 1];
        cosine += term;
        sine += term * reciprocals[n + 2];
    }
    const double fading = base::exp(-std::min(decay * t, 700.0));
    return {fading * cosine, fading * sine * t};
}

/// Computes the wave. `square` is w^2.
Wave wave(double decay, double square, double t)
{
    const double z = square * t * t;
    if (std::abs(z) < 1.0) return slow_wave(decay, square, t);
    if (z < 0.0) {
        const double w = std::sqrt(-square);
        const double slow = base::exp(-std::min((decay - w) * t, 700.0));
        const double fast = base::exp(-std::min((decay + w) * t, 700.0));
        return {0.5 * (slow + fast), 0.5 * (slow - fast) / w};
    }
    // base::sin accepts up to 1e6 rad; a larger angle is halved and doubled again.
    const double w = std::sqrt(square);
    double angle = w * t;
    int halvings = 0;
    for (; angle > 1e6; ++halvings) angle *= 0.5;
    double cosine = base::cos(angle);
    double sine = base::sin(angle);
    for (; halvings > 0; --halvings) {
        sine = 2.0 * sine * cosine;
        cosine = 2.0 * cosine * cosine - 1.0;
    }
    const double fading = base::exp(-std::min(decay * t, 700.0));
    return {fading * cosine, fading * sine / w};
}

} // namespace

StepResponse step_response(const Oscillator& oscillator, double time)
{
    const double b = oscillator.damping * time;
    const double k = oscillator.stiffness * time * time;
    if (time <= 0.0) return {};
    if (b <= 1.0 && k <= 1.0) return series(b, k, time);

    const double half = 0.5 * oscillator.damping;
    const double square = oscillator.stiffness - half * half; // the frequency squared
    if (square < -0.25 * half * half) return overdamped(oscillator, std::sqrt(-square), time);

    const Wave w = wave(half, square, time);
    StepResponse r;
    r.step = w.sine;
    r.rate = w.cosine - half * w.sine;
    r.push = (1.0 - r.rate - oscillator.damping * r.step) / oscillator.stiffness;
    r.ramp = (time - r.step - oscillator.damping * r.push) / oscillator.stiffness;
    return r;
}

} // namespace hapnet::scene
