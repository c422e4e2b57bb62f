// SPDX-FileCopyrightText: 2026 The Hapnet authors
// SPDX-License-Identifier: MIT
#pragma once

#include "peer/core/scene/stage.hpp"

#include <span>
#include <vector>

namespace hapnet::scene {

/// Bodies that lie one after the other.
struct SlotRange {
    Slot begin = 0;
    Slot end = 0;
};

/// Moves bodies by one tick under one acceleration: parabolas, exact.
void fall(Bodies& bodies, SlotRange range, const glm::dvec3& acceleration, double tick);

/// Turns bodies by one tick about the axis of their angular momentum, exactly. For those that turn
/// evenly: with three equal moments of inertia, or about one axis of the world. `inverse_inertia`
/// about that axis is by slot.
void turn_evenly(Bodies& bodies, SlotRange range, std::span<const double> inverse_inertia,
                 double tick);

/// Whether a body turns evenly, or not at all.
[[nodiscard]] bool turns_evenly(const BodyForm& form);

/// The inverse inertia of a body that turns evenly, about whatever axis it turns; 0 when it cannot.
[[nodiscard]] double even_inverse_inertia(const BodyForm& form);

/// Turns one body of any kind by one tick in which nothing touches it.
void turn_freely(Bodies& bodies, Slot slot, double tick);

/// Gravity on what of a body is not locked.
[[nodiscard]] glm::dvec3 falling(const BodyForm& form, const glm::dvec3& gravity);

/// Bodies that nothing touches: exact parabolas, and rotations that keep the angular momentum.
class FlightTick {
public:
    FlightTick(const Description& description, const Frozen& frozen, const Stage& stage);

    void tick(const Frozen& frozen, Stage& stage);
    void disturbed(Stage& stage, BodyId body);

private:
    /// Bodies side by side that are alike in what keeps them from turning and falling.
    enum class Kind : std::uint8_t { locked, even, wobbling };
    struct Run {
        Kind kind = Kind::locked;
        SlotRange range;
        glm::dvec3 acceleration{0.0};
    };

    std::vector<Run> runs_;
    std::vector<double> inverse_inertia_; // by slot, of those that turn evenly
};

} // namespace hapnet::scene
