// SPDX-FileCopyrightText: 2026 The Hapnet authors
// SPDX-License-Identifier: MIT
#pragma once

#include "peer/core/effect_sums.hpp"
#include "peer/core/finger_friction.hpp"
#include "peer/core/passivity.hpp"
#include "peer/core/settings.hpp"
#include "peer/core/shared_body.hpp"
#include "peer/core/sync/shared_poses.hpp"
#include "peer/core/tick.hpp"

#include <optional>
#include <span>
#include <vector>

namespace hapnet::peer {

/// A peer's own copy of the scene, with the movable bodies that all peers share, and the effects of
/// this peer's hand on them. Call tick() in each tick of a session, and then say() for each
/// message.
class SceneCopy {
public:
    static constexpr double reach_max_m = 10.0; // no hand in any scene is farther out
    /// The time for which messages contain a body after it has moved.
    static constexpr base::Duration body_lingers{std::chrono::seconds{1}};
    /// The time after its last touch for which a hand counts as the cause of the body's motion.
    static constexpr base::Duration push_lasts{std::chrono::milliseconds{200}};

    /// `settings.scene` must be accepted by shared_bodies() and World::freeze().
    explicit SceneCopy(const Settings& settings);

    [[nodiscard]] const scene::World& world() const { return world_; }
    /// Returns the shared bodies: every movable body of the scene, sorted by id.
    [[nodiscard]] std::span<const SharedBody> shared() const { return shared_; }
    /// Returns the first shared body.
    [[nodiscard]] scene::BodyId body() const { return body_; }
    /// Returns the object that decides whose copies are authoritative; nullptr if only one body is
    /// shared and it does not turn.
    [[nodiscard]] SharedPoses* poses() { return poses_ ? &*poses_ : nullptr; }
    [[nodiscard]] const SharedPoses* poses() const { return poses_ ? &*poses_ : nullptr; }
    /// Returns the greatest force of another hand, in N.
    [[nodiscard]] double force_max_n() const { return force_max_n_; }

    /// True if a state of another peer is possible in this scene.
    [[nodiscard]] bool is_plausible(const wire::State& state) const;

    /// Makes the copy wait until take_over() knows the bodies, or ends this wait. A peer that joins
    /// late needs it, because it starts with the bodies of one of the others. Until then its copy
    /// stands still.
    void await_bodies(bool awaited) { is_known_ = !awaited; }
    [[nodiscard]] bool is_known() const { return is_known_; }
    /// Places all bodies as one of the others has them, once that one has sent all of them.
    void take_over(std::span<const Remote> others);

    /// Lets the algorithm advance the copy by a tick, and adds up the effects of this hand.
    void tick(Tick& tick, Algorithm& algorithm, const Situation& situation,
              const scene::HandInput& hand);

    /// Returns the bodies that messages must contain now: those that something touches or moves, or
    /// did a moment ago; all of them if `all_due`.
    [[nodiscard]] BodySet bodies_to_say(bool all_due, base::TimePoint now) const
    {
        unsigned set = 0;
        for (std::size_t i = 0; is_known_ && i < shared_.size(); ++i) {
            const auto& stir = effects_[i].last_stir;
            if (all_due || (stir && now - *stir < body_lingers)) set |= 1U << i;
        }
        return static_cast<BodySet>(set);
    }
    void say(wire::State& state, BodySet bodies) const;

private:
    /// The effect of this hand on one of the shared bodies.
    struct Effect {
        EffectSums sums;
        std::optional<base::TimePoint> last_touch; // last touch by this hand
        std::optional<base::TimePoint> last_stir;  // when the body was last touched or moved
        base::Position place_before;               // place at the start of the tick
        glm::dquat orientation_before{1.0, 0.0, 0.0, 0.0};
    };

    [[nodiscard]] bool is_shared(const wire::BodyState& body) const;
    void note_places();
    void move(Tick& tick, Algorithm& algorithm, const Situation& situation,
              const scene::HandInput& hand);
    [[nodiscard]] double rendered_share(base::Duration late) const;
    [[nodiscard]] base::Position keep_within_reach(scene::BodyId body);
    void account(const Tick& tick, base::TimePoint now);
    void account_for(std::size_t body, SharedPoses::Mover mover, const Tick& tick,
                     base::TimePoint now);
    void add_push(std::size_t body, const scene::HandTouch& touch);
    [[nodiscard]] wire::BodyState body_state(std::size_t body) const;

    std::vector<SharedBody> shared_;
    scene::BodyId body_;
    std::optional<SharedPoses> poses_; // nullopt: one shared body that does not turn
    scene::World world_;
    std::optional<FingerFriction> friction_; // nullopt: the scene's hands have no friction
    base::Duration tick_;
    VirtualWall wall_; // hardest contact of the scene
    double stiffness_max_n_per_m_;
    double grip_damping_ns_per_m_;
    double share_; // share of the forces on the hand that may be rendered
    double force_max_n_;
    double remote_reach_m_; // limit of the positions that other peers may claim
    double remote_speed_m_per_s_;
    std::vector<Effect> effects_;
    bool is_known_ = true;
};

} // namespace hapnet::peer
