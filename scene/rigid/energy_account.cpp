// SPDX-FileCopyrightText: 2026 The Hapnet authors
// SPDX-License-Identifier: MIT
#include "scene/rigid/energy_account.hpp"

#include "scene/maths/vector.hpp"
#include "scene/rigid/free_flight.hpp"

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>
#include <limits>

namespace hapnet::scene {

namespace {

// What the solver may leave, see its tolerances: of the energy that is there, and, of the speed
// that forces add to a body in a tick, a factor.
constexpr double energy_tolerance = 9e-7;
constexpr double speed_tolerance = 1.9;
// Of the smallest half edge in a tick: what crosses so little is at rest.
constexpr double rest = 0.95e-6;
// Radians in a tick beyond which the change of a body's inertia is not followed.
constexpr double followed_turn = 0.3;

/// A body's motion over the tick, in sums that any impulses on it enter linearly.
struct Motion {
    glm::dvec3 start{0.0};       // velocity, m/s
    glm::dvec3 forced{0.0};      // m/s, what gravity and pushes add
    glm::dvec3 twist{0.0};       // N m s, what torques add to the angular momentum
    glm::dvec3 spin_forced{0.0}; // that of it, with the inertia of the start
    glm::dvec3 change{0.0};      // m/s, of all impulses
    glm::dvec3 spin{0.0};        // at the start, rad/s
    glm::dvec3 momentum{0.0};
    glm::dvec3 angular{0.0};     // N m s, of all impulses
    glm::dvec3 spin_change{0.0}; // that of it, with the inertia of the start
};

Motion motion_of(const EnergyAccount::Tick& tick, Slot slot)
{
    const Bodies& bodies = tick.state.bodies;
    const BodyProperties& properties = bodies.properties[slot];
    const BodyIntegration& integration = tick.integrations[slot + 1];
    const BodyMotion& end = tick.solver.end_motion(slot + 1);
    Motion motion;
    motion.start = integration.start.velocity;
    motion.forced = tick.config.tick * (gravity_on(properties, tick.config.gravity) +
                                        properties.inverse_mass * tick.state.pushes[properties.id]);
    motion.change = end.velocity - motion.start - motion.forced;
    motion.spin = integration.start.spin;
    motion.momentum = bodies.angular_momentum.at(slot);
    if (!tick.state.twisted.is_empty()) {
        motion.twist =
            tick.config.tick * about_unlocked_axes(properties, tick.state.torques[properties.id]);
        motion.spin_forced = bodies.apply_inverse_inertia(slot, motion.twist);
    }
    motion.angular =
        about_unlocked_axes(properties, integration.angular_momentum + end.angular_impulse +
                                            integration.bounce_angular_impulse) -
        motion.momentum - motion.twist;
    motion.spin_change = bodies.apply_inverse_inertia(slot, motion.angular);
    return motion;
}

/// By how much the energy of a body that turns may be wrong: its spin changes while its angular
/// momentum stays, and in the impulses of contacts that counts.
double turning_slack(const BodyProperties& properties, const Motion& motion, double tick)
{
    const glm::dvec3& inertia = properties.inertia;
    if (properties.turning != Turning::free || properties.is_isotropic) return 0.0;
    const double wobble =
        std::max({inertia.x, inertia.y, inertia.z}) / std::min({inertia.x, inertia.y, inertia.z}) -
        1.0;
    const double spin = std::max(length(motion.spin),
                                 length(motion.spin + motion.spin_forced + motion.spin_change));
    return 0.9 * wobble * std::min(spin * tick, followed_turn) * spin * length(motion.angular);
}

void count(Interventions& interventions, double share)
{
    constexpr double trimmed = 0.9;
    ++(share < trimmed ? interventions.islands_limited : interventions.impulses_trimmed);
}

} // namespace

EnergyAccount::EnergyAccount(std::size_t bodies) : balances_{bodies + 1}, islands_{bodies + 1} {}

void EnergyAccount::Balance::add(const Balance& other)
{
    gain += other.gain;
    linear += other.linear;
    square += other.square;
    stored += other.stored;
    driven += other.driven;
    detour += other.detour;
}

/// The largest share of the impulses with which no more is gained than may be: at most what the
/// springs held, rounding, and the share of the hands' work.
double EnergyAccount::Balance::share() const
{
    const double slope = linear - driven;
    const double root2 = slope * slope + 4.0 * square * stored;
    const double found = (-slope + std::sqrt(root2)) / (2.0 * square);
    return found > 0.0 && found < 1.0 ? found : 0.0;
}

EnergyAccount::Balance EnergyAccount::balance_of(const Tick& tick, Slot slot)
{
    const BodyProperties& properties = tick.state.bodies.properties[slot];
    const BodyIntegration& integration = tick.integrations[slot + 1];
    const Motion motion = motion_of(tick, slot);
    const double mass = properties.mass;
    Balance balance;
    balance.linear = mass * glm::dot(motion.change, motion.start + 0.5 * motion.forced) +
                     glm::dot(motion.angular, motion.spin + 0.5 * motion.spin_forced);
    balance.square = 0.5 * (mass * glm::dot(motion.change, motion.change) +
                            glm::dot(motion.angular, motion.spin_change));
    balance.gain = balance.linear + balance.square;
    const glm::dvec3 mean = motion.start + 0.5 * (motion.forced + motion.change);
    const glm::dvec3 mean_spin = motion.spin + 0.5 * (motion.spin_forced + motion.spin_change);
    const double work = mass * glm::dot(motion.forced, mean) + glm::dot(motion.twist, mean_spin);
    const BodyMotion& went = tick.solver.mean_motion(slot + 1);
    const double way =
        mass * glm::dot(motion.forced, went.velocity) + glm::dot(motion.twist, went.spin);
    balance.detour = std::max(0.0, way - work);
    balance.stored = integration.hand_energy_stored;
    balance.driven = integration.energy_driven;
    const double there = mass * glm::dot(motion.start, motion.start) +
                         glm::dot(motion.momentum, motion.spin) + std::abs(work);
    const double miss2 =
        speed_tolerance * speed_tolerance * glm::dot(motion.forced, motion.forced) +
        rest * rest * tick.scales.least * tick.scales.least * tick.scales.rate * tick.scales.rate;
    const double twisted = glm::dot(motion.twist, motion.spin_forced);
    balance.stored +=
        energy_tolerance * there + mass * miss2 + speed_tolerance * speed_tolerance * twisted;
    balance.driven += turning_slack(properties, motion, tick.config.tick);
    return balance;
}

void EnergyAccount::settle(const Tick& tick)
{
    balances_.resize(tick.state.bodies.awake + std::size_t{1});
    bool any = false;
    for (const Slot slot : tick.active) {
        balances_[slot + 1] = balance_of(tick, slot);
        any = any || balances_[slot + 1].is_exceeded();
    }
    if (any) settle_islands(tick);
}

/// One body may gain what others of its island lose.
void EnergyAccount::settle_islands(const Tick& tick)
{
    for (const Slot slot : tick.active) islands_.reset(slot + 1);
    for (const ContactBlock& block : tick.solver.blocks()) {
        if (tick.solver.responds(block.a) && tick.solver.responds(block.b))
            islands_.join(block.a, block.b);
    }
    join_joined(tick.solver.joints(), islands_);
    for (const Slot slot : tick.active) {
        const SolverIndex root = islands_.root_of(slot + 1);
        if (root != slot + 1) balances_[root].add(balances_[slot + 1]);
    }
    leave_joined(tick.solver.joints());
    for (const Slot slot : tick.active) {
        const SolverIndex root = islands_.root_of(slot + 1);
        const Balance& island = balances_[root];
        if (!island.is_exceeded()) continue;
        const double share = island.share();
        if (root == slot + 1) count(tick.state.interventions, share);
        scale(tick, slot, share);
    }
    for (ContactBlock& block : tick.solver.blocks()) {
        const SolverIndex body = tick.solver.responds(block.a) ? block.a : block.b;
        const Balance& island = balances_[islands_.root_of(body)];
        if (island.is_exceeded()) scale_impulses(*block.memory, island.share());
    }
}

/// A share of a joint's impulse would not hold it: JointEnergy settles the islands with joints.
void EnergyAccount::leave_joined(const JointSolver& joints)
{
    for (const JointSolver::Group& group : joints.groups()) {
        if (group.is_awake)
            balances_[islands_.root_of(joints.body_of(group))].stored =
                std::numeric_limits<double>::infinity();
    }
}

/// Velocities alone: the way is what was found without overlaps.
void EnergyAccount::scale(const Tick& tick, Slot slot, double share)
{
    BodyIntegration& integration = tick.integrations[slot + 1];
    BodyMotion& end = tick.solver.end_motion(slot + 1);
    const Motion motion = motion_of(tick, slot);
    end.velocity = motion.start + motion.forced + share * motion.change;
    end.angular_impulse = glm::dvec3{0.0};
    integration.bounce_angular_impulse = glm::dvec3{0.0};
    integration.angular_momentum = motion.momentum + motion.twist + share * motion.angular;
    if (integration.has_hands)
        tick.hands.scale_impulses(tick.state.bodies.properties[slot].id, share);
}

} // namespace hapnet::scene
