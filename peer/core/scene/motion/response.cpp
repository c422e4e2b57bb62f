// SPDX-FileCopyrightText: 2026 The Hapnet authors
// SPDX-License-Identifier: MIT
#include "peer/core/scene/motion/response.hpp"

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

constexpr std::array<double, 24> reciprocal_pairs = [] { // of n (n + 1)
    std::array<double, 24> r{};
    for (std::size_t n = 1; n < r.size(); ++n) r[n] = 1.0 / static_cast<double>(n * (n + 1));
    return r;
}();

/// Relative to those of a free body (1, t, t^2/2, t^3/6), the rate (n = 1), the step (2), the push
/// (3), the ramp (4) and their further integrals are tied to each other by the law itself:
/// y_n = 1 - b/n y_(n+1) - k/(n (n+1)) y_(n+2) with b = damping t and k = stiffness t^2. Beyond
/// `last` they are taken as 1; every step back from there divides that error.
template <std::size_t last>
Response series(double b, double k, double t)
{
    static_assert(last < reciprocals.size());
    const auto y = [&](std::size_t n, double next, double next_but_one) {
        return 1.0 - k * reciprocal_pairs[n] * next_but_one - b * reciprocals[n] * next;
    };
    double next_but_one = 1.0;
    double next = 1.0;
    for (std::size_t n = last; n > 4; --n) {
        const double one = y(n, next, next_but_one);
        next_but_one = next;
        next = one;
    }
    const double ramp = y(4, next, next_but_one);
    const double push = y(3, ramp, next);
    const double step = y(2, push, ramp);
    return {y(1, step, push), step * t, push * (0.5 * t * t), ramp * (t * t * t * (1.0 / 6.0))};
}

/// For damping * time <= 1 and stiffness * time^2 <= 1.
Response series(const Law& law, double t)
{
    const double b = law.damping * t;
    const double k = law.stiffness * t * t;
    // So many that what is left out is below 2e-17.
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
        const Response all = series({.damping = rate}, t); // its step is the decay's integral
        return {all.rate, all.step, all.push};
    }
    const double value = base::exp(-std::min(z, 700.0));
    const double once = (1.0 - value) / rate;
    return {value, once, (t - once) / rate};
}

/// Two decays of clearly different rates, or one and a constant.
Response overdamped(const Law& law, double half_width, double t)
{
    const double fast = 0.5 * law.damping + half_width;
    const double slow = law.stiffness / fast; // not the difference: it loses digits
    const Decay a = decay(slow, t);
    const Decay b = decay(fast, t);
    const double width = 2.0 * half_width;
    return {(fast * b.value - slow * a.value) / width, (a.value - b.value) / width,
            (a.once - b.once) / width, (a.twice - b.twice) / width};
}

/// cos(w t) and sin(w t) / w, or cosh and sinh where w^2 < 0, both times exp(-decay t).
struct Wave {
    double cosine, sine;
};

/// Where cos and cosh meet: by their series, |w t| < 1.
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

/// `square` is w^2.
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
    // base::sin takes up to 1e6 rad; what is beyond is halved and doubled again.
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

Response respond(const Law& law, double time)
{
    const double b = law.damping * time;
    const double k = law.stiffness * time * time;
    if (time <= 0.0) return {};
    if (b <= 1.0 && k <= 1.0) return series(law, time);

    const double half = 0.5 * law.damping;
    const double square = law.stiffness - half * half; // of the frequency
    if (square < -0.25 * half * half) return overdamped(law, std::sqrt(-square), time);

    const Wave w = wave(half, square, time);
    Response r;
    r.step = w.sine;
    r.rate = w.cosine - half * w.sine;
    r.push = (1.0 - r.rate - law.damping * r.step) / law.stiffness;
    r.ramp = (time - r.step - law.damping * r.push) / law.stiffness;
    return r;
}

} // namespace hapnet::scene
