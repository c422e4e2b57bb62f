// SPDX-FileCopyrightText: 2026 The Hapnet authors
// SPDX-License-Identifier: MIT
#pragma once

#include "scene/bounded.hpp"
#include "scene/state.hpp"

#include <algorithm>
#include <vector>

namespace hapnet::scene {

/// Bodies in neighbouring slots.
struct SlotRange {
    Slot begin = 0;
    Slot end = 0;
};

/// Moves bodies by one tick under one acceleration: parabolas, exact.
void integrate_parabola(Bodies& bodies, SlotRange range, const glm::dvec3& acceleration,
                        double tick);

/// Turns bodies by one tick about the axis of their angular momentum, exactly. The bodies must turn
/// evenly: with three equal moments of inertia, or about one axis of the world. A body that does
/// not turn keeps its orientation to the last bit.
void rotate_uniformly(Bodies& bodies, SlotRange range, double tick);

/// True if a body turns evenly, or not at all.
[[nodiscard]] bool rotates_uniformly(const BodyProperties& properties);

/// Turns one body of any kind by one tick in which nothing touches it.
void rotate_freely(Bodies& bodies, Slot slot, double tick);

/// The gravity along the axes in which the body is not locked.
[[nodiscard]] glm::dvec3 gravity_on(const BodyProperties& properties, const glm::dvec3& gravity);

/// Moves bodies of any kind that nothing touches. It moves many at once when all movable bodies of
/// the scene turn evenly and fall equally, otherwise one by one.
class FreeBodies {
public:
    FreeBodies(const WorldConfig& config, const Bodies& bodies);

    void integrate(Bodies& bodies, SlotRange range) const;

private:
    double tick_;
    glm::dvec3 gravity_;
    glm::dvec3 acceleration_{0.0}; // of every movable body, if are_alike_
    bool are_alike_ = true;
};

/// Steps bodies that nothing touches: exact parabolas, and rotations that keep the angular
/// momentum.
class FreeFlightStepper {
public:
    FreeFlightStepper(const Description& description, const WorldConfig& config,
                      const WorldState& state);

    void step(const WorldConfig& config, WorldState& state);
    void on_body_placed(WorldState& state, BodyId body);
    void on_body_shifted(WorldState& state, BodyId body);
    [[nodiscard]] TickCost tick_cost_bound(const WorldConfig& /*config*/) const { return {}; }

private:
    /// Kinds of bodies. Neighbouring bodies of one kind are moved together.
    enum class Kind : std::uint8_t { locked, uniform, tumbling };
    struct Run {
        Kind kind = Kind::locked;
        SlotRange range;
        glm::dvec3 acceleration{0.0};
    };

    static void rotate(Bodies& bodies, const Run& run, double tick);
    static void apply_push(WorldState& state, BodyId body, double tick);
    static void apply_half_torque(WorldState& state, BodyId body, double tick);

    std::vector<Run> runs_;
};

/// The active bodies: awake ones on which a contact, a hand or a push acts in the tick. The others
/// fly.
class ActiveBodies {
public:
    explicit ActiveBodies(Slot movable) : slots_{movable}, marks_(movable, 0) {}

    /// Adds a body. Returns true if it was not one of them before.
    bool add(Slot slot)
    {
        if (marks_[slot] != 0) return false;
        marks_[slot] = 1;
        slots_.add(slot);
        return true;
    }
    void clear()
    {
        for (const Slot slot : slots_) marks_[slot] = 0;
        slots_.clear();
    }

    [[nodiscard]] bool contains(Slot slot) const { return marks_[slot] != 0; }

    /// Returns the slots in the order in which they were added.
    [[nodiscard]] std::span<const Slot> slots() const { return slots_.all(); }

    /// Calls visit(range) for all ranges of other slots up to `end`.
    template <typename Visit>
    void for_inactive(Slot end, Visit solve_block) const
    {
        const auto first = marks_.begin();
        const auto last = first + end;
        for (auto from = std::find(first, last, 0); from != last;) {
            const auto to = std::find(from, last, 1);
            solve_block(SlotRange{static_cast<Slot>(from - first), static_cast<Slot>(to - first)});
            from = std::find(to, last, 0);
        }
    }

private:
    Bounded<Slot> slots_;
    std::vector<std::uint8_t> marks_; // by slot
};

} // namespace hapnet::scene
