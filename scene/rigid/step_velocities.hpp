// SPDX-FileCopyrightText: 2026 The Hapnet authors
// SPDX-License-Identifier: MIT
#pragma once

// The stages that find the velocities of a tick: the effects of outside forces, and the changes by
// contacts. Part of step.cpp, which makes the steppers.
#include "scene/rigid/step.hpp"

namespace hapnet::scene {

/// Finds the velocities of the active bodies at the end of the tick, without the changes by their
/// contacts.
template <BroadPhase broad_phase>
void RigidStepper<broad_phase>::integrate_velocities(const WorldConfig& config, WorldState& state)
{
    for (const BodyId body : state.pushed) activate(state.bodies, state.bodies.slot_of[body]);
    // A torque is held for the tick, as last tick's contact forces are.
    for (const BodyId body : state.twisted)
        integrations_[state.bodies.slot_of[body] + 1].contact_angular_impulse +=
            scales_.tick * state.torques[body];
    integrate_hand_springs(config, state);
    for (const Slot slot : active_.slots()) {
        BodyIntegration& integration = integrations_[slot + 1];
        if (!integration.has_hands)
            integrate_velocity(integration, state, slot, solver_.response(slot + 1), config);
        if (restitution_.is_needed()) begin_bounces(integration);
    }
}

template <BroadPhase broad_phase>
void RigidStepper<broad_phase>::integrate_hand_springs(const WorldConfig& config, WorldState& state)
{
    const auto springs_of_all = hand_contacts_.springs();
    for (std::size_t i = 0; i < springs_of_all.size(); ++i) {
        const HandContacts::Spring& spring = springs_of_all[i];
        if (i > 0 && spring.body == springs_of_all[i - 1].body) continue; // that body is done
        const Slot slot = state.bodies.slot_of[spring.body];
        activate(state.bodies, slot);
        if (!integrations_[slot + 1].has_hands) integrate_hand_springs_on(config, state, spring);
    }
}

template <BroadPhase broad_phase>
void RigidStepper<broad_phase>::integrate_hand_springs_on(const WorldConfig& config,
                                                          WorldState& state,
                                                          const HandContacts::Spring& spring)
{
    const Slot slot = state.bodies.slot_of[spring.body];
    BodyIntegration& integration = integrations_[slot + 1];
    const auto [springs, work] = hand_contacts_.springs_on(spring.body);
    const std::span<FrictionSpring> frictions = hand_contacts_.frictions_on(spring.body);
    integrate_velocity_with_hands(integration, state, slot, solver_.response(slot + 1),
                                  {springs, work, modes_[spring.hand], config, frictions});
    hand_contacts_.store_impulses(spring.body);
    if (!frictions.empty()) hand_contacts_.store_friction(state, spring.body);
    if (integration.hands_are_braked) ++state.interventions.hands_braked;
    state.tick_cost.spring_rows += integration.hand_rows;
}

/// Finds the velocities at the end of the tick at which nothing penetrates, and from them the mean
/// velocities. Returns true if last tick's contact forces had to change for that.
template <BroadPhase broad_phase>
bool RigidStepper<broad_phase>::solve_velocities(TickCost& cost)
{
    for (const Slot slot : active_.slots())
        solver_.end_motion(slot + 1) = integrations_[slot + 1].predicted;
    for (ContactBlock& block : solver_.blocks()) {
        set_centripetal_velocity(block, integrations_[block.a].start.spin,
                                 integrations_[block.b].start.spin, scales_.tick);
        restitution_.leave_coming(block, integrations_.all());
    }
    const SolverOutcome outcome = solver_.solve_velocities(velocity_limits());
    cost.contacts = solver_.blocks().size();
    cost.visits += outcome.visits;
    counts_.contacts = static_cast<std::uint32_t>(solver_.blocks().size());
    counts_.sweeps = outcome.sweeps;
    counts_.change = outcome.change;
    set_mean_motions();
    return !outcome.in_balance;
}

/// Sets the mean motions from the velocities at the end of the tick.
template <BroadPhase broad_phase>
void RigidStepper<broad_phase>::set_mean_motions()
{
    for (const Slot slot : active_.slots()) {
        const BodyIntegration& integration = integrations_[slot + 1];
        const BodyMotion& end = solver_.end_motion(slot + 1);
        solver_.mean_motion(slot + 1) = {
            integration.mean.velocity + 0.5 * (end.velocity - integration.predicted.velocity),
            integration.mean.spin + 0.5 * (end.spin - integration.predicted.spin),
            integration.bounce_angular_impulse_mean + 0.5 * end.angular_impulse};
    }
}

/// Solves islands that gain energy again, without a warm start. Last tick's contact forces count as
/// constant forces. They may be wrong when the bodies that bore them are gone or a wedge has
/// opened. If the sweeps end before these forces have decayed, the forces drive bodies. Without a
/// warm start every visit removes energy, so the solver may stop at any time.
template <BroadPhase broad_phase>
void RigidStepper<broad_phase>::solve_anew_what_gains(const WorldConfig& config, WorldState& state)
{
    const std::span<const std::uint8_t> gaining = energy_.gaining(energy_tick(config, state));
    if (gaining.empty()) return;
    const auto is_gaining = [&](const ContactBlock& block) {
        return gaining[solver_.responding_of(block)] != 0;
    };
    for (ContactBlock& block : solver_.blocks()) {
        if (!is_gaining(block)) continue;
        forget_impulses(block);
        set_least_speeds(block);
        set_centripetal_velocity(block, integrations_[block.a].start.spin,
                                 integrations_[block.b].start.spin, scales_.tick);
    }
    for (const Slot slot : active_.slots()) {
        if (gaining[slot + 1] == 0) continue;
        const BodyId body = state.bodies.properties[slot].id;
        BodyIntegration& integration = integrations_[slot + 1];
        begin_again(integration, scales_.tick * state.torques[body]);
        if (integration.has_hands)
            integrate_hand_springs_on(config, state, hand_contacts_.first_spring_on(body));
        else
            integrate_velocity(integration, state, slot, solver_.response(slot + 1), config);
        if (restitution_.is_needed()) begin_bounces(integration);
    }
    restitution_.apply(solver_, integrations_.all(), state.interventions, gaining);
    for (ContactBlock& block : solver_.blocks())
        if (is_gaining(block)) restitution_.leave_coming(block, integrations_.all());
    for (const Slot slot : active_.slots()) {
        if (gaining[slot + 1] != 0)
            solver_.end_motion(slot + 1) = integrations_[slot + 1].predicted;
    }
    state.tick_cost.visits += solver_.solve_velocities_anew(velocity_limits(), gaining).visits;
    set_mean_motions();
}

} // namespace hapnet::scene
