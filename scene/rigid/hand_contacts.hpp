// SPDX-FileCopyrightText: 2026 The Hapnet authors
// SPDX-License-Identifier: MIT
#pragma once

#include "scene/bounded.hpp"
#include "scene/collide/sphere_box.hpp"
#include "scene/hand/advance.hpp"
#include "scene/state.hpp"

#include <array>
#include <optional>
#include <span>

namespace hapnet::scene {

/// Bodies that one hand touches at the same time, at most; those with the lowest ids.
inline constexpr std::size_t touched_per_hand_max = 8;

/// The hands' springs of one tick, and what has to be remembered of whom they touch.
class HandContacts {
public:
    explicit HandContacts(const WorldConfig& config);

    /// A hand's spring on a movable body.
    struct Spring {
        std::uint32_t hand = 0;
        BodyId body = 0;
        glm::dvec3 impulse{0.0}; // on the body
    };

    /// Begins a tick: whom did the hands touch, nobody.
    void begin_step(const WorldConfig& config, WorldState& state);

    /// Where a body is and how it moves.
    struct Target {
        BodyId body = 0;
        bool is_movable = false;
        const OrientedBox& box;
        glm::dvec3 velocity{0.0};
        glm::dvec3 spin{0.0};
    };
    /// Sees what the hand does to one of the bodies that it may reach.
    void collide(const WorldConfig& config, WorldState& state, std::uint32_t hand,
                 const Target& target);
    /// Forgets whom the hand has left.
    void forget_departed(std::uint32_t index);

    [[nodiscard]] std::span<const Spring> springs() const { return springs_.all(); }
    /// Those on one body, and where they tell their work; until the next question.
    struct BodySprings {
        std::span<const HandSpring> springs;
        std::span<SpringImpulse> work;
    };
    [[nodiscard]] BodySprings springs_on(BodyId body);
    /// Takes what was told for them.
    void store_impulses(BodyId body);
    /// Tells the hands what the springs did.
    void report_forces(const WorldConfig& config, WorldState& state);

    void forget(BodyId body);

private:
    /// What of a body near a hand is remembered.
    struct NearBody {
        BodyId body = 0;
        bool is_current = false; // in this tick
        SphereBoxMemory memory;
        std::optional<glm::dvec3> before{}; // the hand in the body's frame, a tick ago
    };
    struct Holding {
        BodyId body = 0;
        glm::dvec3 at{0.0}; // in the body's frame
    };
    struct Hand {
        std::array<NearBody, touched_per_hand_max> nearby;
        std::size_t count = 0;
        std::optional<Holding> holding;
    };

    HandSpring& add(std::uint32_t hand, BodyId body);
    bool add_grip(const WorldConfig& config, WorldState& state, std::uint32_t index,
                  const Target& target);
    void add_push(const WorldConfig& config, WorldState& state, std::uint32_t index,
                  const Target& target);
    [[nodiscard]] NearBody* find_near(Hand& hand, BodyId body);

    std::array<Hand, hands_max> hands_;
    double gravity_reach_; // what gravity adds to a way in a tick from rest, twice, metres
    Scratch<Spring> springs_;
    Scratch<HandSpring> forces_;  // in the order of springs_
    Scratch<HandSpring> own_;     // of one body
    Scratch<SpringImpulse> work_; // of one body
};

} // namespace hapnet::scene
