// SPDX-FileCopyrightText: 2026 The Hapnet authors
// SPDX-License-Identifier: MIT
#pragma once

#include "scene/bodies.hpp"
#include "scene/bounded.hpp"
#include "scene/collide/internal_faces.hpp"
#include "scene/tick_cost.hpp"

#include <algorithm>
#include <array>
#include <cstdint>
#include <utility>
#include <vector>

namespace hapnet::scene {

/// The place of a hand at the start of a tick. During the tick the hand moves on at its velocity
/// (first-order hold), so that a steady push has no lag of one tick.
struct HandInput {
    base::Position position{};
    base::Velocity velocity{};
    bool present = true; // false: it touches nothing
    bool gripping = false;
};

/// The contact of a hand and the force on it in the last tick.
struct HandTouch {
    bool touching = false; // pushed or held a movable body
    bool holding = false;
    BodyId body = 0;                // the movable body that it touched
    base::Force on_body{};          // mean force on that body over the tick
    base::Force on_hand{};          // mean force on the hand over the tick, by all touched things
    double depth_m = 0.0;           // depth of the deepest contact at the start of the tick
    base::Force on_hand_at_start{}; // force of springs and dampers at the start of the tick
};

/// The springs of each hand on each body, where the springs are not all equal; otherwise empty.
class HandFeels {
public:
    HandFeels() = default;
    explicit HandFeels(const Description& description);

    [[nodiscard]] const HandDescription& of(std::uint32_t hand, BodyId body,
                                            const HandDescription& alike) const
    {
        return kind_of_.empty() ? alike : kinds_[kind_of_[body] + hand];
    }

    /// Returns the hand's properties on things without a Feel of their own, such as planes.
    [[nodiscard]] const HandDescription& of(std::uint32_t hand, const HandDescription& alike) const
    {
        return kinds_.empty() ? alike : kinds_[hand];
    }

    /// True if any hand can stick to anything.
    [[nodiscard]] bool any_friction() const { return !friction_of_hands_.empty(); }
    /// Returns the friction of a hand on a body, or on a plane. Call it only if any_friction().
    [[nodiscard]] HandFriction friction_on_body(std::uint32_t hand, BodyId body) const
    {
        return combined(friction_of_hands_[hand], friction_of_bodies_[body]);
    }
    [[nodiscard]] HandFriction friction_on_plane(std::uint32_t hand, std::size_t plane) const
    {
        return combined(friction_of_hands_[hand], friction_of_planes_[plane]);
    }

private:
    void set_friction(const Description& description);

    std::vector<std::uint32_t> kind_of_{}; // by body: index in kinds_ of the first hand
    std::vector<HandDescription> kinds_{};
    std::vector<HandFriction> friction_of_hands_{}; // empty: no hand can stick to anything
    std::vector<HandFriction> friction_of_bodies_{};
    std::vector<HandFriction> friction_of_planes_{};
};

/// True if a hand of the scene can stick to a body or a plane of it.
[[nodiscard]] bool has_hand_friction(const Description& description);

/// A hand's rubbing in the last tick, where hands have friction.
struct HandSlip {
    bool sticks = false;    // the hand sticks to something at the end of the tick
    bool slides = false;    // the hand slides over something at the end of the tick
    double stretch_m = 0.0; // at the start: how far the hand is from the place where it sticks
    double stored_j = 0.0;  // at the start: energy in the springs along the surfaces
};

/// Values that hold from a world's first tick to its last.
struct WorldConfig {
    std::vector<PlaneDescription> planes{};
    HandDescription hands{};
    glm::dvec3 gravity{0.0};
    double tick = 1e-3;   // seconds
    bool sleeping = true; // whether bodies at rest may fall asleep
    HandFeels feels{};
    std::vector<FieldDescription> fields{};
    InternalFaces internal_faces{};
};

/// The planned motion of a kinematic body.
struct KinematicScript {
    enum class Kind : std::uint8_t {
        steady, // keeps its present velocity and spin
        sways,  // moves to and fro from the position of `target`
        target, // reaches `target` at the end of the next tick, then goes on steadily
    };
    Kind kind = Kind::steady;
    Sway sway{};
    BodyState target{};
};

/// Counts of interventions since freeze(): cases where the plain algorithm would have broken a
/// physical law.
struct Interventions {
    // Guards: motion was lost.
    /// An island lost a tenth of its velocities or more; or the box of OneBoxStepper lost a share
    /// of its impulses without a hand on it.
    std::uint64_t islands_limited = 0;
    std::uint64_t paths_cut = 0;     // a body lost the rest of its path in the tick
    std::uint64_t budgets_spent = 0; // the work budget of a tick ended before the work was done
    // Mechanisms: only motion was lost that would break a law.
    std::uint64_t hands_braked = 0;     // a hand's impulse was scaled down so that it stays passive
    std::uint64_t impulses_trimmed = 0; // an island lost less than a tenth of its velocities
    std::uint64_t bounces_limited = 0;  // a bounce was made weaker so that no energy is gained
    std::uint64_t sweeps_continued = 0; // a body went on after its first touch within the tick
    std::uint64_t clusters_stuck = 0;   // bodies that touched too often had an inelastic hit
    std::uint64_t islands_anew = 0;     // an island was solved again, without last tick's impulses

    [[nodiscard]] std::uint64_t guards() const
    {
        return islands_limited + paths_cut + budgets_spent;
    }
    Interventions& operator+=(const Interventions& other)
    {
        islands_limited += other.islands_limited;
        paths_cut += other.paths_cut;
        budgets_spent += other.budgets_spent;
        hands_braked += other.hands_braked;
        impulses_trimmed += other.impulses_trimmed;
        bounces_limited += other.bounces_limited;
        sweeps_continued += other.sweeps_continued;
        clusters_stuck += other.clusters_stuck;
        islands_anew += other.islands_anew;
        return *this;
    }
};

/// The state that every stepper works on: the bodies, the hands' inputs and the forces on the
/// hands. All state that changes and that the next tick depends on is here or in the stepper's own
/// memory, so a copy of both is a snapshot.
struct WorldState {
    Bodies bodies;
    std::array<HandInput, hands_max> hands{};
    std::array<HandTouch, hands_max> touches{};
    std::vector<glm::dvec3> pushes{};       // newtons by id, held for the next tick, then cleared
    std::vector<glm::dvec3> torques{};      // N m by id, about the centre; held like pushes
    Bounded<BodyId> pushed{};               // the bodies with a push or a torque, each once
    Bounded<BodyId> twisted{};              // the bodies with a torque, each once
    std::vector<std::uint8_t> is_pushed{};  // by id, as bits: 1 in `pushed`, 2 in `twisted`
    std::vector<KinematicScript> scripts{}; // of the kinematic bodies, in slot order
    std::vector<HandSlip> slips{};          // by hand; empty where no hand has friction
    std::uint64_t ticks = 0;
    TickCost tick_cost{}; // cost of the last tick
    Interventions interventions{};
};

/// The scales of this scene. Every tolerance is a share of one of them.
struct Scales {
    double tick = 1e-3;  // s
    double size = 0.02;  // m: the smallest half edge of a movable body
    double fall = 0.0;   // m/s: what gravity adds in a tick
    double speed = 1e-2; // m/s: `fall`, or a millionth of `size` per tick if that is more
    double rate = 1e3;   // 1/s: ticks per second
};
[[nodiscard]] Scales scales_of(const WorldConfig& config, const Bodies& bodies);

} // namespace hapnet::scene
