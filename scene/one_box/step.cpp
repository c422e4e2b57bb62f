// SPDX-FileCopyrightText: 2026 The Hapnet authors
// SPDX-License-Identifier: MIT
#include "scene/one_box/step.hpp"

#include "proto/base/ensure.hpp"
#include "scene/one_box/events.hpp"
#include "scene/one_box/friction.hpp"

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
    set_bounds(box);
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
    for (std::size_t i = 0; i < 3; ++i) locked_[i] = mobility[i] == 0.0;
}

template <bool coulomb>
void OneBoxStepper<coulomb>::step(const WorldConfig& config, WorldState& state)
{
    BoxMotion box{config.hands, oscillators_, obstacles_};
    set_start(config, state, box);
    query_obstacles(box, 0.0);
    if (obstacles_.push_out(box.nearby, box.position)) query_obstacles(box, 0.0);
    hands_.collide(config, state, box);
    if (box.grip_count == 0) {
        run_events(config, box);
        commit(config, state, box);
    } else {
        solve_with_grips(config, state, box);
    }
}

/// Position, velocity and the accelerations that hold for the whole tick: gravity and pushes.
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
        box.axes[i].is_stopped = locked_[i];
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
    for (;;) { // each time a hand holds less
        BoxMotion box = start.copy();
        query_obstacles(box, 0.0); // the last try may have asked elsewhere
        run_events(config, box);
        if (BoxHands::limit_grip(config, state, box, start)) continue;
        commit(config, state, box);
        return;
    }
}

template <bool coulomb>
void OneBoxStepper<coulomb>::commit(const WorldConfig& config, WorldState& state,
                                    const BoxMotion& box) const
{
    const Slot slot = state.bodies.slot_of[body_];
    state.bodies.position.put(slot, vector(box.position));
    state.bodies.velocity.put(slot, vector(box.velocity));
    BoxHands::report(config, state, box);
}

template <bool coulomb>
void OneBoxStepper<coulomb>::run_events(const WorldConfig& config, BoxMotion& box)
{
    start_interval<coulomb>(box);
    if (box.edge_spring_count > 0) {
        BoxHands::add_edge_springs(box);
        start_interval<coulomb>(box);
    }
    for (int events = 1;; ++events) {
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
        if (events == events_max) {
            box.event_limit_reached = true;
            ++crowded_ticks_;
        }
        if (box.time_left <= 0.0) return;
        box.clearance = obstacles_.clearance(box.position);
        start_interval<coulomb>(box);
    }
}

/// Adds what carries the box for a time to what its obstacles give it.
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
    // Nothing began or ended: what stood still was in balance.
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

template class OneBoxStepper<false>;
template class OneBoxStepper<true>;

} // namespace hapnet::scene
