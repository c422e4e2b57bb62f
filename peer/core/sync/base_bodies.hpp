// SPDX-FileCopyrightText: 2026 The Hapnet authors
// SPDX-License-Identifier: MIT
#pragma once

#include "peer/core/shared_body.hpp"
#include "peer/core/sync/base_options.hpp"
#include "peer/core/sync/ownership.hpp"
#include "peer/core/sync/situation.hpp"

#include <array>
#include <chrono>
#include <optional>
#include <span>
#include <vector>

namespace hapnet::peer {

/// The base algorithm for bodies that turn, and for several. What is said there of the body holds
/// here of each group of bodies that touch each other:
/// - this hand touches one of them: all of them move by this copy's own dynamics. Another's force
///   acts where its hand is: on the body's centre, with the torque that it has about it;
/// - only other hands touch one of them: each is where the lowest id of those has it;
/// - no hand does: they coast, and after a while the copies go to their owner's (Ownership).
class BaseBodies {
public:
    /// Two that touched so long ago still count as touching: what rests on something leaves it for
    /// a tick now and then.
    static constexpr base::Duration contact_lasts{std::chrono::milliseconds{100}};
    /// What is put elsewhere comes no faster near this hand, or near a body that it moves. A remote
    /// hand carries a body at 0.3 m/s at most, in the paper's task.
    static constexpr double approach_m_per_s = 0.5;

    /// Bodies as shared_bodies() gives them.
    BaseBodies(std::vector<SharedBody> bodies, std::uint16_t own_id, const BaseOptions& options);

    /// Moves the world by one tick.
    [[nodiscard]] Outcome tick(scene::World& world, const Situation& situation);

    /// Puts all bodies where one of the others has them, which has told of all.
    void take_over(scene::World& world, const Remote& other) const;

    /// Whose hands moved a body in the last tick, by themselves or by way of others.
    enum class Mover : std::uint8_t { none, own, others };
    [[nodiscard]] Mover mover(std::size_t body) const { return movers_[body]; }
    /// Whose copy of a body counted in the last tick, as this peer sees it: its own while its hand
    /// moves it, that of the lowest other while only others do, and else its owner's (Ownership).
    /// 0 before the first.
    [[nodiscard]] std::uint16_t owner(std::size_t body) const { return owners_[body]; }

private:
    /// The way of a body that nobody moves to where its owner has it.
    struct Blend {
        std::uint16_t owner = 0;
        base::TimePoint start;
        scene::BodyState from;
    };
    /// Another whose hand touches a body.
    struct Toucher {
        const Other* other = nullptr;
        std::size_t body = 0;
    };
    /// Those of this tick, in the order of their ids.
    struct Touchers {
        std::array<Toucher, 7> all{};
        std::size_t count = 0;
        [[nodiscard]] std::span<const Toucher> list() const { return {all.data(), count}; }
    };
    /// Ids, ascending.
    struct Present {
        std::array<std::uint16_t, 8> ids{};
        std::size_t count = 0;
        [[nodiscard]] std::span<const std::uint16_t> list() const { return {ids.data(), count}; }
    };

    [[nodiscard]] std::optional<std::size_t> index_of(scene::BodyId id) const;
    [[nodiscard]] Touchers push(scene::World& world, const Situation& situation, Outcome& outcome);
    void note_contacts(const scene::World& world, base::TimePoint now);
    void find_groups(base::TimePoint now);
    void place_all(scene::World& world, const Situation& situation, const Touchers& touchers);
    [[nodiscard]] Present present_in(const Situation& situation) const;
    void settle(scene::World& world, const Situation& situation, std::size_t body);
    void follow(scene::World& world, const Situation& situation, std::size_t body,
                const wire::BodyState& there) const;
    [[nodiscard]] scene::BodyState target_of(const scene::World& world, std::size_t body,
                                             const wire::BodyState& there) const;
    void put(scene::World& world, const Situation& situation, std::size_t body,
             const scene::BodyState& target) const;
    void place(scene::World& world, std::size_t body, const scene::BodyState& there) const;
    [[nodiscard]] bool is_near_hand(const scene::World& world, std::size_t body,
                                    double within_m) const;

    std::vector<SharedBody> bodies_;
    std::uint16_t own_id_;
    BaseOptions options_;
    Ownership ownership_;
    std::array<std::array<std::optional<base::TimePoint>, wire::bodies_max>, wire::bodies_max>
        touching_{};                                 // of two bodies, when last
    std::array<BodySet, wire::bodies_max> groups_{}; // by body: those that it touches, and itself
    std::array<Mover, wire::bodies_max> movers_{};
    std::array<std::uint16_t, wire::bodies_max> owners_{};
    std::array<std::optional<base::TimePoint>, wire::bodies_max> untouched_since_{};
    std::array<std::optional<Blend>, wire::bodies_max> blends_{};
};

} // namespace hapnet::peer
