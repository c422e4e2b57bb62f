// SPDX-FileCopyrightText: 2026 The Hapnet authors
// SPDX-License-Identifier: MIT
#include "scene/hand/pressed_modes.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

namespace hapnet::scene {

namespace {

constexpr std::size_t terms_max = 24;

} // namespace

void PressedModes::renew(const Key& key)
{
    key_ = key;
    half_square_ = 0.5 * key.tick * key.tick;
    // Jacobi's rotation makes the matrix diagonal.
    const double apart = key.own[1] - key.own[0];
    double tangent = 0.0;
    if (key.mutual != 0.0) {
        const double ratio = apart / (2.0 * key.mutual);
        tangent = std::copysign(1.0, ratio) / (std::abs(ratio) + std::sqrt(1.0 + ratio * ratio));
    }
    cosine_ = 1.0 / std::sqrt(1.0 + tangent * tangent);
    const double sine = tangent * cosine_;
    sine_ = Two{sine, -sine};
    // Where the terms cancel, rounding must not leave a negative response: no force amplifies
    // itself.
    const double shift = tangent * key.mutual;
    response_ = Two{std::max(0.0, key.own[0] - shift), std::max(0.0, key.own[1] + shift)};
    Mode a, b;
    is_short_ = set(a, response_[0]) && set(b, response_[1]);
    once_ = Two{a.once, b.once};
    twice_ = Two{a.twice, b.twice};
    thrice_ = Two{a.thrice, b.thrice};
    change_by_speed_ = Two{a.change_by_speed, b.change_by_speed};
    change_by_left_ = Two{a.change_by_left, b.change_by_left};
}

/// Sets the integrals of a mode. With y_n = y^(n)(0) tick^n / n! and f_n defined the same way,
/// y_(n+2) = -tick^2 response f_n / ((n+1) (n+2)). The integrals of the force are the sums of f_n
/// over n+1, over (n+1) (n+2), and so on.
bool PressedModes::set(Mode& mode, double response) const
{
    const double tick = key_.tick;
    const double damping = key_.damping / tick;
    const double stiff = tick * tick * response;
    constexpr double slow = 1.0;
    if (!(stiff * (key_.stiffness + damping) <= slow)) return false;
    constexpr double rounding = 1e-16; // the terms after two such terms are less
    double y = 0.0, next = tick;
    double last = 0.0;
    for (std::size_t n = 0; n < terms_max; ++n) {
        const double one = static_cast<double>(n + 1);
        const double force = key_.stiffness * y + damping * one * next;
        const double once = force / one;
        const double twice = once / (one + 1.0);
        mode.once += once;
        mode.twice += twice;
        mode.thrice += twice / (one + 2.0);
        if (n > 0) mode.change_by_speed += std::abs(force);
        mode.change_by_left += std::abs(once);
        const double now = std::abs(force);
        if (n > 0 && now + last <= rounding * mode.change_by_speed) {
            mode.once *= tick;
            mode.twice *= tick * tick;
            mode.thrice *= tick * tick * tick;
            mode.change_by_left *= tick;
            return true;
        }
        last = now;
        y = std::exchange(next, -stiff * twice);
    }
    return false;
}

} // namespace hapnet::scene
