// SPDX-FileCopyrightText: 2026 The Hapnet authors
// SPDX-License-Identifier: MIT
#include "scene/rigid/step.hpp"

#include "scene/collide/sweep.hpp"
#include "scene/hand/midpoint.hpp"
#include "scene/maths/rotation.hpp"
#include "scene/rigid/step_steady.hpp"
#include "scene/rigid/step_velocities.hpp"

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>

namespace hapnet::scene {

namespace {

// The greatest average number of contacts per body. A heap of cubes has about six.
constexpr std::size_t contacts_per_body_max = 8;

// A contact whose error is less than this share of the speed that gravity adds in a tick is in
// balance.
constexpr double velocity_tolerance = 1e-10;
// The solver continues until no contact changes its speed by more than this share of it ...
constexpr double velocity_converged = 1e-6;
// ... or until these limits (a stack takes 23 sweeps from zero); the next tick continues.
constexpr std::uint32_t sweeps_min = 3, sweeps_max = 31, visits_max = 600;

// Overlaps, in shares of the smallest half edge: the tolerance, the change at which the solver
// stops, and the greatest correction in one tick.
constexpr double overlap_tolerance = 1e-9;
constexpr double overlap_converged = 1e-6;
constexpr double correction_max = 0.1;
constexpr std::uint32_t overlap_sweeps_min = 7, overlap_visits_max = 200;
// The share of an overlap that is removed per tick. It is less than 1, so that contacts that
// contradict each other come to rest.
constexpr double correction_share = 0.3;

// Surfaces that push each other and are nearer than this, in smallest half edges, touch. The
// correction of overlaps leaves smaller gaps. Closing them completely would keep heaps from coming
// to rest.
constexpr double touch_distance = 2e-6;

/// Returns the least normal speed at which two surfaces at this distance do not overlap at the
/// tick's end.
double velocity_bias(const ContactBlock& block, std::size_t point, const Scales& scales)
{
    const double separation = block.separation[point];
    const double negligible = block.start_impulse[point] > 0.0 ? touch_distance * block.size : 0.0;
    return separation > negligible ? -separation * scales.rate : 0.0;
}

/// Returns the least mean normal speed that removes a share of an overlap, or uses up a gap.
double position_bias(const ContactBlock& block, std::size_t point, const Scales& scales)
{
    const double separation = block.separation[point];
    if (separation >= 0.0) return -separation * scales.rate;
    return std::min(correction_share * -separation, correction_max * block.size) * scales.rate;
}

std::size_t blocks_for(const WorldConfig& config, const Bodies& bodies)
{
    const std::size_t others = bodies.parts_count() - 1 + config.planes.size();
    return bodies.movable_parts() * std::min(others, contacts_per_body_max);
}

} // namespace

template <BroadPhase broad_phase>
RigidStepper<broad_phase>::RigidStepper(const Description& /*description*/,
                                        const WorldConfig& config, const WorldState& state)
    : scales_{scales_of(config, state.bodies)},
      pairs_{config, state.bodies},
      sleep_{config, state.bodies},
      hand_contacts_{config},
      modes_{config.hands.count},
      boxes_{state.bodies, scales_},
      free_bodies_{config, state.bodies},
      active_{state.bodies.movable},
      kinematics_{state.bodies, scales_},
      plane_contacts_{pairs_.plane_pairs_max()},
      integrations_{state.bodies.moving + std::size_t{1}},
      solver_{state.bodies.moving, blocks_for(config, state.bodies)},
      restitution_{config, state.bodies, blocks_for(config, state.bodies), scales_},
      energy_{state.bodies},
      continuous_{config, state.bodies, scales_},
      any_round_{state.bodies.any_is_round()}
{
    steady_.is_possible = can_be_steady(config, state);
}

template <BroadPhase broad_phase>
void RigidStepper<broad_phase>::step(const WorldConfig& config, WorldState& state)
{
    state.tick_cost = {};
    const bool has_kinematics = state.bodies.moving != state.bodies.movable;
    if (has_kinematics) kinematics_.begin_tick(config, state);
    update_pairs(state);
    if (steady_.is_likely && step_steadily(config, state)) return;
    collide_hands(config, state);
    wake_disturbed(state);
    begin_contacts(state);
    if (has_kinematics) kinematics_.begin_contacts(state.bodies, solver_, integrations_.all());
    collide_planes(config, state);
    collide_bodies(config, state);
    warm_start(solver_, integrations_.all());
    integrate_velocities(config, state); // gravity, pushes, drag, the hands' springs
    const bool bounced = restitution_.apply(solver_, integrations_.all(), state.interventions);
    const bool changed = solve_velocities(state.tick_cost);
    if (bounced || changed) solve_anew_what_gains(config, state);
    if (has_kinematics) add_driven_energy(solver_, integrations_.all());
    store_contact_impulses(state);
    stop_sliding_contacts(state.bodies, scales_, solver_, integrations_.all());
    const bool moved_apart = correct_positions(state);
    if (has_kinematics && kinematics_.any_far()) any_far_ = true;
    const bool may_gain = bounced || changed || moved_apart || any_far_;
    if (may_gain) energy_.begin(energy_tick(config, state));
    integrate_positions(config, state);
    integrate_free_bodies(state);
    if (any_far_) solve_continuous(config, state);
    if (may_gain) {
        const bool has_touched = any_far_ && continuous_.has_changed_any();
        energy_.settle(energy_tick(config, state), has_touched ? &continuous_ : nullptr);
    }
    if (has_kinematics) kinematics_.end_tick(state);
    active_.clear();
    report_hand_forces(config, state);
    if (steady_.is_possible && !bounced && !changed) look_for_steadiness(config, state);
    update_sleep(state);
}

template <BroadPhase broad_phase>
void RigidStepper<broad_phase>::on_body_placed(WorldState& state, BodyId body)
{
    on_body_shifted(state, body);
    hand_contacts_.forget(state.bodies, body);
}

template <BroadPhase broad_phase>
void RigidStepper<broad_phase>::on_body_shifted(WorldState& state, BodyId body)
{
    steady_.is_likely = false;
    // This wakes the bodies that touched it, and those that it touches now.
    sleep_.wake(body, state.bodies, pairs_);
    pairs_.forget(state.bodies, body);
    boxes_.forget(state.bodies, body);
}

template <BroadPhase broad_phase>
void RigidStepper<broad_phase>::wake(WorldState& state, BodyId body)
{
    sleep_.wake(body, state.bodies, pairs_);
}

template <BroadPhase broad_phase>
TickCost RigidStepper<broad_phase>::tick_cost_bound(const WorldConfig& config) const
{
    const std::uint64_t pushed =
        std::min<std::uint64_t>(solver_.bodies_max(), config.hands.count * touched_per_hand_max);
    // Some work is done more than once: overlaps are solved again where a body is held back; pairs
    // of sleepers are examined for kinematic bodies, for touching bodies and after waking;
    // velocities and springs are solved again where an island is.
    return {.pairs = 4 * pairs_.pairs_max(),
            .contacts = solver_.blocks_max(),
            .visits = 2 * solver_.visits_bound(velocity_limits()) +
                      2 * solver_.visits_bound(position_limits()),
            .spring_rows = 4 * pushed * MidpointBudget::rows_solved_max, // against drag, twice
            .looks = continuous_.looks_max()};
}

template <BroadPhase broad_phase>
SolverLimits RigidStepper<broad_phase>::velocity_limits() const
{
    return {velocity_tolerance * scales_.speed, velocity_converged * scales_.speed, sweeps_max,
            sweeps_min, visits_max};
}

template <BroadPhase broad_phase>
SolverLimits RigidStepper<broad_phase>::position_limits() const
{
    return {overlap_tolerance * scales_.rate, overlap_converged * scales_.rate, sweeps_max,
            overlap_sweeps_min, overlap_visits_max};
}

template <BroadPhase broad_phase>
void RigidStepper<broad_phase>::update_pairs(const WorldState& state)
{
    pairs_.update(state.bodies);
    boxes_.begin_tick();
}

/// Finds the bodies that the hands touch, and wakes them.
template <BroadPhase broad_phase>
void RigidStepper<broad_phase>::collide_hands(const WorldConfig& config, WorldState& state)
{
    Bodies& bodies = state.bodies;
    hand_contacts_.begin_step(config, state);
    modes_.resize(config.hands.count);
    const auto target_of = [&](PartId part) {
        return HandContacts::target_of(bodies, part, boxes_.at(bodies, part));
    };
    for (std::uint32_t hand = 0; hand < config.hands.count; ++hand) {
        const HandInput& input = state.hands[hand];
        if (input.present) {
            const glm::dvec3& from = input.position.value;
            const double radius =
                config.hands.radius_m + (input.gripping ? config.hands.grip_reach_m : 0.0);
            for (const PartId id :
                 pairs_.near_hand(hand, {from, from + scales_.tick * input.velocity.value, radius}))
                hand_contacts_.collide(config, state, hand, target_of(id));
        }
        hand_contacts_.forget_departed(hand);
    }
    if (hand_contacts_.feels_planes()) hand_contacts_.feel_planes(config, state);
    if (hand_contacts_.any_friction()) hand_contacts_.add_friction(config, state, target_of);
    for (const HandContacts::Spring& spring : hand_contacts_.springs())
        sleep_.wake(spring.body, bodies, pairs_);
}

/// Wakes bodies that are pushed, and bodies that a moving body hits.
template <BroadPhase broad_phase>
void RigidStepper<broad_phase>::wake_disturbed(WorldState& state)
{
    Bodies& bodies = state.bodies;
    for (const BodyId body : state.pushed) sleep_.wake(body, bodies, pairs_);
    const auto are_touching = [&](PairIndex index) {
        ++state.tick_cost.pairs;
        return collide_pair(state, pairs_.pair(index)).manifold.count > 0;
    };
    if (bodies.moving != bodies.movable) wake_carried(state, are_touching);
    sleep_.wake_touched(bodies, pairs_, are_touching);
}

/// Wakes bodies that touch a moving kinematic body, and keeps them awake.
template <BroadPhase broad_phase>
template <typename AreTouching>
void RigidStepper<broad_phase>::wake_carried(WorldState& state, const AreTouching& are_touching)
{
    Bodies& bodies = state.bodies;
    const PairSet& pairs = pairs_.all_pairs();
    for (Slot slot = bodies.movable; slot < bodies.moving; ++slot) {
        if (!kinematics_.of(bodies, slot).moves) continue;
        const BodyId id = bodies.properties[slot].id;
        const auto wake = [&](PairIndex index, PartId other) {
            const bool is_awake = bodies.slot_of[other] < bodies.awake;
            const bool touches_it = is_awake ? touches(pairs[index].memory) : are_touching(index);
            if (touches_it) sleep_.wake(other, bodies, pairs_);
        };
        bodies.for_parts(id, [&](PartId part) {
            pairs.for_first(part, [&](PairIndex i) { wake(i, pairs[i].b); });
            pairs.for_second(part, [&](PairIndex i) { wake(i, pairs[i].a); });
        });
    }
}

/// Returns a body's index in the solver. Kinematic bodies come after the awake ones; a body that
/// does not move has index 0.
template <BroadPhase broad_phase>
SolverIndex RigidStepper<broad_phase>::index_of(const Bodies& bodies, Slot slot) const
{
    if (slot < bodies.awake) return slot + 1;
    if (slot < bodies.movable || slot >= bodies.moving) return 0;
    return kinematics_.of(bodies, slot).moves ? bodies.awake + 1 + (slot - bodies.movable) : 0;
}

template <BroadPhase broad_phase>
void RigidStepper<broad_phase>::begin_contacts(const WorldState& state)
{
    const Bodies& bodies = state.bodies;
    const std::size_t kinematic = bodies.moving - bodies.movable;
    solver_.begin(bodies.awake, kinematic);
    integrations_.resize(bodies.awake + kinematic + 1); // [0]: does not move, never written
}

/// Starts the tick of an awake body on which something acts.
template <BroadPhase broad_phase>
void RigidStepper<broad_phase>::activate(const Bodies& bodies, Slot slot)
{
    if (!active_.add(slot)) return;
    const BodyProperties& properties = bodies.properties[slot];
    const SweptBox& first = boxes_.at(bodies, properties.id);
    solver_.response(slot + 1) = response_of(
        properties, properties.has_parts() ? axes_of(first.orientation) : first.box.axes);
    reset(integrations_[slot + 1]);
    integrations_[slot + 1].least_near = properties.least_half;
}

/// Adds a block to the solver. Returns null without a point or without room.
template <BroadPhase broad_phase>
ContactBlock* RigidStepper<broad_phase>::add_contact(std::uint32_t points, ContactMemory& memory)
{
    if (points == 0) {
        memory.count = 0;
        return nullptr;
    }
    if (solver_.is_full()) {
        ++counts_.contacts_left_out;
        memory.count = 0;
        return nullptr;
    }
    ContactBlock& block = solver_.add();
    block.memory = &memory;
    block.bounce_impulse = block.locked_load = 0.0;
    return &block;
}

template <BroadPhase broad_phase>
void RigidStepper<broad_phase>::set_least_speeds(ContactBlock& block)
{
    for (std::uint32_t i = 0; i < block.count; ++i)
        block.speed_min[i] = velocity_bias(block, i, scales_);
}

/// Sets the least mean normal speeds, as set_least_speeds() does for the velocities.
template <BroadPhase broad_phase>
void RigidStepper<broad_phase>::set_least_ways(ContactBlock& block)
{
    for (std::uint32_t i = 0; i < block.count; ++i)
        block.speed_min[i] = position_bias(block, i, scales_);
}

/// Sets the load of a body that is locked along the normal. It presses on its support nevertheless.
template <BroadPhase broad_phase>
void RigidStepper<broad_phase>::set_locked_load(const WorldConfig& config, const WorldState& state,
                                                Slot slot, ContactBlock& block)
{
    const BodyProperties& body = state.bodies.properties[slot];
    const glm::dvec3& light = body.inverse_mass;
    if (light.x > 0.0 && light.y > 0.0 && light.z > 0.0) return;
    const std::span<const double> gaps{block.separation.data(), block.count};
    if (*std::min_element(gaps.begin(), gaps.end()) > touch_distance * block.size) return;
    const glm::dvec3 all = body.mass * config.gravity + state.pushes[body.id];
    const glm::dvec3 locked{light.x > 0.0 ? 0.0 : all.x, light.y > 0.0 ? 0.0 : all.y,
                            light.z > 0.0 ? 0.0 : all.z};
    const double into = block.a == 0 ? -1.0 : 1.0;
    block.locked_load = std::max(0.0, into * scales_.tick * glm::dot(locked, block.normal));
}

template <BroadPhase broad_phase>
void RigidStepper<broad_phase>::collide_planes(const WorldConfig& config, WorldState& state)
{
    const Bodies& bodies = state.bodies;
    const std::span<const PairIndex> pairs = pairs_.plane_pairs();
    state.tick_cost.pairs += pairs.size();
    plane_contacts_.resize(pairs.size());
    for (std::size_t i = 0; i < pairs.size(); ++i) {
        Pair& pair = pairs_.plane_pair(pairs[i]);
        const PlaneDescription& plane = config.planes[pair.b];
        const Slot slot = bodies.slot_of[pair.a];
        const SweptBox& now = boxes_.at(bodies, pair.a);
        const OrientedBox& box = now.box;
        PlaneContact& contact = plane_contacts_[i];
        const double height = glm::dot(plane.normal, box.centre) - plane.offset_m;
        const std::uint32_t points =
            contact.find({pair.a, pair.b, plane.normal, height, now.reach, box.axes,
                          now.orientation, box.half, box.rounding});
        const BodyProperties& properties = bodies.properties[slot];
        const double size = smallest_half(box);
        const bool is_dragged = properties.drag > 0.0 &&
                                (touches(pair.memory) || contact.lies_on(touch_distance * size));
        ContactBlock* const block = add_contact(points, pair.memory);
        if (block == nullptr) continue;
        contact.prepare(*block, pair.memory);
        block->size = size;
        if (properties.has_parts()) block->arm_a = block->arm_b += now.offset;
        set_least_speeds(*block);
        activate(bodies, slot);
        block->a = 0;
        block->b = slot + 1;
        if (any_round_) block->set_roundings(0.0, box.rounding);
        const Material material = combined(properties.material, plane.material);
        block->friction = material.friction;
        block->restitution = material.restitution;
        set_locked_load(config, state, slot, *block);
        if (is_dragged) {
            integrations_[block->b].drag = properties.drag / properties.mass;
            integrations_[block->b].support_normal = plane.normal;
        }
    }
}

template <BroadPhase broad_phase>
SweptContact RigidStepper<broad_phase>::collide_pair(const WorldState& state, Pair& pair)
{
    const Bodies& bodies = state.bodies;
    const auto sweep = [&](PartId part) { return sweep_of(bodies, part, boxes_.at(bodies, part)); };
    return collide_swept(sweep(pair.a), sweep(pair.b), scales_.tick, pair.memory.axis);
}

template <BroadPhase broad_phase>
void RigidStepper<broad_phase>::collide_bodies(const WorldConfig& config, WorldState& state)
{
    const Bodies& bodies = state.bodies;
    state.tick_cost.pairs += pairs_.pairs().size();
    for (const PairIndex index : pairs_.pairs()) {
        Pair& pair = pairs_.pair(index);
        const Slot a = bodies.slot_of[pair.a];
        const Slot b = bodies.slot_of[pair.b];
        SweptContact swept = collide_pair(state, pair);
        if (config.internal_faces.any()) {
            config.internal_faces.leave_outer({pair.a, boxes_.at(bodies, pair.a).box},
                                              {pair.b, boxes_.at(bodies, pair.b).box},
                                              swept.manifold);
        }
        // Whatever the result is, ContinuousCollision examines their paths.
        const double size =
            smallest_half(boxes_.at(bodies, pair.a).box, boxes_.at(bodies, pair.b).box);
        const auto note_near = [&](Slot slot) {
            if (slot >= bodies.awake) return;
            activate(bodies, slot);
            double& least = integrations_[slot + 1].least_near;
            least = std::min(least, size);
        };
        if (swept.may_pass) {
            note_near(a);
            note_near(b);
        }
        ContactBlock* const block = add_contact(swept.manifold.count, pair.memory);
        if (block == nullptr) continue;
        prepare(*block, swept.manifold, swept.centres, pair.memory);
        block->size = size;
        set_least_speeds(*block);
        const Material material =
            combined(bodies.properties[a].material, bodies.properties[b].material);
        note_near(a);
        note_near(b);
        block->a = index_of(bodies, a);
        block->b = index_of(bodies, b);
        if (any_round_)
            block->set_roundings(boxes_.at(bodies, pair.a).box.rounding,
                                 boxes_.at(bodies, pair.b).box.rounding);
        block->friction = material.friction;
        block->restitution = material.restitution;
        const auto note = [&](SolverIndex body, const glm::dvec3& normal, PartId other,
                              PartId own) {
            FirstTouch& first = integrations_[body].first_touch;
            if (swept.first_touch < first.time) first = {swept.first_touch, normal, other, own};
        };
        if (block->a == 0 || block->b == 0)
            set_locked_load(config, state, block->a == 0 ? b : a, *block);
        note(block->a, block->normal, pair.b, pair.a);
        note(block->b, -block->normal, pair.a, pair.b);
    }
}

/// Stores the impulses for the next tick's warm start, and counts the contacts with friction.
template <BroadPhase broad_phase>
void RigidStepper<broad_phase>::store_contact_impulses(const WorldState& state)
{
    const auto mass_of = [&](SolverIndex index) {
        return solver_.responds(index) ? state.bodies.properties[index - 1].mass : 0.0;
    };
    for (const ContactBlock& block : solver_.blocks()) {
        if (!keeps_impulses(block, *block.memory)) {
            const double weight = (mass_of(block.a) + mass_of(block.b)) * scales_.speed;
            store_impulses(block, weight, *block.memory);
        }
        block.memory->normal_impulse_of_tick = block.normal_sum() + block.bounce_impulse;
        if (!(block.friction_limit() > 0.0)) continue;
        if (block.a != 0) ++integrations_[block.a].friction_contacts;
        if (block.b != 0) ++integrations_[block.b].friction_contacts;
    }
}

/// Changes the mean velocities so that nothing overlaps at the end of the tick. The velocities at
/// the end stay as they are, so the correction adds no speed (nonlinear Gauss-Seidel). Returns true
/// if anything was corrected.
template <BroadPhase broad_phase>
bool RigidStepper<broad_phase>::correct_positions(WorldState& state)
{
    for (ContactBlock& block : solver_.blocks()) {
        set_least_ways(block);
        if (!block.turns) continue;
        for (double& part : block.centripetal_velocity) part *= 0.5; // now the mean of the tick
    }
    const std::uint64_t visits = solver_.correct_positions(position_limits()).visits;
    state.tick_cost.visits += visits;
    // A body that is thrown off its path is held back. The others go as far as that allows.
    if (!hold_back(state)) return visits > 0;
    state.tick_cost.visits += solver_.correct_positions_again(position_limits()).visits;
    hold_back(state);
    return true;
}

/// Holds back bodies that were thrown off their paths. Returns true if there were any.
template <BroadPhase broad_phase>
bool RigidStepper<broad_phase>::hold_back(WorldState& state)
{
    const Ways ways =
        keep_within_swept_path(state, active_.slots(), integrations_.all(), solver_, scales_);
    any_far_ = ways.any_far;
    return ways.any_kept;
}

template <BroadPhase broad_phase>
void RigidStepper<broad_phase>::integrate_positions(const WorldConfig& config, WorldState& state)
{
    if (any_far_) continuous_.begin(config, state, active_.slots(), integrations_.all(), solver_);
    for (const Slot slot : active_.slots())
        integrate_position(integrations_[slot + 1], state.bodies, slot, solver_, scales_);
}

/// Moves the bodies on which nothing acts but gravity.
template <BroadPhase broad_phase>
void RigidStepper<broad_phase>::integrate_free_bodies(WorldState& state)
{
    Bodies& bodies = state.bodies;
    active_.for_inactive(bodies.awake,
                         [&](SlotRange range) { free_bodies_.integrate(bodies, range); });
}

/// Lets no body pass through another, and wakes the bodies that were hit on the way.
template <BroadPhase broad_phase>
void RigidStepper<broad_phase>::solve_continuous(const WorldConfig& config, WorldState& state)
{
    continuous_.solve({config, state, kinematics_}, active_.slots(), pairs_);
    state.tick_cost.looks = continuous_.looks();
    for (const BodyId body : continuous_.woken()) sleep_.wake(body, state.bodies, pairs_);
}

template <BroadPhase broad_phase>
void RigidStepper<broad_phase>::report_hand_forces(const WorldConfig& config, WorldState& state)
{
    hand_contacts_.report_forces(config, state);
}

template <BroadPhase broad_phase>
void RigidStepper<broad_phase>::update_sleep(WorldState& state)
{
    sleep_.update(state.bodies, pairs_, state.ticks);
}

template class RigidStepper<BroadPhase::none>;
template class RigidStepper<BroadPhase::all_pairs>;
template class RigidStepper<BroadPhase::grid>;

} // namespace hapnet::scene
