// SPDX-FileCopyrightText: 2026 The Hapnet authors
// SPDX-License-Identifier: MIT
#pragma once

// Steady ticks: ticks that go on as the one before, as most ticks do. One body rests or slides on a
// plane, and one or two hands press it amid the faces that they pressed before. Then the stages of
// step() have one body and one contact, whose data are where the last tick left them, and balanced
// forces. The bits are those of step(): each number is found by the same operations. If a tick
// turns out not to be steady, nothing has been changed yet, and step() runs it from its start. Part
// of step.cpp, which makes the steppers.
#include "scene/hand/constant_contact.hpp"
#include "scene/rigid/step.hpp"
#include "scene/solver/block_solver.hpp"

#include <glm/geometric.hpp>
#include <utility>

namespace hapnet::scene {

/// True if the scene has nothing that rules out steady ticks.
template <BroadPhase broad_phase>
bool RigidStepper<broad_phase>::can_be_steady(const WorldConfig& config,
                                              const WorldState& state) const
{
    const Bodies& bodies = state.bodies;
    return bodies.movable > 0 && bodies.moving == bodies.movable && bodies.parts.empty() &&
           !any_round_ && !restitution_.is_needed() && !hand_contacts_.feels_planes() &&
           !hand_contacts_.any_friction() && config.hands.count > 0;
}

/// Finds out if the next tick may be steady. The last tick must have ended in balance.
template <BroadPhase broad_phase>
void RigidStepper<broad_phase>::look_for_steadiness(const WorldConfig& config,
                                                    const WorldState& state)
{
    const Bodies& bodies = state.bodies;
    const BodyProperties& body = bodies.properties[0];
    // The solver visited the contact once for velocities and never for overlaps.
    const bool is_alone = bodies.awake == 1 && state.pushed.is_empty() && pairs_.pairs().empty() &&
                          !any_far_ && state.tick_cost.contacts == 1 && state.tick_cost.visits == 1;
    if (!is_alone || body.turning != Turning::free || !body.is_isotropic || body.drag > 0.0) return;
    const ContactBlock& block = solver_.blocks()[0];
    const BodyIntegration& integration = integrations_[1];
    if (!block.is_on_plane || block.has_matrix || !integration.has_hands) return;
    if (!hand_contacts_.may_press_again(config)) return;
    steady_ = {true, true, body.id, boxes_.at(bodies, body.id).turns,
               dynamics_of(integration, state, 0, solver_.response(1), config)};
}

/// True if the hands and the plane touch the body as in the last tick.
template <BroadPhase broad_phase>
bool RigidStepper<broad_phase>::finds_the_same(const WorldConfig& config, WorldState& state)
{
    const Bodies& bodies = state.bodies;
    const bool is_alone = bodies.awake == 1 && bodies.properties[0].id == steady_.body &&
                          state.pushed.is_empty() && solver_.blocks().size() == 1 &&
                          pairs_.pairs().empty() && pairs_.plane_pairs().size() == 1;
    if (!is_alone) return false;
    const SweptBox& now = boxes_.at(bodies, steady_.body);
    if (now.turns != steady_.turns) return false;
    for (std::uint32_t hand = 0; hand < config.hands.count; ++hand) {
        const HandInput& input = state.hands[hand];
        std::span<const PartId> near;
        if (input.present && !input.gripping) {
            const glm::dvec3& from = input.position.value;
            near = pairs_.near_hand(
                hand, {from, from + scales_.tick * input.velocity.value, config.hands.radius_m});
        }
        if (!hand_contacts_.pressing().is_where_it_was(hand, input, near)) return false;
    }
    if (!hand_contacts_.press_again(state, now, bodies.velocity.at(0))) return false;
    const Pair& pair = pairs_.plane_pair(pairs_.plane_pairs()[0]);
    const PlaneDescription& plane = config.planes[pair.b];
    const double height = glm::dot(plane.normal, now.box.centre) - plane.offset_m;
    PlaneContact& contact = plane_contacts_[0];
    contact.find({pair.a, pair.b, plane.normal, height, now.reach, now.box.axes, now.orientation,
                  now.box.half, now.box.rounding});
    return contact.prepare_again(solver_.blocks()[0], pair.memory);
}

/// Runs a steady tick. Returns false if the tick is not steady. Then only work has been done that
/// step() does again.
template <BroadPhase broad_phase>
bool RigidStepper<broad_phase>::step_steadily(const WorldConfig& config, WorldState& state)
{
    if (!std::exchange(steady_.is_likely, false) || !finds_the_same(config, state)) return false;
    Bodies& bodies = state.bodies;
    const BodyProperties& properties = bodies.properties[0];
    ContactBlock& block = solver_.blocks()[0];
    const double per_second = 1.0 / config.tick;
    const BodyResponse& response = solver_.response(1);
    const auto& [push, turn] = block.start_push;
    const glm::dvec3 torque = glm::dvec3{0.0} + (glm::cross(block.arm_b, push) + turn);
    steady_.dynamics.torque = per_second * torque;
    // The velocities at the end of the tick, and the mean velocities.
    const MovingBody start{bodies.position.at(0), bodies.orientation.at(0), bodies.velocity.at(0),
                           bodies.angular_momentum.at(0)};
    MovingBody body = start;
    const PressingHands& pressing = hand_contacts_.pressing();
    TwoVectors impulse;
    if (!advance_in_constant_contact(body, steady_.dynamics, pressing.springs(), config.tick,
                                     modes_[pressing.hand(0)], impulse))
        return false;
    BodyIntegration& integration = integrations_[1];
    integration.start.velocity = start.velocity;
    integration.start.spin = response.inverse_inertia * start.angular_momentum;
    const BodyMotion end{body.velocity, response.inverse_inertia * body.angular_momentum,
                         glm::dvec3{0.0}};
    const glm::dvec3 mean_velocity = per_second * (body.position - start.position);
    BodyMotion mean{mean_velocity + glm::dvec3{0.0},
                    0.5 * (integration.start.spin + end.spin) + glm::dvec3{0.0}, glm::dvec3{0.0}};

    // The contact is in balance and stays so.
    set_least_speeds(block);
    set_centripetal_velocity(block, glm::dvec3{0.0}, integration.start.spin, scales_.tick);
    if (block.turns || !is_solved(block, velocity_at(block, {}, end), velocity_limits().tolerance))
        return false;
    const double push_sum = block.normal_sum();
    if (block.friction != 0.0 && push_sum > 0.0)
        apply_stop(block, {integration, glm::dvec3{0.0}}, properties, scales_, mean);
    set_least_ways(block);
    if (solver_.overlaps(block, normal_velocity_at(block, {}, mean), position_limits()) ||
        goes_far(properties, mean, scales_))
        return false;

    // The tick is steady and complete.
    ContactMemory& memory = pairs_.plane_pair(pairs_.plane_pairs()[0]).memory;
    ++memory.ticks;
    memory.normal_impulse_of_tick = push_sum + 0.0;
    bodies.orientation.put(0, body.orientation);
    bodies.position.put(0, body.position + scales_.tick * (mean.velocity - mean_velocity));
    bodies.velocity.put(0, end.velocity);
    bodies.angular_momentum.put(0, body.angular_momentum + glm::dvec3{0.0});
    state.tick_cost = {.pairs = 1, .contacts = 1, .visits = 1};
    counts_.contacts = counts_.sweeps = 1;
    counts_.change = 0.0;
    ++counts_.steady_ticks;
    pressing.report(config, state, impulse);
    sleep_.keep_awake(bodies, steady_.body);
    update_sleep(state);
    steady_.is_likely = true;
    return true;
}

} // namespace hapnet::scene
