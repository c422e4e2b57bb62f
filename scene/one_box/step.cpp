// SPDX-FileCopyrightText: 2026 The Hapnet authors
// SPDX-License-Identifier: MIT
#include "scene/one_box/step.hpp"

#include "proto/base/ensure.hpp"
#include "scene/one_box/account.hpp"
#include "scene/one_box/coupled.hpp"
#include "scene/one_box/events.hpp"
#include "scene/one_box/friction.hpp"
#include "scene/one_box/rest_of_tick.hpp"

namespace hapnet::scene {

namespace {

const BodyProperties& movable_box(const Bodies& bodies)
{
    base::ensure(bodies.movable == 1);
    return bodies.properties[0];
}

template <bool coulomb>
void start_interval(BoxMotion& box)
{
    set_trajectories(box);
    if constexpr (coulomb) add_friction(box);
    if (box.is_coupled) {
        find_modes(box);
        set_modes(box);
        set_coupled_bounds(box);
    } else {
        set_bounds(box);
    }
}

} // namespace

template <bool coulomb>
OneBoxStepper<coulomb>::OneBoxStepper(const Description& /*description*/, const WorldConfig& config,
                                      const WorldState& state)
    : body_{movable_box(state.bodies).id},
      oscillators_{config.hands, movable_box(state.bodies), config.tick},
      obstacles_{config, state.bodies, movable_box(state.bodies)},
      hands_{config, state.bodies, movable_box(state.bodies)}
{
    const PerAxis mobility = per_axis(movable_box(state.bodies).inverse_mass);
    is_alone_ = config.planes.empty() && state.bodies.size() == 1 && !oscillators_.are_soft();
    for (std::size_t i = 0; i < 3; ++i) {
        locked_[i] = mobility[i] == 0.0;
        if (locked_[i]) is_alone_ = false;
    }
}

template <bool coulomb>
void OneBoxStepper<coulomb>::step(const WorldConfig& config, WorldState& state)
{
    state.tick_cost.events = 0;
    BoxMotion box{config.hands, oscillators_, obstacles_, room_};
    set_start(config, state, box);
    query_obstacles(box, 0.0);
    if (obstacles_.push_out(box.nearby, box.position)) {
        query_obstacles(box, 0.0);
        box.is_exact = false;
    }
    hands_.collide(config, state, box);
    if (box.grip_count == 0) {
        run_events(config, state, box);
        commit(config, state, box);
    } else {
        solve_with_grips(config, state, box);
    }
}

/// Sets position, velocity and the accelerations that hold for the whole tick: gravity and pushes.
template <bool coulomb>
inline void OneBoxStepper<coulomb>::set_start(const WorldConfig& config, const WorldState& state,
                                              BoxMotion& box)
{
    was_pushed_ = !state.pushed.is_empty();
    const Slot slot = state.bodies.slot_of[body_];
    box.time_left = config.tick;
    box.position = per_axis(state.bodies.position.at(slot));
    box.velocity = per_axis(state.bodies.velocity.at(slot));
    const PerAxis gravity = per_axis(config.gravity);
    for (std::size_t i = 0; i < 3; ++i) {
        if (locked_[i]) box.velocity[i] = 0.0;
        box.axes[i].is_locked = box.axes[i].is_stopped = locked_[i];
        box.axes[i].is_losing_support = false;
        box.axes[i].applied_acceleration = gravity[i];
    }
    if (state.pushed.is_empty()) return;
    last_push_ = state.pushes[body_];
    const PerAxis push = per_axis(last_push_);
    for (std::size_t i = 0; i < 3; ++i)
        box.axes[i].applied_acceleration += oscillators_.inverse_mass() * push[i];
}

template <bool coulomb>
inline void OneBoxStepper<coulomb>::query_obstacles(BoxMotion& box, double reach)
{
    box.nearby = obstacles_.nearby(box.position, reach);
    box.clearance = obstacles_.clearance(box.position);
}

template <bool coulomb>
void OneBoxStepper<coulomb>::solve_with_grips(const WorldConfig& config, WorldState& state,
                                              BoxMotion& start)
{
    for (;;) { // once more for each hand whose grip is limited
        BoxMotion box = start.copy();
        query_obstacles(box, 0.0); // the last try may have moved the list elsewhere
        run_events(config, state, box);
        if (BoxHands::limit_grip(config, state, box, start)) continue;
        commit(config, state, box);
        return;
    }
}

template <bool coulomb>
inline void OneBoxStepper<coulomb>::commit(const WorldConfig& config, WorldState& state,
                                           BoxMotion& box) const
{
    const Slot slot = state.bodies.slot_of[body_];
    BoxHands::report(config, state, box);
    if (!box.is_exact) settle_tick(config, state, box);
    if (is_alone_) box.velocity = velocity_from_hands(config, state);
    state.bodies.position.put(slot, vector(box.position));
    state.bodies.velocity.put(slot, vector(box.velocity));
}

template <bool coulomb>
PerAxis OneBoxStepper<coulomb>::steady_acceleration(const WorldConfig& config,
                                                    const WorldState& state) const
{
    PerAxis steady = per_axis(config.gravity);
    const PerAxis push = state.pushed.is_empty() ? PerAxis{} : per_axis(state.pushes[body_]);
    for (std::size_t i = 0; i < 3; ++i) {
        steady[i] += oscillators_.inverse_mass() * push[i];
        if (locked_[i]) steady[i] = 0.0;
    }
    return steady;
}

template <bool coulomb>
PerAxis OneBoxStepper<coulomb>::velocity_from_hands(const WorldConfig& config,
                                                    const WorldState& state) const
{
    glm::dvec3 impulse{0.0};
    for (std::uint32_t i = 0; i < config.hands.count; ++i)
        impulse += config.tick * state.touches[i].on_body.value;
    const PerAxis given = per_axis(impulse);
    const PerAxis steady = steady_acceleration(config, state);
    PerAxis velocity = per_axis(state.bodies.velocity.at(state.bodies.slot_of[body_]));
    for (std::size_t i = 0; i < 3; ++i)
        velocity[i] += config.tick * steady[i] + oscillators_.inverse_mass() * given[i];
    return velocity;
}

template <bool coulomb>
void OneBoxStepper<coulomb>::settle_tick(const WorldConfig& config, WorldState& state,
                                         BoxMotion& box) const
{
    const Slot slot = state.bodies.slot_of[body_];
    TickStart start{.position = per_axis(state.bodies.position.at(slot)),
                    .velocity = per_axis(state.bodies.velocity.at(slot)),
                    .steady = steady_acceleration(config, state)};
    start.stored = hands_.stored_in_grips(config, state, start.position);
    for (std::size_t i = 0; i < 3; ++i) {
        if (locked_[i]) start.velocity[i] = 0.0;
    }
    settle(config, state, start, box);
}

template <bool coulomb>
void OneBoxStepper<coulomb>::run_events(const WorldConfig& config, WorldState& state,
                                        BoxMotion& box)
{
    room_.root_steps = root_steps_max;
    start_interval<coulomb>(box);
    if (box.held_count > 0) {
        BoxHands::add_held_springs(box);
        start_interval<coulomb>(box);
    }
    for (int events = 1;; ++events) {
        ++state.tick_cost.events;
        const double reach =
            std::max(std::max(box.axes[0].reach, box.axes[1].reach), box.axes[2].reach);
        if (!(reach <= box.clearance)) query_obstacles(box, reach);
        Event event{.time = box.time_left};
        if (!is_uneventful(box)) find_event(box, event);
        if constexpr (coulomb) find_friction_event(box, event);
        advance(box, event.time);
        if (events == 1) {
            was_eventful_ = event.kind != Event::Kind::none;
            if (!was_eventful_) return;
            contact_momentum_ = {};
        }
        add_support(box, event.time);
        if (event.kind == Event::Kind::none) return;
        const PerAxis before = box.velocity;
        handle_event(box, event, config.tick);
        if (event.kind == Event::Kind::impact)
            contact_momentum_[event.axis] += box.velocity[event.axis] - before[event.axis];
        if (box.time_left <= 0.0) return;
        box.clearance = obstacles_.clearance(box.position);
        start_interval<coulomb>(box);
        if (events < events_max && event.kind != Event::Kind::unknown) continue;
        ++crowded_ticks_;
        box.is_exact = false;
        if (finish_tick(box)) ++state.interventions.paths_cut;
        return;
    }
}

/// Adds the impulse of the box's supports over a time to the impulse of its obstacles.
template <bool coulomb>
void OneBoxStepper<coulomb>::add_support(const BoxMotion& box, double time)
{
    for (std::size_t i = 0; i < 3; ++i) {
        const AxisMotion& axis = box.axes[i];
        if (!axis.support) continue;
        const double pressed = time * (axis.load + 0.5 * time * axis.load_ramp);
        contact_momentum_[i] += axis.support == axis.below ? pressed : -pressed;
    }
}

template <bool coulomb>
glm::dvec3 OneBoxStepper<coulomb>::contact_impulse(const WorldConfig& config,
                                                   const WorldState& state) const
{
    const double mass = 1.0 / oscillators_.inverse_mass();
    if (was_eventful_) return mass * vector(contact_momentum_);
    // No contact began or ended, so axes that stood still were in balance.
    glm::dvec3 given = mass * config.gravity;
    if (was_pushed_) given += last_push_;
    for (std::uint32_t hand = 0; hand < config.hands.count; ++hand)
        given += state.touches[hand].on_body.value;
    const glm::dvec3 velocity = state.bodies.velocity.at(state.bodies.slot_of[body_]);
    for (int i = 0; i < 3; ++i) {
        if (velocity[i] != 0.0) given[i] = 0.0;
    }
    return -config.tick * given;
}

template <bool coulomb>
void OneBoxStepper<coulomb>::on_body_placed(WorldState& /*state*/, BodyId /*body*/)
{
    hands_.forget_box();
}

template <bool coulomb>
void OneBoxStepper<coulomb>::on_body_shifted(WorldState& /*state*/, BodyId /*body*/)
{}

template class OneBoxStepper<false>;
template class OneBoxStepper<true>;

} // namespace hapnet::scene
