// SPDX-FileCopyrightText: 2026 The Hapnet authors
// SPDX-License-Identifier: MIT
#pragma once

#include "scene/collide/aabb.hpp"
#include "scene/collide/fat_aabbs.hpp"
#include "scene/collide/grid.hpp"
#include "scene/collide/pairs.hpp"
#include "scene/maths/vector.hpp"
#include "scene/state.hpp"

#include <span>
#include <type_traits>
#include <vector>

namespace hapnet::scene {

/// The method by which the movable bodies of a scene find each other.
enum class BroadPhase : std::uint8_t {
    none,      // there is only one movable body
    all_pairs, // each is compared with each
    grid,
};

/// The path of a hand's sphere within a tick.
struct HandPath {
    glm::dvec3 from{0.0};
    glm::dvec3 to{0.0};
    double radius = 0.0;
};

/// The broad phase: finds the bodies that may touch. Every body lies in a fat AABB. Its pairs are
/// searched again only when it leaves that box, which costs a few comparisons per awake body to
/// find out. A body that sleeps or is fixed costs nothing.
///
/// Two bodies are a pair if they come nearer to each other within the tick than pair_margin times
/// their smallest half edges, each body its own. Their predicted motion is the straight line of
/// their velocities, or one tick of gravity off it. Bodies that are farther apart, by up to the
/// extent of the fat boxes, may be pairs too.
template <BroadPhase broad_phase>
class PairFinder {
public:
    PairFinder(const WorldConfig& config, const Bodies& bodies);

    /// Reads the awake bodies' positions, orientations and velocities and brings the lists of pairs
    /// up to date. Call it at the start of a tick and after anything put a body elsewhere.
    void update(const Bodies& bodies);

    /// Returns the pairs of parts of two bodies, at least one of them movable and awake, sorted by
    /// the parts' ids. The part of a body of one part has the body's id, see PartId. An index is
    /// valid until the next update(). The list is valid until the next update() or apply_changes().
    [[nodiscard]] std::span<const PairIndex> pairs() const { return pairs_.active(); }
    [[nodiscard]] Pair& pair(PairIndex index) { return pairs_[index]; }
    /// Returns the pairs of awake bodies (`a`) and near planes (`b`, an index into
    /// WorldConfig::planes).
    [[nodiscard]] std::span<const PairIndex> plane_pairs() const { return plane_pairs_.active(); }
    /// Returns the greatest possible number of pairs with planes.
    [[nodiscard]] std::size_t plane_pairs_max() const { return plane_pairs_.size_max(); }
    [[nodiscard]] Pair& plane_pair(PairIndex index) { return plane_pairs_[index]; }

    /// Returns the parts of bodies, movable or fixed, asleep or awake, that a hand may reach within
    /// the tick, sorted by their ids. Call it after update(). For a hand far from everything it
    /// costs a few comparisons.
    [[nodiscard]] std::span<const PartId> near_hand(std::uint32_t hand, const HandPath& path)
    {
        Hand& known = hands_[hand];
        const glm::dvec3 away =
            glm::max(sizes(path.from - known.middle), sizes(path.to - known.middle));
        if (!(away.x <= known.room.x && away.y <= known.room.y && away.z <= known.room.z &&
              path.radius <= known.radius))
            renew_hand(known, path);
        return known.bodies.all();
    }

    /// Calls visit(part) for every part whose fat box overlaps `box`. Call it after update().
    template <typename Visit>
    void for_overlapping(const Aabb& box, Visit visit) const
    {
        boxes_.for_overlapping(box, visit);
    }

    /// Adds a body's pairs to the lists, or removes them from the lists. Sleep calls it after the
    /// body has crossed the border between awake and asleep.
    void on_wake(const Bodies& bodies, BodyId body);
    void on_sleep(const Bodies& bodies, BodyId body, Slot was_in);
    /// Brings the lists up to date after on_wake() and on_sleep(). pairs_added() then returns the
    /// pairs that are new in the tick that has begun.
    void apply_changes();
    [[nodiscard]] std::span<const PairIndex> pairs_added() const { return pairs_.added(); }

    /// Forgets a body's contacts after it was put elsewhere.
    void forget(const Bodies& bodies, BodyId body);

    [[nodiscard]] const PairSet& all_pairs() const { return pairs_; }
    [[nodiscard]] const PairSet& all_plane_pairs() const { return plane_pairs_; }

    /// Returns the greatest possible number of pairs of both kinds.
    [[nodiscard]] std::size_t pairs_max() const
    {
        return pairs_.size_max() + plane_pairs_.size_max();
    }

    /// Counts of the work done, for tests and measurements.
    struct Counts {
        std::uint64_t renewed = 0;       // bodies that left their fat boxes
        std::uint64_t hands_renewed = 0; // hands that left their fat boxes
        // The number of pairs for which there was no room (32 for every movable body, 8 with
        // planes). A pair counts again in every tick. 0 unless very many bodies overlap. The search
        // for them continues until there is room.
        std::uint64_t pairs_left_out = 0;
    };
    [[nodiscard]] Counts counts() const;

private:
    /// A hand's fat AABB and the bodies in it, by their ids. The box contains a sphere of that
    /// radius as long as the sphere's centre is no farther than `room` from the middle.
    struct Hand {
        Aabb box;
        glm::dvec3 middle{0.0}, room{-1.0};
        double radius = 0.0;
        Bounded<PartId> bodies;
    };
    using Finder = std::conditional_t<broad_phase == BroadPhase::all_pairs, AabbScan, Grid>;

    void renew(const Bodies& bodies, Slot slot);
    void update_pairs(const Bodies& bodies, PartId id);
    void update_plane_pairs(const Aabb& box, PartId id, bool is_awake);
    void update_hand(Hand& hand, PartId id);
    void renew_hand(Hand& known, const HandPath& path);

    std::vector<PlaneDescription> planes_of_scene_;
    bool has_parts_; // some body has several parts
    FatAabbs fat_boxes_;
    Finder boxes_;
    PairSet pairs_;
    PairSet plane_pairs_;
    std::vector<Hand> hands_;
    Bounded<Slot> moved_out_;
    bool has_left_out_ = false;         // there was no room for a pair
    std::vector<std::uint64_t> stamps_; // by PartId: stamp_ if paired with the renewed part
    std::uint64_t stamp_ = 0;
    std::uint64_t renewed_ = 0;
    std::uint64_t hands_renewed_ = 0;
};

extern template class PairFinder<BroadPhase::all_pairs>;
extern template class PairFinder<BroadPhase::grid>;

} // namespace hapnet::scene
