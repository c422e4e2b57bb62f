// SPDX-FileCopyrightText: 2026 The Hapnet authors
// SPDX-License-Identifier: MIT
#pragma once

#include "device/simulated/operator.hpp"
#include "device/simulated/signal_history.hpp"

#include <optional>

namespace hapnet::device {

/// A hand's perception at a moment.
struct Perception {
    glm::dvec3 deviation{0.0};        // of the hand from its intention, m
    double pressing_n = 0.0;          // force with which the hand presses
    std::optional<double> wanted_n{}; // force with which it wants to press; nullopt: any
    /// The task's aim along the direction toward the body, metres, while the hand searches;
    /// nullopt: it does not search.
    std::optional<double> aim_m{};
};

/// The reaction of the person.
struct Reaction {
    glm::dvec3 force{0.0};  // force of the stretch reflex, N
    double farther_m = 0.0; // additional distance by which the hand intends to press, m
};

/// A simulated person's stretch reflex, intent and search. Costs nothing for an operator without
/// them.
class Reactions {
public:
    explicit Reactions(const Operator& person) : person_{person} {}

    /// Returns the reaction. Call it once per read; `now` never runs backwards.
    [[nodiscard]] Reaction to(const Perception& felt, base::TimePoint now, base::Duration elapsed);

private:
    [[nodiscard]] double farther(const Perception& felt, base::TimePoint now,
                                 base::Duration elapsed);

    /// Returns the additional distance of the hand in search of the body, m.
    [[nodiscard]] double ahead(const Perception& felt, base::TimePoint now, base::Duration elapsed);

    Operator person_;
    SignalHistory stretched_;
    SignalHistory missed_;
    double missing_n_ = 0.0; // smoothed lack of pressing force
    double farther_m_ = 0.0;
    base::Duration smoothed_over_{}; // time step for which smoothing_keeps_ was computed
    double smoothing_keeps_ = 1.0;
    double ahead_m_ = 0.0;
    std::optional<base::TimePoint> untouched_since_;
    std::optional<double> aim_m_; // Perception::aim_m in the last call
};

} // namespace hapnet::device
