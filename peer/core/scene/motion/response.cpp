// SPDX-FileCopyrightText: 2026 The Hapnet authors
// SPDX-License-Identifier: MIT
#include "peer/core/scene/motion/response.hpp"

#include "proto/base/math.hpp"

#include <algorithm>
#include <array>
#include <cmath>

namespace hapnet::scene {

namespace {

constexpr int terms_max = 28;

constexpr std::array<double, terms_max + 4> reciprocals = [] {
    std::array<double, terms_max + 4> r{};
    for (std::size_t n = 1; n < r.size(); ++n) r[n] = 1.0 / static_cast<double>(n);
    return r;
}();

/// Taylor's series, for damping * time <= 1 and stiffness * time^2 <= 1. With s_n = S^(n)(0):
/// s_0 = 0, s_1 = 1, s_(n+2) = -damping s_(n+1) - stiffness s_n; a term is s_n t^(n-1) / n!.
Response series(const Law& law, double t)
{
    const double b = law.damping * t;
    const double k = law.stiffness * t * t;
    double before = 0.0;
    double term = 1.0;
    Response sum{1.0, 1.0, 0.5, 1.0 / 6.0};
    for (std::size_t n = 2; n < terms_max; ++n) {
        const double next = -(b * term + k * before * reciprocals[n - 1]) * reciprocals[n];
        before = term;
        term = next;
        const double push = term * reciprocals[n + 1];
        sum.step += term;
        sum.rate += term * static_cast<double>(n);
        sum.push += push;
        sum.ramp += push * reciprocals[n + 2];
        if (std::abs(term) + std::abs(before) < 1e-18) break;
    }
    return {sum.rate, sum.step * t, sum.push * (t * t), sum.ramp * (t * t * t)};
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
