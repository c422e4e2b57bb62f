// SPDX-FileCopyrightText: 2026 The Hapnet authors
// SPDX-License-Identifier: MIT
#include "scene/rigid/energy_account.hpp"

#include "scene/maths/vector.hpp"
#include "scene/rigid/free_flight.hpp"

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>

namespace hapnet::scene {

namespace {

// What the solver may leave, see its tolerances: of the energy that is there, and, of the speed
// that forces add to a body in a tick, a factor.
constexpr double energy_tolerance = 9e-7;
constexpr double speed_tolerance = 1.9;
// Of the smallest half edge in a tick: what crosses so little is at rest.
constexpr double rest = 0.95e-6;
// Two surfaces that close at a small angle squeeze a body out faster than they move, without limit
// as the angle goes to 0. For the work of contacts the speed of a surface counts as up to so many
// times what it is, but not as more than so many smallest half edges in a tick, unless it is faster
// itself: what goes farther leaves them within the tick. Both were found by random scenes with
// every element, 100 000 each from seeds 3.0e12, 3.1e12 and 3.2e12 on: more lets bodies gain, less
// stops fair ones.
constexpr double squeezed_max = 5.0;
constexpr double squeezed_way = 0.05;
// Radians in a tick beyond which the change of a body's inertia is not followed.
constexpr double followed_turn = 0.3;
// Radians in a tick beyond which the inertia at the start says little of a touch.
constexpr double far_turn = 0.25;

// What keeps this share of its velocities loses hardly any motion.
constexpr double hardly_slowed = 0.99;
// What is slowed may gain less than before: so much of its energy too much is settled, a tenth of
// what energy_tolerance leaves. That takes three rounds or so.
constexpr double nearly_settled = 1e-8;
constexpr int slowing_rounds_max = 16;

void count(Interventions& interventions, double share)
{
    constexpr double trimmed = 0.9;
    ++(share < trimmed ? interventions.islands_limited : interventions.impulses_trimmed);
}

} // namespace

/// What a body's tick began with and what it has come to.
struct EnergyAccount::BodyTick {
    Slot slot = 0;
    glm::dquat orientation{1.0, 0.0, 0.0, 0.0}; // at the start
    glm::dvec3 velocity{0.0};                   // at the start
    glm::dvec3 angular_momentum{0.0};           // at the start
    glm::dvec3 end_velocity{0.0};
    glm::dvec3 end_angular_momentum{0.0};
    glm::dvec3 mean_velocity{0.0}; // by which it goes
    glm::dvec3 mean_spin{0.0};
    const BodyIntegration* integration = nullptr; // where something acted on it but gravity
    DrivenEnergy driven{};                        // of kinematic bodies, in touches
    bool has_moved = false;
};

/// A body's motion over the tick, in sums that any impulses on it enter linearly.
struct EnergyAccount::Motion {
    glm::dvec3 forced{0.0};      // m/s, what gravity and pushes add
    glm::dvec3 load{0.0};        // m/s, the same of a sleeper, which others bear
    glm::dvec3 twist{0.0};       // N m s, what torques add to the angular momentum
    glm::dvec3 spin_forced{0.0}; // that of it, with the inertia of the start
    glm::dvec3 change{0.0};      // m/s, of all impulses
    glm::dvec3 spin{0.0};        // at the start, rad/s
    glm::dvec3 angular{0.0};     // N m s, of all impulses
    glm::dvec3 spin_change{0.0}; // that of it, with the inertia of the start
};

EnergyAccount::EnergyAccount(const Bodies& bodies)
    : balances_{bodies.movable + std::size_t{1}},
      gaining_{bodies.moving + std::size_t{1}},
      islands_{bodies.moving + std::size_t{1}},
      moved_{bodies.movable}
{}

EnergyAccount::BodyTick EnergyAccount::tick_of(const Tick& tick, Slot slot)
{
    const Bodies& bodies = tick.state.bodies;
    const BodyIntegration& integration = tick.integrations[slot + 1];
    const BodyMotion& end = tick.solver.end_motion(slot + 1);
    const BodyMotion& mean = tick.solver.mean_motion(slot + 1);
    return {.slot = slot,
            .orientation = bodies.orientation.at(slot),
            .velocity = integration.start.velocity,
            .angular_momentum = bodies.angular_momentum.at(slot),
            .end_velocity = end.velocity,
            .end_angular_momentum = about_unlocked_axes(
                bodies.properties[slot], integration.angular_momentum + end.angular_impulse +
                                             integration.bounce_angular_impulse),
            .mean_velocity = mean.velocity,
            .mean_spin = mean.spin,
            .integration = &integration};
}

EnergyAccount::BodyTick EnergyAccount::moved_tick_of(const Tick& tick, Slot slot,
                                                     const ContinuousCollision& touches)
{
    const Bodies& bodies = tick.state.bodies;
    const ContinuousCollision::Beginning& beginning = touches.beginning(slot);
    BodyTick body{.slot = slot,
                  .orientation = beginning.orientation,
                  .velocity = beginning.velocity,
                  .angular_momentum = beginning.angular_momentum,
                  .end_velocity = bodies.velocity.at(slot),
                  .end_angular_momentum = bodies.angular_momentum.at(slot),
                  .mean_velocity =
                      tick.scales.rate * (bodies.position.at(slot) - beginning.position),
                  .driven = beginning.driven,
                  .has_moved = true};
    if (!tick.active.contains(slot)) return body;
    body.integration = &tick.integrations[slot + 1];
    body.mean_spin = tick.solver.mean_motion(slot + 1).spin;
    return body;
}

/// The same, were all velocities at the end so much slower.
EnergyAccount::BodyTick EnergyAccount::slowed(BodyTick body, double slowing)
{
    body.end_velocity *= slowing;
    body.end_angular_momentum *= slowing;
    return body;
}

/// With an angular momentum, and with the inertia that the body has where it comes to.
glm::dvec3 EnergyAccount::spin_at_end(const Tick& tick, const BodyTick& body,
                                      const glm::dvec3& momentum)
{
    const Bodies& bodies = tick.state.bodies;
    const glm::dquat orientation =
        body.has_moved ? bodies.orientation.at(body.slot)
                       : placement_at_end(*body.integration, bodies, body.slot,
                                          tick.solver.mean_motion(body.slot + 1), tick.config.tick)
                             .orientation;
    return Bodies::apply_inverse_inertia(bodies.properties[body.slot], orientation, momentum);
}

EnergyAccount::Motion EnergyAccount::motion_of(const Tick& tick, const BodyTick& body)
{
    const Bodies& bodies = tick.state.bodies;
    const BodyProperties& properties = bodies.properties[body.slot];
    const auto spin_of = [&](const glm::dvec3& momentum) {
        return Bodies::apply_inverse_inertia(properties, body.orientation, momentum);
    };
    Motion motion;
    motion.load = tick.config.tick * (gravity_on(properties, tick.config.gravity) +
                                      properties.inverse_mass * tick.state.pushes[properties.id]);
    if (body.slot < bodies.awake) motion.forced = motion.load;
    motion.change = body.end_velocity - body.velocity - motion.forced;
    motion.spin = spin_of(body.angular_momentum);
    motion.angular = body.end_angular_momentum - body.angular_momentum;
    if (!tick.state.twisted.is_empty()) {
        motion.twist =
            tick.config.tick * about_unlocked_axes(properties, tick.state.torques[properties.id]);
        motion.spin_forced = spin_of(motion.twist);
        motion.angular -= motion.twist;
    }
    motion.spin_change = spin_of(motion.angular);
    return motion;
}

/// By how much the energy of a body that turns may be wrong: its spin changes while its angular
/// momentum stays, and in the impulses of contacts that counts.
double EnergyAccount::turning_slack(const Tick& tick, const BodyTick& body, const Motion& motion,
                                    double share)
{
    const BodyProperties& properties = tick.state.bodies.properties[body.slot];
    const glm::dvec3& inertia = properties.inertia;
    if (properties.turning != Turning::free || properties.is_isotropic) return 0.0;
    const double most = std::max({inertia.x, inertia.y, inertia.z});
    const double least = std::min({inertia.x, inertia.y, inertia.z});
    const double wobble = most / least - 1.0;
    constexpr double certainly = 0.9;
    const double given = share * length(motion.angular);
    const double before = length(motion.spin);
    const glm::dvec3 momentum = body.angular_momentum + motion.twist + share * motion.angular;
    if (!body.has_moved) {
        double spin =
            std::max(before, length(motion.spin + motion.spin_forced + share * motion.spin_change));
        // It may turn by so much that its spin at the end is another one.
        const double angle = spin * tick.config.tick;
        if (angle <= followed_turn && wobble * angle > 1.0 - certainly)
            spin = std::max(before, length(spin_at_end(tick, body, momentum)));
        return certainly * wobble * std::min(spin * tick.config.tick, followed_turn) * spin * given;
    }
    // Touches push at their moment, with the inertia that the body has then.
    const double spin = std::max(before, length(spin_at_end(tick, body, momentum)));
    const double angle = spin * tick.config.tick;
    const double slack = wobble * angle * spin * given;
    if (angle <= far_turn) return certainly * slack;
    const double range = 0.5 * (1.0 / least - 1.0 / most);
    return certainly * (slack + range * (glm::dot(body.angular_momentum, body.angular_momentum) +
                                         glm::dot(momentum, momentum)));
}

double EnergyAccount::given_by_grips(const Tick& tick, const BodyTick& body, const Motion& motion,
                                     double share)
{
    const double radius = length(tick.state.bodies.properties[body.slot].half);
    const glm::dvec3 velocity = body.velocity + motion.forced + share * motion.change;
    const glm::dvec3 spin =
        spin_at_end(tick, body, body.angular_momentum + motion.twist + share * motion.angular);
    const double fastest = std::max(length(body.velocity) + radius * length(motion.spin),
                                    length(velocity) + radius * length(spin));
    return body.integration->grips.given(share, fastest);
}

/// The momentum that all impulses of the tick left in a body, N s, angular momentum as linear at
/// its smallest half edge. Impulses that cancel, of locks and wedges, do not count.
double EnergyAccount::passed(const Tick& tick, const BodyTick& body, const Motion& motion)
{
    const BodyProperties& properties = tick.state.bodies.properties[body.slot];
    const glm::dvec3& half = properties.half;
    return properties.mass * length(motion.change) +
           length(motion.angular) / std::min({half.x, half.y, half.z});
}

/// The same work, with the speed at which it counts raised for what squeezes a body out.
DrivenEnergy EnergyAccount::with_squeezing(const Tick& tick, const DrivenEnergy& driven)
{
    const double most = squeezed_way * tick.scales.least * tick.scales.rate;
    return {driven.energy, std::max(driven.speed, std::min(squeezed_max * driven.speed, most))};
}

void EnergyAccount::Balance::add(const Balance& other)
{
    gain.linear += other.gain.linear;
    gain.square += other.gain.square;
    stored += other.stored;
    given += other.given;
    driven.add(other.driven);
    passed += other.passed;
    detour += other.detour;
    kinetic += other.kinetic;
    is_settled = is_settled && other.is_settled;
}

double EnergyAccount::Balance::given_at_most() const { return given + driven.within(passed); }

bool EnergyAccount::Balance::slow()
{
    const double excess = gain.at(1.0) - (stored + given_at_most() + detour);
    const double slower = slowing * std::sqrt(1.0 - excess / kinetic);
    if (!is_held || !(slower >= hardly_slowed)) return false;
    slowing = slower;
    return true;
}

double EnergyAccount::Balance::share_within() const
{
    const EnergyOfShare own{0.0, gain.linear - given_at_most() / share, gain.square};
    return std::min(share, own.share_within(stored));
}

EnergyAccount::Balance EnergyAccount::balance_of(const Tick& tick, const BodyTick& body,
                                                 double share)
{
    const Motion motion = motion_of(tick, body);
    const double mass = tick.state.bodies.properties[body.slot].mass;
    Balance balance;
    balance.share = share;
    balance.gain.linear = mass * glm::dot(motion.change, body.velocity + 0.5 * motion.forced) +
                          glm::dot(motion.angular, motion.spin + 0.5 * motion.spin_forced);
    balance.gain.square = 0.5 * (mass * glm::dot(motion.change, motion.change) +
                                 glm::dot(motion.angular, motion.spin_change));
    const glm::dvec3 mean = body.velocity + 0.5 * (motion.forced + share * motion.change);
    const glm::dvec3 mean_spin =
        motion.spin + 0.5 * (motion.spin_forced + share * motion.spin_change);
    const double work = mass * glm::dot(motion.load, mean) + glm::dot(motion.twist, mean_spin);
    const double way =
        mass * glm::dot(motion.load, body.mean_velocity) + glm::dot(motion.twist, body.mean_spin);
    balance.detour = std::max(0.0, way - work);
    // Those that bore a sleeper do not lift it.
    balance.gain.linear -= 0.5 * mass * glm::dot(motion.change, motion.load - motion.forced);
    const double there = mass * glm::dot(body.velocity, body.velocity) +
                         glm::dot(body.angular_momentum, motion.spin) + std::abs(work);
    const double miss2 =
        speed_tolerance * speed_tolerance * glm::dot(motion.load, motion.load) +
        rest * rest * tick.scales.least * tick.scales.least * tick.scales.rate * tick.scales.rate;
    const double twisted = glm::dot(motion.twist, motion.spin_forced);
    const glm::dvec3 spin_at_end = motion.spin + motion.spin_forced + motion.spin_change;
    balance.kinetic = 0.5 * (mass * glm::dot(body.end_velocity, body.end_velocity) +
                             glm::dot(body.end_angular_momentum, spin_at_end));
    balance.stored =
        energy_tolerance * there + mass * miss2 + speed_tolerance * speed_tolerance * twisted;
    balance.given = turning_slack(tick, body, motion, share);
    const bool any_kinematic = tick.state.bodies.moving != tick.state.bodies.movable;
    if (any_kinematic) {
        balance.passed = share * passed(tick, body, motion);
        const DrivenEnergy touches = body.driven.scaled(share);
        balance.driven = {touches.within(balance.passed), touches.speed};
    }
    if (body.integration == nullptr) return balance;
    balance.stored += body.integration->hand_energy_stored;
    const double by_hands = share * body.integration->hand_energy_driven;
    if (any_kinematic) {
        balance.driven.add(with_squeezing(tick, body.integration->driven.scaled(share)));
        // A hand that gives way takes what a surface gives: that leaves no momentum.
        balance.driven.energy += std::min(by_hands, 0.0);
        balance.given += std::max(by_hands, 0.0);
    } else {
        balance.given += by_hands;
    }
    if (body.integration->grips.impulse > 0.0)
        balance.given += given_by_grips(tick, body, motion, share);
    return balance;
}

std::span<const std::uint8_t> EnergyAccount::gaining(const Tick& tick)
{
    const std::span<const Slot> slots = tick.active.slots();
    balances_.resize(tick.state.bodies.awake + std::size_t{1});
    bool any = false;
    for (const Slot slot : slots) {
        balances_[slot + 1] = balance_of(tick, tick_of(tick, slot));
        any = any || balances_[slot + 1].is_exceeded();
    }
    if (!any) return {};
    join_islands(tick, slots);
    sum_islands(tick, slots);
    for (const ContactBlock& block : tick.solver.blocks()) {
        if (!tick.solver.is_kinematic(block.a) && !tick.solver.is_kinematic(block.b)) continue;
        const SolverIndex body = tick.solver.responds(block.a) ? block.a : block.b;
        balances_[islands_.root_of(body)].is_settled = true;
    }
    gaining_.resize(tick.integrations.size());
    std::fill(gaining_.all().begin(), gaining_.all().end(), std::uint8_t{0});
    any = false;
    for (const Slot slot : slots) {
        if (!balances_[islands_.root_of(slot + 1)].is_exceeded()) continue;
        gaining_[slot + 1] = 1;
        any = true;
        if (islands_.root_of(slot + 1) == slot + 1) ++tick.state.interventions.islands_anew;
    }
    return any ? gaining_.all() : std::span<const std::uint8_t>{};
}

bool EnergyAccount::settle(const Tick& tick)
{
    const std::span<const Slot> slots = tick.active.slots();
    balances_.resize(tick.state.bodies.awake + std::size_t{1});
    bool any = false;
    for (const Slot slot : slots) {
        balances_[slot + 1] = balance_of(tick, tick_of(tick, slot));
        any = any || balances_[slot + 1].is_exceeded();
    }
    if (!any) return false;
    join_islands(tick, slots);
    find_shares(tick, slots, [&](Slot slot) { return tick_of(tick, slot); });
    // Velocities alone: the way is what was found without overlaps.
    const bool has_scaled =
        scale_islands(tick, slots, [&](Slot slot, double share, double slowing) {
            const BodyTick body = tick_of(tick, slot);
            const Motion motion = motion_of(tick, body);
            BodyIntegration& integration = tick.integrations[slot + 1];
            BodyMotion& end = tick.solver.end_motion(slot + 1);
            end.velocity = slowing * (body.velocity + motion.forced + share * motion.change);
            end.angular_impulse = glm::dvec3{0.0};
            integration.bounce_angular_impulse = glm::dvec3{0.0};
            integration.angular_momentum =
                slowing * (body.angular_momentum + motion.twist + share * motion.angular);
        });
    return has_scaled;
}

void EnergyAccount::settle_touches(const Tick& tick, const ContinuousCollision& touches)
{
    Bodies& bodies = tick.state.bodies;
    moved_.clear();
    for (const Slot slot : tick.active.slots()) moved_.add(slot);
    touches.for_changed(bodies, [&](Slot slot) {
        if (!tick.active.contains(slot)) moved_.add(slot);
    });
    balances_.resize(bodies.movable + std::size_t{1});
    bool any = false; // also one that did not change, where another of its island did
    for (const Slot slot : moved_) {
        balances_[slot + 1] = balance_of(tick, moved_tick_of(tick, slot, touches));
        any = any || balances_[slot + 1].is_exceeded();
        balances_[slot + 1].is_settled = true;
    }
    touches.for_changed(bodies, [&](Slot slot) { balances_[slot + 1].is_settled = false; });
    if (!any) return;
    join_islands(tick, moved_.all());
    touches.for_pushes(bodies, [&](Slot a, Slot b) { islands_.join(a + 1, b + 1); });
    find_shares(tick, moved_.all(), [&](Slot slot) { return moved_tick_of(tick, slot, touches); });
    scale_islands(tick, moved_.all(), [&](Slot slot, double share, double slowing) {
        const BodyTick body = moved_tick_of(tick, slot, touches);
        const Motion motion = motion_of(tick, body);
        bodies.velocity.put(slot,
                            slowing * (body.velocity + motion.forced + share * motion.change));
        bodies.angular_momentum.put(
            slot, slowing * (body.angular_momentum + motion.twist + share * motion.angular));
    });
}

void EnergyAccount::cut_ways(const Tick& tick, const ContinuousCollision& touches)
{
    Bodies& bodies = tick.state.bodies;
    double fastest = 0.0; // m/s, of all at the start and at the end
    double driven = 0.0;  // m/s, of kinematic surfaces in touches
    double there = 0.0;   // J, at the start
    for (const Slot slot : moved_) {
        const BodyTick body = moved_tick_of(tick, slot, touches);
        const BodyProperties& properties = bodies.properties[slot];
        const glm::dvec3 spin =
            Bodies::apply_inverse_inertia(properties, body.orientation, body.angular_momentum);
        const double radius = length(properties.half);
        driven = std::max(driven, body.driven.speed);
        const double forced = length(motion_of(tick, body).forced); // may be gone again at the end
        fastest =
            std::max({fastest, driven, length(body.velocity) + forced + radius * length(spin),
                      length(body.end_velocity) + radius * length(bodies.angular_velocity(slot))});
        there += 0.5 * (properties.mass * glm::dot(body.velocity, body.velocity) +
                        glm::dot(body.angular_momentum, spin));
    }
    if (driven == 0.0) return;
    constexpr double cornerwise = 2.0;
    touches.for_changed(bodies, [&](Slot slot) {
        const ContinuousCollision::Beginning& beginning = touches.beginning(slot);
        const BodyProperties& properties = bodies.properties[slot];
        const double beyond =
            tick.scales.rate *
            (length(bodies.position.at(slot) - beginning.position) - length(properties.half));
        if (beyond <= cornerwise * fastest || 0.5 * properties.mass * beyond * beyond <= there)
            return;
        bodies.position.put(slot, beginning.position);
        bodies.orientation.put(slot, beginning.orientation);
        ++tick.state.interventions.paths_cut;
    });
}

void EnergyAccount::join_islands(const Tick& tick, std::span<const Slot> slots)
{
    for (const Slot slot : slots) islands_.reset(slot + 1);
    for (const ContactBlock& block : tick.solver.blocks()) {
        if (tick.solver.responds(block.a) && tick.solver.responds(block.b))
            islands_.join(block.a, block.b);
    }
    join_joined(tick.solver.joints(), islands_);
}

/// A share of a joint's impulse would not hold it: JointEnergy settles the islands with joints.
void EnergyAccount::leave_joined(const JointSolver& joints)
{
    for (const JointSolver::Group& group : joints.groups()) {
        if (group.is_awake) balances_[islands_.root_of(joints.body_of(group))].is_settled = true;
    }
}

/// What rests on something fixed has no momentum to keep. Not what a moving surface carries.
void EnergyAccount::find_held(const Tick& tick)
{
    for (const ContactBlock& block : tick.solver.blocks()) {
        if (block.a == 0 || block.b == 0)
            balances_[islands_.root_of(block.a + block.b)].is_held = true;
    }
    for (const ContactBlock& block : tick.solver.blocks()) {
        if (tick.solver.is_kinematic(block.a) || tick.solver.is_kinematic(block.b))
            balances_[islands_.root_of(tick.solver.responding_of(block))].is_held = false;
    }
}

/// One body may gain what others of its island lose.
void EnergyAccount::sum_islands(const Tick& tick, std::span<const Slot> slots)
{
    for (const Slot slot : slots) {
        const SolverIndex root = islands_.root_of(slot + 1);
        if (root != slot + 1) balances_[root].add(balances_[slot + 1]);
    }
    leave_joined(tick.solver.joints());
}

/// Finds how much slower the islands have to become that are held and gained little. What may be
/// gained shrinks with that, too: what grips give, and what is not followed of what turns.
template <typename TickOf>
void EnergyAccount::slow_held(const Tick& tick, std::span<const Slot> slots, TickOf&& tick_of_slot)
{
    bool any = false;
    for (const Slot slot : slots) {
        Balance& island = balances_[slot + 1];
        island.is_slowing =
            islands_.root_of(slot + 1) == slot + 1 && island.is_exceeded() && island.slow();
        any = any || island.is_slowing;
    }
    for (int round = 1; any; ++round) {
        for (const Slot slot : slots) {
            Balance& island = balances_[slot + 1];
            if (island.is_slowing) island = island.emptied();
        }
        for (const Slot slot : slots) {
            Balance& island = balances_[islands_.root_of(slot + 1)];
            if (island.is_slowing)
                island.add(balance_of(tick, slowed(tick_of_slot(slot), island.slowing)));
        }
        any = false;
        for (const Slot slot : slots) {
            Balance& island = balances_[slot + 1];
            if (!island.is_slowing) continue;
            island.is_slowing = false;
            if (!island.is_held || !island.is_exceeded(nearly_settled * island.kinetic)) continue;
            island.is_slowing = any = true;
            if (round < slowing_rounds_max && island.slow()) continue;
            // It would take more: then its impulses pay, from what it was.
            island.slowing = 1.0;
            island.is_held = false;
        }
    }
}

template <typename TickOf>
void EnergyAccount::find_shares(const Tick& tick, std::span<const Slot> slots,
                                TickOf&& tick_of_slot)
{
    sum_islands(tick, slots);
    find_held(tick);
    slow_held(tick, slots, tick_of_slot);
    // What may be gained shrinks with the share: with that of hands, and of what turns.
    for (int round = 0; round < share_rounds_max; ++round) {
        bool any = false;
        for (const Slot slot : slots) {
            Balance& island = balances_[slot + 1];
            if (islands_.root_of(slot + 1) != slot + 1) continue;
            island.is_settled = island.slowing < 1.0 || !island.is_exceeded();
            if (island.is_settled) continue;
            const double share = next_share(island.share, island.share_within(), round);
            island = {};
            island.share = share;
            any = true;
        }
        if (!any) return;
        for (const Slot slot : slots) {
            Balance& island = balances_[islands_.root_of(slot + 1)];
            if (island.is_settled) continue;
            island.add(balance_of(tick, tick_of_slot(slot), island.share));
        }
    }
}

/// Calls scale(slot, share, slowing) for the bodies of islands that gained; returns whether any
/// did.
template <typename Scale>
bool EnergyAccount::scale_islands(const Tick& tick, std::span<const Slot> slots, Scale&& scale)
{
    bool any = false;
    for (const Slot slot : slots) {
        const SolverIndex root = islands_.root_of(slot + 1);
        const double share = balances_[root].share, slowing = balances_[root].slowing;
        if (share == 1.0 && slowing == 1.0) continue;
        any = true;
        if (root == slot + 1) count(tick.state.interventions, share);
        scale(slot, share, slowing);
        if (!tick.active.contains(slot)) continue;
        BodyIntegration& integration = tick.integrations[slot + 1];
        integration.hand_energy_driven *= share;
        integration.driven = integration.driven.scaled(share);
        integration.grips.scale(share);
        if (integration.has_hands)
            tick.hands.scale_impulses(tick.state.bodies.properties[slot].id, share);
    }
    for (ContactBlock& block : tick.solver.blocks()) {
        const SolverIndex body = tick.solver.responds(block.a) ? block.a : block.b;
        const double share = balances_[islands_.root_of(body)].share;
        if (share != 1.0) scale_impulses(*block.memory, share);
    }
    return any;
}

} // namespace hapnet::scene
