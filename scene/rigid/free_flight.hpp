// SPDX-FileCopyrightText: 2026 The Hapnet authors
// SPDX-License-Identifier: MIT
#pragma once

#include "scene/state.hpp"

#include <vector>

namespace hapnet::scene {

/// Bodies that lie one after the other.
struct SlotRange {
    Slot begin = 0;
    Slot end = 0;
};

/// Moves bodies by one tick under one acceleration: parabolas, exact.
void integrate_parabola(Bodies& bodies, SlotRange range, const glm::dvec3& acceleration,
                        double tick);

/// Turns bodies by one tick about the axis of their angular momentum, exactly. For those that turn
/// evenly: with three equal moments of inertia, or about one axis of the world. What does not turn
/// keeps its orientation to the last bit.
void rotate_uniformly(Bodies& bodies, SlotRange range, double tick);

/// Whether a body turns evenly, or not at all.
[[nodiscard]] bool rotates_uniformly(const BodyProperties& properties);

/// Turns one body of any kind by one tick in which nothing touches it.
void rotate_freely(Bodies& bodies, Slot slot, double tick);

/// Gravity on what of a body is not locked.
[[nodiscard]] glm::dvec3 gravity_on(const BodyProperties& properties, const glm::dvec3& gravity);

/// Moves bodies that nothing touches, whatever their kinds: many at once when all movable bodies of
/// the scene turn evenly and fall alike, else one by one.
class FreeBodies {
public:
    FreeBodies(const WorldConfig& config, const Bodies& bodies);

    void integrate(Bodies& bodies, SlotRange range) const;

private:
    double tick_;
    glm::dvec3 gravity_;
    glm::dvec3 acceleration_{0.0}; // of all, when they are alike
    bool are_alike_ = true;
};

/// Bodies that nothing touches: exact parabolas, and rotations that keep the angular momentum.
class FreeFlightStepper {
public:
    FreeFlightStepper(const Description& description, const WorldConfig& config,
                      const WorldState& state);

    void step(const WorldConfig& config, WorldState& state);
    void on_body_placed(WorldState& state, BodyId body);

private:
    /// Bodies side by side that are alike in what keeps them from turning and falling.
    enum class Kind : std::uint8_t { locked, uniform, tumbling };
    struct Run {
        Kind kind = Kind::locked;
        SlotRange range;
        glm::dvec3 acceleration{0.0};
    };

    std::vector<Run> runs_;
};

} // namespace hapnet::scene
