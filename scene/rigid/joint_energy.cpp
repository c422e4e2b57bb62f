// SPDX-FileCopyrightText: 2026 The Hapnet authors
// SPDX-License-Identifier: MIT
#include "scene/rigid/joint_energy.hpp"

#include "scene/maths/vector.hpp"
#include "scene/rigid/free_flight.hpp"

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>
#include <glm/mat3x3.hpp>
#include <glm/matrix.hpp>

namespace hapnet::scene {

namespace {

// Less than this share of all that was added up is rounding.
constexpr double joint_rounding = 1e-13;
// What errors have lost may come back only while it is little beside what moves.
constexpr double owed_max = 0.01;
// So little of what is there may be gained until the next tick, and so is what gravity does in one.
constexpr double little = 5e-7;
// An island that keeps less of its motion than this lost a tenth of its impulses.
constexpr double slowed = 0.9;
constexpr int energy_rounds_max = 4;
// One that keeps less than this goes back to where it began.
constexpr double halted = 0.5;

double given_by_grips(const BodyIntegration& integration, const Bodies& bodies, Slot slot)
{
    if (!(integration.grips.impulse > 0.0)) return 0.0;
    const double radius = length(bodies.properties[slot].half);
    const BodyMotion& start = integration.start;
    const double fastest =
        std::max(length(start.velocity) + radius * length(start.spin),
                 length(bodies.velocity.at(slot)) + radius * length(bodies.angular_velocity(slot)));
    return integration.grips.given(1.0, fastest);
}

/// The moments of inertia of one body about another point: its own in the world's frame, and its
/// mass at `from` there.
glm::dmat3 inertia_about(const BodyProperties& properties, const glm::dquat& orientation,
                         const glm::dvec3& from)
{
    const glm::dmat3 axes = glm::mat3_cast(orientation);
    glm::dmat3 inertia{0.0};
    for (int own = 0; own < 3; ++own)
        inertia += properties.inertia[own] * glm::outerProduct(axes[own], axes[own]);
    const glm::dmat3 far = glm::dot(from, from) * glm::dmat3{1.0} - glm::outerProduct(from, from);
    return inertia + properties.mass * far;
}

} // namespace

/// What impulses of contacts add counts with the inertia that the body had when they were found:
/// see EnergyAccount.
double JointEnergy::kinetic_energy_as_at(const Departure& from, const Bodies& bodies, Slot slot)
{
    const BodyProperties& properties = bodies.properties[slot];
    const glm::dvec3 velocity = bodies.velocity.at(slot);
    const glm::dvec3 momentum = bodies.angular_momentum.at(slot);
    return 0.5 * (properties.mass * glm::dot(velocity, velocity) +
                  glm::dot(momentum,
                           Bodies::apply_inverse_inertia(properties, from.orientation, momentum)));
}

JointEnergy::JointEnergy(const Bodies& bodies, std::size_t groups)
    : departures_(groups > 0 ? bodies.size() : 0),
      owed_(groups, 0.0),
      accounts_(groups > 0 ? bodies.movable + std::size_t{1} : 0),
      islands_{groups > 0 ? bodies.movable + std::size_t{1} : 0}
{}

void JointEnergy::begin_tick(const WorldState& state)
{
    const Bodies& bodies = state.bodies;
    for (Slot slot = 0; slot < bodies.movable; ++slot) {
        departures_[bodies.properties[slot].id] = {
            bodies.position.at(slot), bodies.orientation.at(slot), bodies.velocity.at(slot),
            bodies.angular_momentum.at(slot),
            slot < bodies.awake ? bodies.kinetic_energy(slot) : 0.0};
    }
}

std::uint32_t JointEnergy::root_of(const Tick& tick, Slot slot)
{
    return tick.is_one_island ? 1 : islands_.root_of(slot + 1);
}

void JointEnergy::find_islands(const Tick& tick)
{
    const Slot awake = tick.state.bodies.awake;
    for (Slot slot = 0; slot < awake; ++slot) {
        islands_.reset(slot + 1);
        accounts_[slot + 1] = {};
    }
    for (const ContactBlock& block : tick.solver.blocks()) {
        if (tick.solver.responds(block.a) && tick.solver.responds(block.b))
            islands_.join(block.a, block.b);
    }
    join_joined(tick.solver.joints(), islands_);
    for (const ContactBlock& block : tick.solver.blocks()) {
        const bool a_responds = tick.solver.responds(block.a);
        Account& island = accounts_[root_of(tick, (a_responds ? block.a : block.b) - 1)];
        island.is_clean = false;
        if (!a_responds || !tick.solver.responds(block.b)) island.is_held = true;
    }
    if (tick.is_one_island) {
        const Bodies& bodies = tick.state.bodies;
        accounts_[1].is_clean = false;
        accounts_[1].is_held = !tick.config.planes.empty() || bodies.size() > bodies.movable;
    }
}

/// What a body gained, less the work of what acts on it from outside.
void JointEnergy::add(const Tick& tick, Slot slot)
{
    const Bodies& bodies = tick.state.bodies;
    const BodyProperties& properties = bodies.properties[slot];
    const Departure& from = departures_[properties.id];
    Account& island = accounts_[root_of(tick, slot)];
    double now = bodies.kinetic_energy(slot);
    const glm::dvec3 force = properties.mass * gravity_on(properties, tick.config.gravity) +
                             tick.state.pushes[properties.id];
    const glm::dvec3 way = bodies.position.at(slot) - from.position;
    double work = glm::dot(force, way);
    double given = 0.0;
    if (from.is_active) {
        const BodyIntegration& integration = tick.integrations[slot + 1];
        if (integration.has_hands || integration.drag != 0.0) island.is_clean = false;
        if (integration.has_hands) island.has_hands = true;
        if (!integration.is_joined) now = std::max(now, kinetic_energy_as_at(from, bodies, slot));
        if (!island.is_clean) {
            // Contacts move bodies apart at no cost: see EnergyAccount.
            const glm::dvec3 mean = 0.5 * (integration.start.velocity + bodies.velocity.at(slot));
            work = std::max(work, tick.config.tick * glm::dot(force, mean));
        }
        if (!tick.state.twisted.is_empty())
            work += tick.config.tick *
                    glm::dot(about_unlocked_axes(properties, tick.state.torques[properties.id]),
                             tick.solver.mean_motion(slot + 1).spin);
        given = integration.hand_energy_stored + integration.hand_energy_driven +
                integration.driven.energy + given_by_grips(integration, bodies, slot);
    }
    island.gain += now - from.energy - work - given;
    island.there += now + from.energy + std::abs(work) + std::abs(given);
    island.kinetic += now;
    island.mass += properties.mass;
    island.momentum += properties.mass * bodies.velocity.at(slot);
    island.momentum_due += properties.mass * from.velocity + tick.config.tick * force;
    const glm::dvec3& light = properties.inverse_mass;
    if (properties.turning != Turning::free) island.turns_freely = false;
    if (light.x == 0.0 || light.y == 0.0 || light.z == 0.0) island.is_held = true;
}

void JointEnergy::add_groups(const Tick& tick)
{
    const JointSolver& solver = tick.solver.joints();
    for (std::size_t g = 0; g < solver.groups().size(); ++g) {
        const JointSolver::Group& group = solver.groups()[g];
        if (!group.is_awake) continue;
        Account& island = accounts_[root_of(tick, solver.body_of(group) - 1)];
        const Joints::Stored& stored = tick.joints.stored(g);
        island.has_joints = true;
        island.gain += stored.after - stored.before;
        island.there += stored.after + stored.before;
        if (!tick.joints.keeps_energy(solver, g)) island.is_clean = false;
        for (const JointBlock& joint : solver.joints_of(group))
            if (joint.a == 0 || joint.b == 0) island.is_held = true;
    }
}

/// Sums up what each island gained.
void JointEnergy::add_all(const Tick& tick)
{
    find_islands(tick);
    const JointSolver& solver = tick.solver.joints();
    for (const JointSolver::Group& group : solver.groups()) {
        if (group.is_awake) accounts_[root_of(tick, solver.body_of(group) - 1)].has_joints = true;
    }
    for (Slot slot = 0; slot < tick.state.bodies.awake; ++slot)
        if (accounts_[root_of(tick, slot)].has_joints) add(tick, slot);
    add_groups(tick);
}

void JointEnergy::settle(const Tick& tick)
{
    for (const Slot slot : tick.active)
        departures_[tick.state.bodies.properties[slot].id].is_active = true;
    const JointSolver& solver = tick.solver.joints();
    // What grips may give shrinks with the speeds that are left.
    bool any = true;
    for (int round = 0; any && round < energy_rounds_max; ++round) {
        any = false;
        add_all(tick);
        for (std::size_t g = 0; g < solver.groups().size(); ++g) {
            const JointSolver::Group& group = solver.groups()[g];
            if (!group.is_awake) continue;
            const std::uint32_t root = root_of(tick, solver.body_of(group) - 1);
            // The first group of an island takes what all of it gained.
            Account& island = accounts_[root];
            const double excess = round == 0 ? book(tick, island, owed_[g]) : island.gain;
            island.gain = 0.0;
            if (round > 0) island.is_little = excess <= little_of(tick, island);
            if (excess <= joint_rounding * island.there || (round > 0 && island.is_little))
                continue;
            slow(tick, island, root, excess);
            any = any || !island.is_little;
        }
    }
}

double JointEnergy::little_of(const Tick& tick, const Account& island)
{
    const double fall = tick.config.tick * length(tick.config.gravity);
    return little * island.there + island.mass * fall * fall;
}

/// What an island has gained too much, J; the rest goes into what it is owed.
double JointEnergy::book(const Tick& tick, Account& island, double& owed)
{
    const double gain = island.gain;
    owed = std::max(owed, -owed_max * island.there);
    const double total = owed + gain;
    if (gain < 0.0 && !island.is_clean) {
        if (owed > 0.0) owed = std::max(0.0, total);
        return 0.0;
    }
    const double excess = owed < 0.0 ? std::max(total, gain - little * island.there) : total;
    owed = total;
    if (excess <= joint_rounding * island.there) return 0.0;
    island.is_little = excess <= little_of(tick, island);
    owed = std::min(0.0, total - excess);
    if (island.is_little) owed += std::max(0.0, excess - island.kinetic);
    return excess;
}

/// To where they began, with the velocities that they would have without each other.
void JointEnergy::put_back(const Tick& tick, std::uint32_t root)
{
    Bodies& bodies = tick.state.bodies;
    for (Slot slot = 0; slot < bodies.awake; ++slot) {
        if (root_of(tick, slot) != root) continue;
        const Departure& from = departures_[bodies.properties[slot].id];
        bodies.position.put(slot, from.position);
        bodies.orientation.put(slot, from.orientation);
        const BodyProperties& properties = bodies.properties[slot];
        const glm::dvec3 acceleration = gravity_on(properties, tick.config.gravity) +
                                        properties.inverse_mass * tick.state.pushes[properties.id];
        const glm::dvec3 torque =
            about_unlocked_axes(properties, tick.state.torques[properties.id]);
        bodies.velocity.put(slot, from.velocity + tick.config.tick * acceleration);
        bodies.angular_momentum.put(slot, from.angular_momentum + tick.config.tick * torque);
        ++tick.state.interventions.paths_cut;
    }
    const JointSolver& solver = tick.solver.joints();
    for (std::size_t g = 0; g < solver.groups().size(); ++g) {
        const JointSolver::Group& group = solver.groups()[g];
        if (group.is_awake && root_of(tick, solver.body_of(group) - 1) == root)
            tick.joints.read_places(tick.state, g);
    }
}

/// The rigid body's motion, and its energy, J.
double JointEnergy::find_rigid(const Tick& tick, Account& island, std::uint32_t root)
{
    if (island.is_held) return 0.0;
    Bodies& bodies = tick.state.bodies;
    const auto for_bodies = [&](auto&& act) {
        for (Slot slot = 0; slot < bodies.awake; ++slot)
            if (root_of(tick, slot) == root) act(slot);
    };
    glm::dvec3 moment{0.0};
    for_bodies(
        [&](Slot slot) { moment += bodies.properties[slot].mass * bodies.position.at(slot); });
    island.velocity = island.momentum / island.mass;
    island.centre = moment / island.mass;
    island.spin = glm::dvec3{0.0};
    const double energy = 0.5 * island.mass * glm::dot(island.velocity, island.velocity);
    if (!island.turns_freely) return energy;
    glm::dmat3 inertia{0.0};
    glm::dvec3 momentum{0.0};
    for_bodies([&](Slot slot) {
        const BodyProperties& properties = bodies.properties[slot];
        const glm::dvec3 from = bodies.position.at(slot) - island.centre;
        inertia += inertia_about(properties, bodies.orientation.at(slot), from);
        momentum += bodies.angular_momentum.at(slot) +
                    properties.mass * glm::cross(from, bodies.velocity.at(slot));
    });
    island.spin = glm::inverse(inertia) * momentum;
    return energy + 0.5 * glm::dot(momentum, island.spin);
}

void JointEnergy::slow(const Tick& tick, Account& island, std::uint32_t root, double excess)
{
    const auto left_of = [&](double rigid) {
        const double relative = std::max(0.0, island.kinetic - rigid);
        return relative > excess ? std::sqrt(1.0 - excess / relative) : 0.0;
    };
    // Joints that contradict each other push with forces so large that their sum is not zero.
    if (!island.has_hands) island.momentum = island.momentum_due;
    double left = left_of(find_rigid(tick, island, root));
    // What goes far and is slowed has not gone so far.
    if (left < halted && !island.is_little) {
        put_back(tick, root);
        find_rigid(tick, island, root);
        left = 0.0;
    }
    Interventions& interventions = tick.state.interventions;
    ++(left < slowed && !island.is_little ? interventions.islands_limited
                                          : interventions.impulses_trimmed);
    Bodies& bodies = tick.state.bodies;
    glm::dvec3 momentum{0.0};
    for (Slot slot = 0; slot < bodies.awake; ++slot) {
        if (root_of(tick, slot) != root) continue;
        const glm::dvec3 from = bodies.position.at(slot) - island.centre;
        const glm::dvec3 velocity =
            island.is_held ? glm::dvec3{0.0} : island.velocity + glm::cross(island.spin, from);
        const glm::dvec3 slower = velocity + left * (bodies.velocity.at(slot) - velocity);
        bodies.velocity.put(slot, slower);
        momentum += bodies.properties[slot].mass * slower;
        const glm::dvec3 now = bodies.angular_momentum.at(slot);
        glm::dvec3 rigid_momentum{0.0};
        if (!island.is_held) {
            const glm::dmat3 inertia = inertia_about(bodies.properties[slot],
                                                     bodies.orientation.at(slot), glm::dvec3{0.0});
            rigid_momentum = inertia * island.spin;
        }
        bodies.angular_momentum.put(slot, rigid_momentum + left * (now - rigid_momentum));
    }
    if (island.is_held) return;
    // What rounding took of the momentum, where bodies are far apart and turn fast.
    const glm::dvec3 missing = (island.momentum - momentum) / island.mass;
    for (Slot slot = 0; slot < bodies.awake; ++slot)
        if (root_of(tick, slot) == root)
            bodies.velocity.put(slot, bodies.velocity.at(slot) + missing);
}

} // namespace hapnet::scene
