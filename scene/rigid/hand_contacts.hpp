// SPDX-FileCopyrightText: 2026 The Hapnet authors
// SPDX-License-Identifier: MIT
#pragma once

#include "scene/bounded.hpp"
#include "scene/collide/sphere_box.hpp"
#include "scene/collide/sweep.hpp"
#include "scene/hand/advance.hpp"
#include "scene/hand/friction.hpp"
#include "scene/rigid/hand_proxies.hpp"
#include "scene/rigid/pressing_hands.hpp"
#include "scene/state.hpp"

#include <array>
#include <optional>
#include <span>
#include <vector>

namespace hapnet::scene {

/// The greatest number of bodies that one hand touches at the same time. Of more bodies, those with
/// the lowest ids count.
inline constexpr std::size_t touched_per_hand_max = 8;

/// The hands' springs of one tick, and the memory of the touched bodies that the next tick needs.
class HandContacts {
public:
    explicit HandContacts(const WorldConfig& config);

    /// A hand's spring on a movable body.
    struct Spring {
        std::uint32_t hand = 0;
        BodyId body = 0;
        glm::dvec3 impulse{0.0}; // on the body, N s
        PartId part = 0;         // the part that the hand pushes or holds
        bool is_on_part = false; // the body has several parts
    };

    /// Starts a tick with no hand touching anything.
    void begin_step(const WorldConfig& config, WorldState& state);

    /// The place and the motion of a part of a body.
    struct Target {
        BodyId body = 0;
        PartId part = 0;
        bool is_movable = false;
        const SweptBox& now;
        glm::dvec3 velocity{0.0};           // velocity of the body's centre
        const Bodies* with_parts = nullptr; // all bodies, if this body has several parts; else null

        [[nodiscard]] const BodyPart* shape() const
        {
            return with_parts == nullptr ? nullptr : &with_parts->parts[part];
        }
        /// The centre of the body. It differs from the box's centre only if the body has several
        /// parts.
        [[nodiscard]] glm::dvec3 centre() const
        {
            return with_parts == nullptr ? now.box.centre : now.box.centre - now.offset;
        }
    };
    [[nodiscard]] static Target target_of(const Bodies& bodies, PartId part, const SweptBox& now)
    {
        const Slot slot = bodies.slot_of[part];
        const BodyProperties& properties = bodies.properties[slot];
        return {properties.id,
                part,
                slot < bodies.movable,
                now,
                bodies.velocity.at(slot),
                properties.has_parts() ? &bodies : nullptr};
    }
    /// Finds the effect of the hand on one of the bodies that it may reach.
    void collide(const WorldConfig& config, WorldState& state, std::uint32_t hand,
                 const Target& target);
    /// True if all springs of this tick, one or two, press amid faces of one body that no other
    /// hand is near. Then the next tick may begin with press_again().
    [[nodiscard]] bool may_press_again(const WorldConfig& config);
    /// Finds the same contacts as collide() would. Returns false when the hand presses another face
    /// or none.
    [[nodiscard]] bool press_again(const WorldState& state, const SweptBox& now,
                                   const glm::dvec3& velocity);
    [[nodiscard]] const PressingHands& pressing() const { return pressing_; }
    [[nodiscard]] bool feels_planes() const { return any_felt_plane_; }
    /// Adds the forces of planes on the hands.
    static void feel_planes(const WorldConfig& config, WorldState& state);
    [[nodiscard]] bool any_friction() const { return any_friction_; }
    /// Adds the friction of the springs, and the friction that hands feel from fixed bodies and
    /// planes. `target_of` returns the place and motion of a part.
    template <typename TargetOf>
    void add_friction(const WorldConfig& config, WorldState& state, const TargetOf& target_of)
    {
        proxies_.begin_step();
        rubbed_.clear();
        state.slips.assign(state.slips.size(), {});
        for (std::size_t i = 0; i < springs_.size(); ++i)
            rub_movable(config, state, i, target_of(springs_[i].part));
        for (std::uint32_t hand = 0; hand < config.hands.count; ++hand) {
            if (!state.hands[hand].present) continue;
            for (std::size_t k = 0; k < hands_[hand].count; ++k) {
                const Target target = target_of(hands_[hand].nearby[k].part);
                if (!target.is_movable) rub_fixed(config, state, hand, target);
            }
            rub_planes(config, state, hand);
        }
    }
    /// Forgets the bodies that the hand has left.
    void forget_departed(std::uint32_t index);

    [[nodiscard]] std::span<const Spring> springs() const { return springs_.all(); }
    /// The springs on one body, and the place for their impulses. Both are valid until the next
    /// call.
    struct BodySprings {
        std::span<const HandSpring> springs;
        std::span<SpringImpulse> work;
    };
    [[nodiscard]] BodySprings springs_on(BodyId body);
    /// The friction of the springs on a body; empty where they are smooth.
    [[nodiscard]] std::span<FrictionSpring> frictions_on(BodyId body);
    /// Stores the new state of the friction.
    void store_friction(WorldState& state, BodyId body);
    /// Stores the impulses that were found for the springs.
    void store_impulses(BodyId body);
    /// Returns the first spring on a body, which has at least one.
    [[nodiscard]] const Spring& first_spring_on(BodyId body) const;
    /// Reports the forces of the springs to the hands.
    void report_forces(const WorldConfig& config, WorldState& state);

    void forget(const Bodies& bodies, BodyId body);

private:
    /// The memory of a body's part near a hand.
    struct NearBody {
        PartId part = 0;
        bool is_current = false; // near the hand in this tick
        SphereBoxMemory memory;
        // A tick ago: the hand's place from the body's centre, and the body's axes.
        bool has_before = false;
        glm::dvec3 offset{0.0};
        glm::dmat3 axes{1.0};
        AmidFace amid;
    };
    struct Holding {
        BodyId body = 0;
        PartId part = 0;
        glm::dvec3 at{0.0}; // held point, in the part's frame
    };
    struct Hand {
        std::array<NearBody, touched_per_hand_max> nearby;
        std::size_t count = 0;
        std::optional<Holding> holding;
    };

    bool touch(const WorldConfig& config, const HandInput& input, const Target& target,
               NearBody& near_body, HandSpring& spring) const;
    bool find(const WorldConfig& config, const HandInput& input, const Target& target,
              NearBody& near_body, HandSpring& spring) const;
    /// A hand near a box, in the box's frame.
    struct FoundNear {
        SphereBoxMemory& memory;
        const glm::dvec3& place;
        double radius = 0.0;
    };
    [[nodiscard]] static std::optional<LocalOverlap> outer_overlap(const InternalFaces& internal,
                                                                   const Target& target,
                                                                   const FoundNear& near,
                                                                   const LocalOverlap& found);
    bool find_on_part(const WorldConfig& config, const HandInput& input, const Target& target,
                      NearBody& near_body, HandSpring& spring) const;
    bool find_round(const WorldConfig& config, const HandInput& input, const Target& target,
                    HandSpring& spring) const;
    static void press(const AmidFace& face, const glm::dvec3& offset, HandSpring& spring);
    struct RubbedSpring {
        HandProxies::Touch touch;
        FrictionSpring friction;
    };
    /// A hand's press on a surface at the start of a tick.
    struct Press {
        const HandDescription& hands;
        glm::dvec3 velocity{0.0}; // velocity of the hand over the surface where they touch
        double depth = 0.0;
        double closing = 0.0;
    };
    void rub_movable(const WorldConfig& config, WorldState& state, std::size_t spring,
                     const Target& target);
    void rub_fixed(const WorldConfig& config, WorldState& state, std::uint32_t hand,
                   const Target& target);
    void rub_planes(const WorldConfig& config, WorldState& state, std::uint32_t hand);
    void rub_unmoved(const WorldConfig& config, WorldState& state, const HandProxies::Touch& touch,
                     const HandFriction& limits, const Press& press);
    static void note_friction(WorldState& state, const HandProxies::Touch& touch,
                              const FrictionSpring& friction, const Press& press);
    static void note_slip(HandSlip& slip, const FrictionSpring& friction);
    [[nodiscard]] glm::dvec3 impulse_on_body(const Spring& one) const;
    HandSpring& add(std::uint32_t hand, const Target& target);
    bool add_grip(const WorldConfig& config, WorldState& state, std::uint32_t index,
                  const Target& target);
    static void feel_planes_with(const WorldConfig& config, WorldState& state, std::uint32_t hand);
    void add_push(const WorldConfig& config, WorldState& state, std::uint32_t index,
                  const Target& target);
    [[nodiscard]] bool has_room(const WorldConfig& config, std::uint32_t index,
                                const Target& target) const;
    [[nodiscard]] NearBody* find_near(Hand& hand, PartId part);
    [[nodiscard]] static bool is_inner(const HandInput& input, const Target& target,
                                       const HandSpring& spring);

    std::vector<Hand> hands_;
    bool any_felt_plane_;
    bool any_friction_;
    double gravity_reach_; // twice the distance that a body falls in a tick from rest, metres
    Scratch<Spring> springs_;
    Scratch<HandSpring> forces_;  // in the order of springs_
    Scratch<HandSpring> own_;     // springs of one body
    Scratch<SpringImpulse> work_; // impulses of the springs of one body
    PressingHands pressing_;
    HandProxies proxies_;
    Scratch<RubbedSpring> rubbed_;      // in the order of springs_, where there is friction
    Scratch<FrictionSpring> frictions_; // friction of the springs of one body
};

} // namespace hapnet::scene
