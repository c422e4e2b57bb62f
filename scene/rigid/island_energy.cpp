// SPDX-FileCopyrightText: 2026 The Hapnet authors
// SPDX-License-Identifier: MIT
#include "scene/rigid/island_energy.hpp"

#include "scene/maths/rotation.hpp"
#include "scene/maths/vector.hpp"

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>
#include <glm/matrix.hpp>

namespace hapnet::scene {

namespace {

// The error of a sum, as a share of all amounts in it.
constexpr double sum_rounding = 1e-14;
// Two surfaces that close at a small angle squeeze a body out faster than they move, without limit
// as the angle goes to 0. In contacts the speed of a surface counts as up to `squeezed_max` times
// its value, but not as more than `squeezed_way` smallest half edges in a tick, unless the surface
// itself is faster. A body that goes farther leaves the surfaces within the tick.
constexpr double squeezed_max = 5.0, squeezed_way = 0.05;
// The errors of a solver that ends its sweeps early: this share of the present energy, and this
// multiple of the speed that gravity adds in a tick. They are no reason to solve again.
constexpr double unfinished_share = 1e-6, unfinished_speeds = 2.0;

/// Returns the force on a body's centre from outside, N.
glm::dvec3 load_on(const WorldConfig& config, const WorldState& state,
                   const BodyProperties& properties)
{
    return properties.mass * (gravity_on(properties, config.gravity) +
                              properties.inverse_mass * state.pushes[properties.id]);
}

DrivenEnergy with_squeezing(const Scales& scales, const DrivenEnergy& driven,
                            const BodyProperties& properties)
{
    const double most = squeezed_way * properties.least_half * scales.rate;
    return {driven.energy, std::max(driven.speed, std::min(squeezed_max * driven.speed, most))};
}

/// True if the body does not keep its momentum along some axis.
bool is_locked(const BodyProperties& properties)
{
    const glm::dvec3& light = properties.inverse_mass;
    return light.x == 0.0 || light.y == 0.0 || light.z == 0.0;
}

glm::dmat3 inertia_of(const BodyProperties& properties, const glm::dquat& orientation)
{
    const glm::dmat3 axes = axes_of(orientation);
    const glm::dmat3 own{glm::dvec3{properties.inertia.x, 0.0, 0.0},
                         glm::dvec3{0.0, properties.inertia.y, 0.0},
                         glm::dvec3{0.0, 0.0, properties.inertia.z}};
    return axes * own * glm::transpose(axes);
}

} // namespace

bool IslandEnergy::gains(const Account& account)
{
    // The work of a moving surface is known to second order in the tick.
    const double slack = account.is_driven ? unfinished_share * account.there + account.rest
                                           : sum_rounding * account.there;
    return account.kinetic - account.allowed_at(1.0) > slack;
}

IslandEnergy::Start IslandEnergy::start_of(const Tick& tick, const ContinuousCollision* touches,
                                           Slot slot)
{
    if (!tick.active.contains(slot)) {
        const ContinuousCollision::Beginning& from = touches->beginning(slot);
        return {from.position, from.orientation, from.velocity, from.angular_momentum};
    }
    const BodyIntegration& integration = tick.integrations[slot + 1];
    return {integration.start_position, integration.start_orientation, integration.start.velocity,
            integration.start_angular_momentum};
}

IslandEnergy::IslandEnergy(const Bodies& bodies)
    : accounts_{bodies.moving + std::size_t{1}},
      gaining_{bodies.moving + std::size_t{1}},
      islands_{bodies.moving + std::size_t{1}},
      slots_{bodies.movable}
{}

void IslandEnergy::Account::add(const Account& other)
{
    allowed += other.allowed;
    driven.add(other.driven);
    passed += other.passed;
    motion += other.motion;
    kinetic += other.kinetic;
    there += other.there;
    rest += other.rest;
    is_held = is_held || other.is_held;
    is_driven = is_driven || other.is_driven;
    is_near = is_near || other.is_near;
    can_turn = can_turn && other.can_turn;
    lifted += other.lifted;
    has_hands = has_hands || other.has_hands;
    momentum += other.momentum;
    moment += other.moment;
    angular += other.angular;
    momentum_before += other.momentum_before;
    moment_before += other.moment_before;
    angular_before += other.angular_before;
    is_closed = is_closed && other.is_closed;
    mass += other.mass;
}

/// Returns a body's account with the velocities that the solver found. The body has not moved yet.
IslandEnergy::Account IslandEnergy::velocities_of(const Tick& tick, Slot slot)
{
    const Bodies& bodies = tick.state.bodies;
    const BodyProperties& properties = bodies.properties[slot];
    const BodyIntegration& integration = tick.integrations[slot + 1];
    const BodyMotion& end = tick.solver.end_motion(slot + 1);
    const BodyMotion& mean = tick.solver.mean_motion(slot + 1);
    const double mass = properties.mass;
    const glm::dvec3 momentum =
        about_unlocked_axes(properties, integration.angular_momentum + end.angular_impulse +
                                            integration.bounce_angular_impulse);
    const double before = bodies.kinetic_energy(slot);
    const double work =
        tick.config.tick *
        (glm::dot(load_on(tick.config, tick.state, properties), mean.velocity) +
         glm::dot(about_unlocked_axes(properties, tick.state.torques[properties.id]), mean.spin));
    const double slow = unfinished_speeds * tick.scales.speed;
    Account account;
    account.kinetic =
        0.5 * (mass * glm::dot(end.velocity, end.velocity) + glm::dot(momentum, end.spin));
    account.allowed = before + work + integration.own_work + integration.driven.energy;
    account.there = before + account.kinetic + std::abs(work);
    account.rest = mass * slow * slow;
    return account;
}

std::span<const std::uint8_t> IslandEnergy::gaining(const Tick& tick)
{
    const std::span<const Slot> slots = tick.active.slots();
    accounts_.resize(tick.state.bodies.awake + std::size_t{1});
    const auto gains = [](const Account& account) {
        return account.kinetic - account.allowed > unfinished_share * account.there + account.rest;
    };
    bool any = false;
    for (const Slot slot : slots) {
        accounts_[slot + 1] = velocities_of(tick, slot);
        any = any || gains(accounts_[slot + 1]);
    }
    if (!any) return {};
    join_islands(tick, slots);
    sum_islands(slots);
    // A body that a moving surface drives needs its warm-start impulses.
    for (const ContactBlock& block : tick.solver.blocks()) {
        if (tick.solver.is_kinematic(block.a) || tick.solver.is_kinematic(block.b))
            accounts_[islands_.root_of(tick.solver.responding_of(block))].allowed = HUGE_VAL;
    }
    gaining_.resize(tick.integrations.size());
    std::fill(gaining_.all().begin(), gaining_.all().end(), std::uint8_t{0});
    any = false;
    for (const Slot slot : slots) {
        if (!gains(accounts_[islands_.root_of(slot + 1)])) continue;
        gaining_[slot + 1] = 1;
        any = true;
        if (islands_.root_of(slot + 1) == slot + 1) ++tick.state.interventions.islands_anew;
    }
    return any ? gaining_.all() : std::span<const std::uint8_t>{};
}

void IslandEnergy::begin(const Tick& tick)
{
    for (const Slot slot : tick.active.slots()) {
        BodyIntegration& integration = tick.integrations[slot + 1];
        integration.start_position = tick.state.bodies.position.at(slot);
        integration.start_orientation = tick.state.bodies.orientation.at(slot);
        integration.start_angular_momentum = tick.state.bodies.angular_momentum.at(slot);
        integration.start_energy = tick.state.bodies.kinetic_energy(slot);
    }
}

IslandEnergy::Account IslandEnergy::outcome_of(const Tick& tick, const ContinuousCollision* touches,
                                               Slot slot)
{
    const Bodies& bodies = tick.state.bodies;
    const BodyProperties& properties = bodies.properties[slot];
    const glm::dvec3 position = bodies.position.at(slot), velocity = bodies.velocity.at(slot);
    const glm::dvec3 angular = bodies.angular_momentum.at(slot);
    const glm::dvec3 load = load_on(tick.config, tick.state, properties);
    Account account;
    const Start start = start_of(tick, touches, slot);
    double before = 0.0;
    if (tick.active.contains(slot)) {
        const BodyIntegration& integration = tick.integrations[slot + 1];
        before = integration.start_energy;
        account.allowed = integration.own_work;
        account.driven = with_squeezing(tick.scales, integration.driven, properties);
        if (account.driven.speed > 0.0) {
            // A hand that yields takes the energy that a surface gives. That energy leaves no
            // momentum.
            account.driven.energy += std::min(integration.own_work, 0.0);
            account.allowed = std::max(integration.own_work, 0.0);
        }
        account.has_hands = integration.has_hands;
        const glm::dvec3 torque =
            about_unlocked_axes(properties, tick.state.torques[properties.id]);
        if (torque != glm::dvec3{0.0})
            account.allowed += glm::dot(
                torque, turn_between(integration.start_orientation, bodies.orientation.at(slot)));
    } else {
        const glm::dvec3 spin =
            Bodies::apply_inverse_inertia(properties, start.orientation, start.angular_momentum);
        before = 0.5 * (properties.mass * glm::dot(start.velocity, start.velocity) +
                        glm::dot(start.angular_momentum, spin));
    }
    if (touches != nullptr) account.driven.add(touches->beginning(slot).driven);
    account.passed =
        length(properties.mass * (velocity - start.velocity) - tick.config.tick * load) +
        length(angular - start.angular_momentum) / properties.least_half;
    account.motion = properties.mass * length(velocity) + length(angular) / properties.least_half;
    const double work = glm::dot(load, position - start.position);
    account.allowed += before + work;
    account.kinetic = bodies.kinetic_energy(slot);
    account.there = before + account.kinetic + std::abs(work);
    const double slow = unfinished_speeds * tick.scales.speed;
    account.rest = properties.mass * slow * slow;
    account.lifted =
        std::max(0.0, glm::dot(load, (0.5 * tick.config.tick) * (start.velocity + velocity) -
                                         (position - start.position)));
    account.is_held = is_locked(properties);
    account.can_turn = properties.turning == Turning::free;
    account.mass = properties.mass;
    account.momentum = properties.mass * velocity;
    account.moment = properties.mass * position;
    account.angular = glm::cross(position, account.momentum) + angular;
    account.momentum_before = properties.mass * start.velocity;
    account.moment_before = properties.mass * start.position;
    account.angular_before =
        glm::cross(start.position, account.momentum_before) + start.angular_momentum;
    account.is_closed = !account.has_hands && tick.state.is_pushed[properties.id] == 0;
    return account;
}

void IslandEnergy::settle(const Tick& tick, const ContinuousCollision* touches)
{
    const Bodies& bodies = tick.state.bodies;
    slots_.clear();
    for (const Slot slot : tick.active.slots()) slots_.add(slot);
    if (touches != nullptr) {
        touches->for_changed(bodies, [&](Slot slot) {
            if (!tick.active.contains(slot)) slots_.add(slot);
        });
    }
    accounts_.resize(bodies.movable + std::size_t{1});
    bool any = false;
    for (const Slot slot : slots_) {
        accounts_[slot + 1] = outcome_of(tick, touches, slot);
        any = any || gains(accounts_[slot + 1]);
    }
    if (!any) return;
    join_islands(tick, slots_.all());
    if (touches != nullptr)
        touches->for_pushes(bodies, [&](Slot a, Slot b) { islands_.join(a + 1, b + 1); });
    if (!find_gaining(tick, touches)) return;
    mend_ways(tick, touches);
    for (const Slot slot : slots_) accounts_[slot + 1] = outcome_of(tick, touches, slot);
    if (!find_gaining(tick, touches)) return;
    for (const Slot slot : slots_) {
        Account& island = accounts_[slot + 1];
        island.is_held = island.is_held || island.is_near;
    }
    find_rigid(tick, slots_.all());
    for (const Slot slot : slots_) {
        Account& island = accounts_[slot + 1];
        if (islands_.root_of(slot + 1) == slot + 1 && island.share != 1.0)
            find_share(island, tick.state.interventions);
    }
    for (const Slot slot : slots_) {
        slow(tick, slot);
        cut_way(tick, touches, slot);
    }
}

/// Sums up the islands, and marks those that gained by a share that is not 1. Returns whether any
/// did.
bool IslandEnergy::find_gaining(const Tick& tick, const ContinuousCollision* touches)
{
    note_held(tick);
    if (touches != nullptr) {
        touches->for_walls(
            tick.state.bodies, [&](Slot slot, const ContinuousCollision::Wall& wall) {
                Account& island = accounts_[islands_.root_of(slot + 1)];
                island.is_near = true;
                island.is_held = island.is_held || wall.has_pushed;
                island.is_driven = island.is_driven || (wall.has_pushed && wall.is_kinematic);
            });
    }
    sum_islands(slots_.all());
    bool any = false;
    for (const Slot slot : slots_) {
        Account& island = accounts_[slot + 1];
        if (islands_.root_of(slot + 1) != slot + 1 || !gains(island)) continue;
        island.share = 0.0;
        any = true;
    }
    return any;
}

/// Restores two laws in an island that gained energy. The centre of an island that nothing holds
/// moves by its momentum. A body turns to an orientation in which its angular momentum gives no
/// more energy than at the start. The correction of overlaps may have violated both.
void IslandEnergy::mend_ways(const Tick& tick, const ContinuousCollision* touches)
{
    Bodies& bodies = tick.state.bodies;
    const auto is_free = [](const Account& island) {
        return island.share != 1.0 && !island.is_held && !island.has_hands;
    };
    for (const Slot slot : slots_) {
        Account& island = accounts_[islands_.root_of(slot + 1)];
        if (!is_free(island)) continue;
        const Start start = start_of(tick, touches, slot);
        const glm::dvec3 steady =
            (0.5 * tick.config.tick) * (start.velocity + bodies.velocity.at(slot));
        island.stray +=
            bodies.properties[slot].mass * (bodies.position.at(slot) - start.position - steady);
    }
    for (const Slot slot : slots_) {
        const Account& island = accounts_[islands_.root_of(slot + 1)];
        if (!is_free(island)) continue;
        if (!island.is_near)
            bodies.position.put(slot, bodies.position.at(slot) - island.stray / island.mass);
        const BodyProperties& properties = bodies.properties[slot];
        if (rotates_uniformly(properties)) continue;
        const glm::dquat start = start_of(tick, touches, slot).orientation;
        const glm::dvec3 momentum = bodies.angular_momentum.at(slot);
        const auto energy_at = [&](const glm::dquat& orientation) {
            return 0.5 * glm::dot(momentum,
                                  Bodies::apply_inverse_inertia(properties, orientation, momentum));
        };
        const double turning = energy_at(start);
        const glm::dquat now = bodies.orientation.at(slot);
        if (energy_at(now) <= turning) continue;
        const auto right = with_energy(now, {momentum, properties.inverse_inertia}, turning);
        if (right || !island.is_near) bodies.orientation.put(slot, right ? *right : start);
    }
}

/// Cuts the path of a body that a kinematic body wedged along its locks. Such a body may have been
/// arbitrarily fast within the tick. If it went farther than its speeds allow, it returns to the
/// place where it began.
void IslandEnergy::cut_way(const Tick& tick, const ContinuousCollision* touches, Slot slot)
{
    const Account& island = accounts_[islands_.root_of(slot + 1)];
    if (island.share == 1.0 || island.driven.speed == 0.0) return;
    Bodies& bodies = tick.state.bodies;
    const Start start = start_of(tick, touches, slot);
    constexpr double cornerwise = 2.0;
    const double fastest =
        std::max({length(start.velocity), length(bodies.velocity.at(slot)), island.driven.speed});
    const double most =
        length(bodies.properties[slot].half) + cornerwise * tick.config.tick * fastest;
    if (length(bodies.position.at(slot) - start.position) <= most) return;
    bodies.position.put(slot, start.position);
    bodies.orientation.put(slot, start.orientation);
    ++tick.state.interventions.paths_cut;
}

void IslandEnergy::join_islands(const Tick& tick, std::span<const Slot> slots)
{
    for (const Slot slot : slots) islands_.reset(slot + 1);
    for (const ContactBlock& block : tick.solver.blocks()) {
        if (tick.solver.responds(block.a) && tick.solver.responds(block.b))
            islands_.join(block.a, block.b);
    }
}

/// Marks islands that something fixed or kinematic pushed in the tick. Their momentum is not
/// conserved.
void IslandEnergy::note_held(const Tick& tick)
{
    for (const ContactBlock& block : tick.solver.blocks()) {
        if (tick.solver.responds(block.a) && tick.solver.responds(block.b)) continue;
        Account& island = accounts_[islands_.root_of(tick.solver.responding_of(block))];
        island.is_near = true;
        if (block.memory->normal_impulse_of_tick == 0.0) continue;
        island.is_held = true;
        island.is_driven = island.is_driven || tick.solver.is_kinematic(block.a) ||
                           tick.solver.is_kinematic(block.b);
    }
}

void IslandEnergy::sum_islands(std::span<const Slot> slots)
{
    for (const Slot slot : slots) {
        const SolverIndex root = islands_.root_of(slot + 1);
        if (root != slot + 1) accounts_[root].add(accounts_[slot + 1]);
    }
}

/// Finds the motion of a rigid body with the momentum and angular momentum of an island that
/// nothing holds.
void IslandEnergy::find_rigid(const Tick& tick, std::span<const Slot> slots)
{
    const Bodies& bodies = tick.state.bodies;
    for (const Slot slot : slots) {
        Account& island = accounts_[slot + 1];
        if (islands_.root_of(slot + 1) != slot + 1 || island.share == 1.0 || island.is_held)
            continue;
        island.centre = island.moment / island.mass;
        island.velocity = island.momentum / island.mass;
        island.inertia = glm::dmat3{0.0};
    }
    for (const Slot slot : slots) {
        Account& island = accounts_[islands_.root_of(slot + 1)];
        if (island.share == 1.0 || island.is_held) continue;
        const BodyProperties& properties = bodies.properties[slot];
        const glm::dvec3 arm = bodies.position.at(slot) - island.centre;
        island.inertia +=
            inertia_of(properties, bodies.orientation.at(slot)) +
            properties.mass * (glm::dmat3{glm::dot(arm, arm)} - glm::outerProduct(arm, arm));
    }
    for (const Slot slot : slots) {
        Account& island = accounts_[slot + 1];
        if (islands_.root_of(slot + 1) != slot + 1 || island.share == 1.0 || island.is_held)
            continue;
        if (!island.can_turn) continue;
        const glm::dmat3 light = glm::inverse(island.inertia);
        island.spin = island.spin_due = light * about_centre(island);
        if (!island.is_closed) continue;
        const glm::dvec3 centre = island.moment_before / island.mass;
        island.spin_due =
            light * (island.angular_before - glm::cross(centre, island.momentum_before));
    }
}

glm::dvec3 IslandEnergy::about_centre(const Account& island)
{
    return island.angular - glm::cross(island.centre, island.momentum);
}

/// Finds the remaining share of the velocities relative to those of the rigid body.
void IslandEnergy::find_share(Account& island, Interventions& interventions)
{
    double rigid = 0.0, due = 0.0;
    if (!island.is_held) {
        const double moving = 0.5 * glm::dot(island.momentum, island.velocity);
        rigid = moving + 0.5 * glm::dot(about_centre(island), island.spin);
        due = moving + 0.5 * glm::dot(island.spin_due, island.inertia * island.spin_due);
    }
    const double beside = island.kinetic - rigid;
    const double lost = island.kinetic - island.allowed_at(1.0) - island.lifted;
    // The energy that touches may have given shrinks with the velocities.
    constexpr int rounds_max = 32;
    double share = 1.0;
    for (int round = 0; round < rounds_max; ++round) {
        const double left = std::max(0.0, island.allowed_at(share) - due);
        const double next = left < beside ? std::sqrt(left / beside) : 0.0;
        if (next >= share) break;
        share = next;
        if (island.driven.energy <= 0.0) break;
    }
    island.share = share < 1.0 ? share : 0.0;
    if (lost <= unfinished_share * island.there + island.rest) return;
    constexpr double trimmed = 0.9;
    ++(island.share < trimmed ? interventions.islands_limited : interventions.impulses_trimmed);
}

void IslandEnergy::slow(const Tick& tick, Slot slot)
{
    const Account& island = accounts_[islands_.root_of(slot + 1)];
    if (island.share == 1.0) return;
    Bodies& bodies = tick.state.bodies;
    const BodyProperties& properties = bodies.properties[slot];
    const glm::dvec3 arm = bodies.position.at(slot) - island.centre;
    glm::dvec3 velocity = island.share * bodies.velocity.at(slot);
    glm::dvec3 angular = island.share * bodies.angular_momentum.at(slot);
    if (!island.is_held) {
        const glm::dvec3 spin = island.spin_due - island.share * island.spin;
        velocity += (1.0 - island.share) * island.velocity + glm::cross(spin, arm);
        angular += Bodies::apply_inertia(properties, bodies.orientation.at(slot), spin);
    }
    bodies.velocity.put(slot, velocity);
    bodies.angular_momentum.put(slot, angular);
}

} // namespace hapnet::scene
