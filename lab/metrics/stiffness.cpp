// SPDX-FileCopyrightText: 2026 The Hapnet authors
// SPDX-License-Identifier: MIT
#include "lab/metrics/stiffness.hpp"

#include "lab/metrics/ticks.hpp"
#include "proto/base/math.hpp"

#include <algorithm>
#include <cmath>
#include <cstddef>

namespace hapnet::lab::metrics {

namespace {

constexpr double amplitude_min_m = 10e-6;

/// A rotating pointer: cosine and sine, each step a rotation by the same angle. That costs a tenth
/// of the functions themselves, and its error grows by about 1e-16 per step.
struct Pointer {
    double c = 1.0;
    double s = 0.0;

    void turn(const Pointer& by)
    {
        const double next = c * by.c - s * by.s;
        s = s * by.c + c * by.s;
        c = next;
    }
};

/// A signal's part at the pointer's frequency.
struct SignalPart {
    double c = 0.0;
    double s = 0.0;

    void add(double value, const Pointer& at)
    {
        c += value * at.c;
        s += value * at.s;
    }
};

} // namespace

std::optional<DynamicStiffness> stiffness_of(std::span<const double> force_on_hand,
                                             std::span<const double> hip, double hertz,
                                             double tick_s)
{
    const std::size_t given = std::min(force_on_hand.size(), hip.size());
    const double periods = std::floor(static_cast<double>(given) * tick_s * hertz + 1e-9);
    if (periods < 1.0) return std::nullopt;
    const auto count = std::min(given, ticks_in(periods / hertz, tick_s));
    const auto force = force_on_hand.subspan(force_on_hand.size() - count);
    const auto place = hip.subspan(hip.size() - count);

    const double angle = base::two_pi * hertz * tick_s;
    const Pointer by{base::cos(angle), base::sin(angle)};
    Pointer at;
    SignalPart force_part, place_part;
    for (std::size_t i = 0; i < count; ++i) {
        // Values are relative to the first one: the constant part is far larger than the
        // oscillating part.
        force_part.add(force[i] - force[0], at);
        place_part.add(place[i] - place[0], at);
        at.turn(by);
    }
    const double square = place_part.c * place_part.c + place_part.s * place_part.s;
    const double amplitude = 2.0 * std::sqrt(square) / static_cast<double>(count);
    if (!(amplitude >= amplitude_min_m)) return std::nullopt;
    return DynamicStiffness{
        .storage_n_per_m = -(force_part.c * place_part.c + force_part.s * place_part.s) / square,
        .loss_n_per_m = (force_part.s * place_part.c - force_part.c * place_part.s) / square};
}

} // namespace hapnet::lab::metrics
