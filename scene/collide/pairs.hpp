// SPDX-FileCopyrightText: 2026 The Hapnet authors
// SPDX-License-Identifier: MIT
#pragma once

#include "scene/bodies.hpp"
#include "scene/bounded.hpp"
#include "scene/collide/box_box.hpp"

#include <array>
#include <span>

namespace hapnet::scene {

/// The state of a contact in the last tick. The solver starts from it.
struct ContactMemory {
    BoxBoxMemory axis;
    std::uint32_t count = 0;
    std::array<std::uint32_t, manifold_points_max> feature{};
    std::array<double, manifold_points_max> normal_impulse{};
    glm::dvec3 friction_impulse{0.0}; // tangential, world's frame
    double torsion_impulse = 0.0;
    std::uint32_t ticks = 0;             // since the last correction of the impulses
    double normal_impulse_of_tick = 0.0; // N s, with bounces; valid if `count` > 0
};

/// True if the contact had a normal impulse last tick. Then a sleeping body of the contact wakes
/// with the other one.
[[nodiscard]] bool touches(const ContactMemory& memory);

/// A pair of near parts of two bodies with `a` < `b`, or of the part `a` and the plane `b`.
struct Pair {
    PartId a = 0;
    std::uint32_t b = 0;
    ContactMemory memory;
};

/// A pair's place in its set. It stays valid as long as the pair exists.
using PairIndex = std::uint32_t;

/// Pairs with their memories. The active pairs, which a tick has to examine, are listed in the
/// order of their ids, in whatever order they were added and removed. The other pairs are parked
/// and cost nothing. The set takes no memory after its construction: a pair beyond `pairs_max` is
/// left out and counted. Which pair is left out depends on the order of the additions.
class PairSet {
public:
    struct Room {
        std::uint32_t firsts = 0;  // a < firsts
        std::uint32_t seconds = 0; // b < seconds
        std::uint32_t pairs_max = 0;
    };
    explicit PairSet(Room room);

    [[nodiscard]] Pair& operator[](PairIndex index) { return pairs_[index]; }
    [[nodiscard]] const Pair& operator[](PairIndex index) const { return pairs_[index]; }

    /// Returns the active pairs, sorted by (a, b). The list is valid until the next
    /// apply_changes().
    [[nodiscard]] std::span<const PairIndex> active() const { return active_.all(); }
    /// Returns the pairs that the last apply_changes() added, sorted by (a, b).
    [[nodiscard]] std::span<const PairIndex> added() const { return added_.all(); }
    [[nodiscard]] std::uint32_t size() const { return size_; }
    [[nodiscard]] std::size_t size_max() const { return pairs_.size_max(); }
    /// Returns the number of times that add() found no room for a pair.
    [[nodiscard]] std::uint64_t left_out() const { return left_out_; }

    /// Adds a pair that is not in the set. Returns false when there is no room for it.
    bool add(std::uint32_t a, std::uint32_t b, bool is_active);
    void remove(PairIndex index);
    void set_active(PairIndex index, bool is_active);
    [[nodiscard]] bool is_active(PairIndex index) const
    {
        return (marks_[index] & active_mark) != 0;
    }
    /// Brings the list of active pairs up to date. It costs nothing when nothing has changed.
    void apply_changes();

    /// Calls visit(index) for every pair whose first member is `a`. `visit` may remove that pair.
    template <typename Visit>
    void for_first(std::uint32_t a, Visit visit) const
    {
        for (PairIndex i = first_[a]; i != none;) {
            const PairIndex next = links_[i].next_first;
            visit(i);
            i = next;
        }
    }
    /// Calls visit(index) for every pair whose second member is `b`. `visit` may remove that pair.
    template <typename Visit>
    void for_second(std::uint32_t b, Visit visit) const
    {
        for (PairIndex i = second_[b]; i != none;) {
            const PairIndex next = links_[i].next_second;
            visit(i);
            i = next;
        }
    }

private:
    static constexpr PairIndex none = ~PairIndex{0};

    /// A pair's neighbours in the lists of its two ends.
    struct Links {
        PairIndex next_first = none;
        PairIndex previous_first = none;
        PairIndex next_second = none;
        PairIndex previous_second = none;
    };

    // Marks. active_mark: the pair is active, in the list now or after the next apply_changes().
    // listed: the pair is in active_ or arriving_.
    static constexpr std::uint8_t active_mark = 1;
    static constexpr std::uint8_t listed = 2;
    static constexpr std::uint8_t parking = 4; // listed in parked_

    void link(PairIndex index);
    void unlink(PairIndex index);
    [[nodiscard]] PairIndex* find(PairIndex* first, PairIndex* last, PairIndex index) const;
    void drop_parked();
    void merge_arriving();

    Bounded<Pair> pairs_;
    Bounded<Links> links_;
    Bounded<std::uint64_t> keys_; // by pair: `a` in the high half, `b` in the low half
    Bounded<std::uint8_t> marks_;
    Bounded<PairIndex> free_;
    std::vector<PairIndex> first_, second_; // by `a` and by `b`: first pair of the list
    Bounded<PairIndex> active_, arriving_, added_;
    Bounded<PairIndex> parked_;  // pairs that are no longer active, but still in a list
    Bounded<PairIndex> removed_; // removed pairs whose index is free after the next apply_changes()
    std::uint32_t size_ = 0;
    std::uint64_t left_out_ = 0;
};

} // namespace hapnet::scene
