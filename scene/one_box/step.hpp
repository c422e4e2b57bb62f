// SPDX-FileCopyrightText: 2026 The Hapnet authors
// SPDX-License-Identifier: MIT
#pragma once

#include "scene/one_box/hands.hpp"
#include "scene/one_box/motion.hpp"
#include "scene/one_box/obstacles.hpp"
#include "scene/state.hpp"

namespace hapnet::scene {

/// One movable box that cannot rotate, among fixed boxes and planes parallel to it. Every axis is a
/// scalar motion with a closed form, and contacts that begin or end within a tick do so at their
/// exact moments. With `coulomb`, the box's supports have dry friction.
///
/// Exact up to rounding: flight; drag on a plane (along it, while a plane supports the box or the
/// box is locked onto one); any number of hands on faces and of hands that hold, with the moments
/// at which they begin, end and reach their limit of force; impacts and bounces; dry friction along
/// a straight path, with its exact stop and slip; hands at edges and corners while their normals
/// hold, which is for a tick. Second order in the tick: dry friction while other forces bend the
/// path or change the load; the normals. First order: a hand that holds at its greatest force at
/// the start of a tick or in the mean over it, since that force is held throughout.
///
/// A bounce that would be over within one tick is left out. After `events_max` events in a tick, or
/// `root_steps_max` steps of searching for them, finish_tick() runs the rest.
template <bool coulomb>
class OneBoxStepper {
public:
    static constexpr int events_max = 8;
    static constexpr int root_steps_max = 500;

    OneBoxStepper(const Description& description, const WorldConfig& config,
                  const WorldState& state);

    void step(const WorldConfig& config, WorldState& state);
    [[nodiscard]] TickCost tick_cost_bound(const WorldConfig& config) const
    {
        // A tick is tried once more for every hand that grips.
        return {.events = std::uint64_t{events_max} * (1 + config.hands.count)};
    }
    void on_body_placed(WorldState& state, BodyId body);
    void on_body_shifted(WorldState& state, BodyId body);

    /// Returns the number of ticks in which there were more events than are followed.
    [[nodiscard]] std::uint64_t crowded_ticks() const { return crowded_ticks_; }
    /// Returns the impulse that obstacles gave the box in the last tick, N s. It is computed on
    /// demand. It is meaningful only where there are obstacles: an axis that stands still for
    /// another reason gets an impulse, too.
    [[nodiscard]] glm::dvec3 contact_impulse(const WorldConfig& config,
                                             const WorldState& state) const;

private:
    void set_start(const WorldConfig& config, const WorldState& state, BoxMotion& box);
    void add_support(const BoxMotion& box, double time);
    /// Lists the obstacles within `reach`.
    void query_obstacles(BoxMotion& box, double reach);
    void run_events(const WorldConfig& config, WorldState& state, BoxMotion& box);
    /// Runs the tick with the hands' grips. Runs it again with limited grips when one was too
    /// strong.
    void solve_with_grips(const WorldConfig& config, WorldState& state, BoxMotion& start);
    void commit(const WorldConfig& config, WorldState& state, BoxMotion& box) const;
    void settle_tick(const WorldConfig& config, WorldState& state, BoxMotion& box) const;
    /// Returns the acceleration by gravity and pushes.
    [[nodiscard]] PerAxis steady_acceleration(const WorldConfig& config,
                                              const WorldState& state) const;
    /// Returns the velocity of the box that follows from the forces that the hands report. Stiff
    /// hands can press so hard against each other that the sum of their forces has fewer digits
    /// than the velocity of the closed form. Where nothing else touches the box, the change of its
    /// momentum is the sum of the impulses on it, to the last digit of that sum.
    [[nodiscard]] PerAxis velocity_from_hands(const WorldConfig& config,
                                              const WorldState& state) const;

    BodyId body_;
    std::array<bool, 3> locked_{};
    bool is_alone_ = false; // stiff hands, nothing locked, and no other body or plane
    AxisOscillators oscillators_;
    Obstacles obstacles_;
    BoxHands hands_;
    TickRoom room_{};
    std::uint64_t crowded_ticks_ = 0;
    // Results of the last tick, for contact_impulse().
    bool was_pushed_ = false;
    bool was_eventful_ = false;
    glm::dvec3 last_push_{0.0};  // N
    PerAxis contact_momentum_{}; // m/s; valid if something began or ended
};

extern template class OneBoxStepper<false>;
extern template class OneBoxStepper<true>;

} // namespace hapnet::scene
