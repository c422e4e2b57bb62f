// SPDX-FileCopyrightText: 2026 The Hapnet authors
// SPDX-License-Identifier: MIT
#pragma once

#include "scene/bounded.hpp"
#include "scene/collide/pair_finder.hpp"
#include "scene/solver/islands.hpp"

#include <cstdint>
#include <vector>

namespace hapnet::scene {

/// Decides which bodies sleep. A body that has been at rest for a tenth of a second, together with
/// all movable bodies that it touches, falls asleep. Its velocity becomes exactly zero, its
/// contacts keep their impulses, and it costs nothing until it is woken. Fixed bodies do not
/// connect islands. Two bodies touch when their contact had an impulse in the last tick (touches()
/// of its memory).
///
/// A body is at rest if its centre and its corners, as they turn, move no faster than a tenth of
/// what gravity adds in a tick plus a thousandth of sqrt(gravity * size). Without gravity it must
/// not move at all. A body that moves more than when its rest began is not at rest: a box on its
/// edge tips.
///
/// In each tick call wake() for bodies that a hand reaches or a push moves. Call wake_touched()
/// when the manifolds are known. Call update() at the end of the tick, when the contacts' memories
/// are written.
class Sleep {
public:
    Sleep(const WorldConfig& config, const Bodies& bodies);

    /// Wakes the body of a part and its whole island, and restarts their times at rest. Slots
    /// change.
    template <BroadPhase broad_phase>
    void wake(PartId body, Bodies& bodies, PairFinder<broad_phase>& pair_finder);

    /// Wakes the sleeping bodies that touch an awake body that is not at rest, and their islands. A
    /// body that stayed asleep would support the others like a wall. `touching(index)` is true if
    /// the pair's manifold of this tick has points. Returns true if it woke any. Each pair is
    /// examined once, and once more if a body that woke added it to the list.
    template <BroadPhase broad_phase, typename Touching>
    bool wake_touched(Bodies& bodies, PairFinder<broad_phase>& pair_finder, Touching touching)
    {
        const Slot awake = bodies.awake;
        for (auto pairs = pair_finder.pairs(); !pairs.empty() && bodies.awake != bodies.movable;
             pairs = pair_finder.pairs_added()) {
            for (const PairIndex index : pairs) {
                const BodyId sleeper = sleeper_disturbed_by(bodies, pair_finder.pair(index));
                if (sleeper != no_body && touching(index))
                    wake_island(sleeper, bodies, pair_finder);
            }
            pair_finder.apply_changes();
        }
        return bodies.awake != awake;
    }

    /// Counts the time at rest of the awake bodies and puts islands to sleep. `ticks` is the number
    /// of ticks of the world.
    template <BroadPhase broad_phase>
    void update(Bodies& bodies, PairFinder<broad_phase>& pair_finder, std::uint64_t ticks);

    /// Restarts the time at rest of an awake body: a hand touches it.
    void keep_awake(const Bodies& bodies, BodyId body) { rested_[bodies.slot_of[body]] = 0.0; }

    /// Returns the number of ticks for which an awake body has been at rest.
    [[nodiscard]] double rested(Slot slot) const { return rested_[slot]; }

private:
    static constexpr BodyId no_body = ~BodyId{0};

    /// Returns the body of a pair that sleeps while the other is awake and not at rest; else
    /// no_body.
    [[nodiscard]] BodyId sleeper_disturbed_by(const Bodies& bodies, const Pair& pair) const;
    template <BroadPhase broad_phase>
    void wake_island(BodyId body, Bodies& bodies, PairFinder<broad_phase>& pair_finder);
    template <BroadPhase broad_phase>
    void move_to_awake(BodyId body, Bodies& bodies, PairFinder<broad_phase>& pair_finder);
    template <BroadPhase broad_phase>
    void fall_asleep(BodyId body, Bodies& bodies, PairFinder<broad_phase>& pair_finder);
    /// Counts the time at rest. Returns true if any body has been at rest long enough.
    [[nodiscard]] bool count_rest(const Bodies& bodies);
    [[nodiscard]] double motion_of(const Bodies& bodies, Slot slot) const;
    template <BroadPhase broad_phase>
    void find_islands(const Bodies& bodies, PairFinder<broad_phase>& pair_finder);
    void swap(Slot a, Slot b);

    bool sleeping_;
    double rest_ticks_;      // ticks at rest before a body falls asleep
    std::uint64_t interval_; // ticks between two checks of the islands
    // Values by slot, which move with their bodies.
    std::vector<double> speed2_;    // (m/s)^2: at rest up to this
    std::vector<double> momentum2_; // (kg m^2/s)^2: at rest up to this
    std::vector<double> rested_;    // ticks at rest so far
    std::vector<double> motion_;    // motion when the rest began, in shares of the limits of rest

    Islands islands_;
    std::vector<double> island_rested_; // by the island's id: the least rested_ of its bodies
    Bounded<BodyId> queue_;             // bodies about to wake or to fall asleep
};

} // namespace hapnet::scene
