// SPDX-FileCopyrightText: 2026 The Hapnet authors
// SPDX-License-Identifier: MIT
#pragma once

#include "peer/core/shared_body.hpp"
#include "peer/core/sync/at_rest.hpp"
#include "peer/core/sync/ownership.hpp"
#include "peer/core/sync/situation.hpp"

#include <array>
#include <chrono>
#include <optional>
#include <span>
#include <vector>

namespace hapnet::peer {

/// Decides which peer's copy is authoritative, for bodies that turn and for several bodies. Bodies
/// that touch each other form a group and move together. The class finds whose hands move a group,
/// and moves the bodies of this copy that no hand moves to the poses of their owner (Ownership).
class SharedPoses {
public:
    /// The time after a touch during which two bodies still count as touching, because a resting
    /// body sometimes leaves its support for a tick.
    static constexpr base::Duration contact_lasts{std::chrono::milliseconds{100}};
    /// The greatest speed at which a body that is being moved by a correction may approach this
    /// hand, or a body that the hand moves. A remote hand carries a body at 0.3 m/s at most, in the
    /// paper's task.
    static constexpr double approach_m_per_s = 0.5;

    /// The distance below which a copy at rest is not moved to another one, and may sleep. It is a
    /// hundredth of the limit of agreement, and larger than the rounding of messages.
    static constexpr double same_place_m = 2e-6;
    static constexpr double same_angle_rad = 2e-5;

    /// `bodies` is the result of shared_bodies().
    SharedPoses(std::vector<SharedBody> bodies, std::uint16_t own_id,
                const AtRest::Times& times = AtRest::usual());

    [[nodiscard]] std::span<const SharedBody> bodies() const { return bodies_; }
    [[nodiscard]] std::optional<std::size_t> index_of(scene::BodyId id) const;

    /// Another peer whose hand touches a body.
    struct Toucher {
        const Remote* other = nullptr;
        std::size_t index = 0; // index of the other peer
        std::size_t body = 0;
    };
    /// The remote hands that touch something in a tick, sorted by id.
    struct Touchers {
        std::array<Toucher, 7> all{};
        std::size_t count = 0;
        [[nodiscard]] std::span<const Toucher> list() const { return {all.data(), count}; }
    };
    /// Returns the remote hands that touch bodies, by their last received states.
    [[nodiscard]] Touchers touchers(const Situation& situation) const;

    /// Finds whose hands moved which bodies. Call it after the world's tick.
    void find_movers(const scene::World& world, const Situation& situation,
                     const Touchers& touchers);
    /// The peers whose hands moved a body in the last tick, directly or through other bodies.
    enum class Mover : std::uint8_t { none, own, others };
    [[nodiscard]] Mover mover(std::size_t body) const { return movers_[body]; }
    /// Returns the peer with the lowest id among the others whose hands move this body; nullptr if
    /// there is none.
    [[nodiscard]] const Toucher* mover_among(const Touchers& touchers, std::size_t body) const;
    /// Returns the peer whose copy of a body was authoritative in the last tick, as this peer sees
    /// it: this peer while its hand moves the body, the lowest of the others while only others move
    /// it, and otherwise the owner (Ownership). It is 0 before the first tick.
    [[nodiscard]] std::uint16_t owner(std::size_t body) const { return owners_[body]; }

    /// Puts a body where `other` has it.
    void follow(scene::World& world, const Situation& situation, std::size_t body,
                const Remote& other) const;
    /// Moves a body that no hand moves to its owner's pose after a while.
    void settle(scene::World& world, const Situation& situation, std::size_t body);
    /// True if the body is being moved to its owner's pose.
    [[nodiscard]] bool is_settling(std::size_t body) const { return blends_[body].has_value(); }
    /// Puts all bodies where `other` has them, which must have sent all of them.
    void take_over(scene::World& world, const Remote& other) const;
    /// Returns the pose in `there` with a rotation that this copy's body allows.
    [[nodiscard]] scene::BodyState target_of(const scene::World& world, std::size_t body,
                                             const wire::BodyState& there) const;

private:
    /// The motion of a body that no hand moves to its owner's pose.
    struct Blend {
        std::uint16_t owner = 0;
        base::TimePoint start;
        scene::BodyState from;
    };
    /// The ids of present peers, ascending.
    struct Present {
        std::array<std::uint16_t, 8> ids{};
        std::size_t count = 0;
        [[nodiscard]] std::span<const std::uint16_t> list() const { return {ids.data(), count}; }
    };

    void note_contacts(const scene::World& world, base::TimePoint now);
    void find_groups(base::TimePoint now);
    [[nodiscard]] Present present_in(const Situation& situation) const;
    void put(scene::World& world, const Situation& situation, std::size_t body,
             const scene::BodyState& target) const;
    void place(scene::World& world, std::size_t body, const scene::BodyState& there) const;
    [[nodiscard]] bool is_near_hand(const scene::World& world, std::size_t body,
                                    double within_m) const;

    std::vector<SharedBody> bodies_;
    std::uint16_t own_id_;
    AtRest::Times times_;
    Ownership ownership_;
    std::array<std::array<std::optional<base::TimePoint>, wire::bodies_max>, wire::bodies_max>
        touching_{};                                 // when two bodies last touched
    std::array<BodySet, wire::bodies_max> groups_{}; // group of each body, itself included
    std::array<Mover, wire::bodies_max> movers_{};
    std::array<std::uint16_t, wire::bodies_max> owners_{};
    std::array<std::optional<base::TimePoint>, wire::bodies_max> untouched_since_{};
    std::array<std::optional<Blend>, wire::bodies_max> blends_{};
};

} // namespace hapnet::peer
