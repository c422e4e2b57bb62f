// SPDX-FileCopyrightText: 2026 The Hapnet authors
// SPDX-License-Identifier: MIT
#pragma once

#include "scene/one_box/hands.hpp"
#include "scene/one_box/motion.hpp"
#include "scene/one_box/obstacles.hpp"
#include "scene/state.hpp"

namespace hapnet::scene {

/// One movable box that cannot turn, among fixed boxes and planes parallel to it: every axis is a
/// scalar motion with a closed form, and what begins or ends within a tick is found in it. With
/// `coulomb`, dry friction on what carries the box.
///
/// Exact up to rounding: flight; drag on a plane (along it, while a plane carries the box); hands
/// on faces and hands that hold, any number, with their beginning, end and limit of force at their
/// moments; impacts and bounces at theirs; dry friction along a straight way, with its exact stop
/// and slip. Second order in the tick: dry friction while other forces turn the way; hands at edges
/// and corners (their normals hold for a tick). First order: a hand that holds at its greatest
/// force, at the start of a tick or in the mean over it: that force is held throughout.
///
/// A bounce that would be over before one tick has passed is none. After `events_max` events in a
/// tick its springs stay as they are and impacts are inelastic, until its end.
template <bool coulomb>
class SlidingTick {
public:
    static constexpr int events_max = 8;

    SlidingTick(const Description& description, const Frozen& frozen, const Stage& stage);

    void tick(const Frozen& frozen, Stage& stage);
    void disturbed(Stage& stage, BodyId body);

    /// In how many ticks there were more events than are followed.
    [[nodiscard]] std::uint64_t crowded_ticks() const { return crowded_ticks_; }

private:
    /// Finds what is within `reach`.
    void see(Slide& slide, double reach);
    void run(const Frozen& frozen, Slide& slide);
    /// Where hands hold the box: again with less, when one held with more than its greatest force.
    void try_holding(const Frozen& frozen, Stage& stage, Slide& start);
    void conclude(const Frozen& frozen, Stage& stage, const Slide& slide) const;

    BodyId body_;
    std::array<bool, 3> locked_{};
    SlideLaws laws_;
    Obstacles obstacles_;
    SlidingHands hands_;
    std::uint64_t crowded_ticks_ = 0;
};

extern template class SlidingTick<false>;
extern template class SlidingTick<true>;

} // namespace hapnet::scene
