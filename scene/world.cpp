// SPDX-FileCopyrightText: 2026 The Hapnet authors
// SPDX-License-Identifier: MIT
#include "scene/world.hpp"

#include "proto/base/ensure.hpp"
#include "proto/base/math.hpp"
#include "scene/fields.hpp"
#include "scene/maths/rotation.hpp"

#include <array>
#include <bit>
#include <cmath>
#include <glm/geometric.hpp>
#include <spdlog/fmt/fmt.h>

namespace hapnet::scene {

namespace {

// The marks in WorldState::is_pushed.
constexpr std::uint8_t is_pushed_mark = 1;
constexpr std::uint8_t is_twisted_mark = 2;

/// Returns the reason why a vector is refused.
inline std::optional<Refusal> objection(const glm::dvec3& v, double most)
{
    if (is_within(v, most)) return std::nullopt;
    return base::is_finite(v) ? Refusal::out_of_range : Refusal::not_finite;
}

std::optional<Refusal> objection(const glm::dquat& q)
{
    const double square = q.w * q.w + q.x * q.x + q.y * q.y + q.z * q.z;
    if (!std::isfinite(square)) return Refusal::not_finite;
    constexpr double tolerance = 1e-6;
    if (std::abs(square - 1.0) > tolerance) return Refusal::out_of_range;
    return std::nullopt;
}

/// True if a body may be turned from one orientation to the other.
bool can_turn(Turning turning, const glm::dquat& from, const glm::dquat& to)
{
    if (turning == Turning::free) return true;
    const glm::dquat by = to * glm::conjugate(from);
    constexpr double tolerance = 1e-9;
    const int axis = static_cast<int>(turning) - static_cast<int>(Turning::about_x);
    const std::array<double, 3> parts{by.x, by.y, by.z};
    for (int i = 0; i < 3; ++i) {
        const bool is_free = turning != Turning::locked && i == axis;
        if (!is_free && std::abs(parts[static_cast<std::size_t>(i)]) > tolerance) return false;
    }
    return true;
}

/// Hashes eight bytes at a time, which is fast enough for every tick. After MurmurHash3's finaliser
/// (A. Appleby), public domain.
class BitHash {
public:
    void add(std::uint64_t bits)
    {
        hash_ = (hash_ ^ bits) * 0xff51afd7ed558ccdU;
        hash_ ^= hash_ >> 33U;
    }
    void add(double value) { add(std::bit_cast<std::uint64_t>(value)); }
    [[nodiscard]] std::uint64_t value() const { return hash_; }

private:
    std::uint64_t hash_ = 0x9e3779b97f4a7c15U;
};

WorldConfig config_from(const Description& description, const FreezeOptions& options)
{
    return {.planes = description.planes,
            .hands = description.hands,
            .gravity = description.gravity,
            .tick = base::to_seconds(options.tick),
            .sleeping = options.sleeping,
            .feels = HandFeels{description},
            .fields = description.fields,
            .internal_faces = InternalFaces{Bodies{description}}};
}

WorldState initial_state(const Description& description)
{
    WorldState state{.bodies = Bodies{description}};
    for (HandInput& hand : state.hands) hand.present = false;
    state.pushes.resize(description.bodies.size());
    state.torques.resize(description.bodies.size());
    state.pushed = Bounded<BodyId>{description.bodies.size()};
    state.twisted = Bounded<BodyId>{description.bodies.size()};
    state.is_pushed.resize(description.bodies.size());
    if (has_hand_friction(description)) state.slips.resize(description.hands.count);
    for (Slot slot = state.bodies.movable; slot < state.bodies.moving; ++slot) {
        const Sway& sway = description.bodies[state.bodies.properties[slot].id].sway;
        const bool sways = sway.period != base::Duration{};
        state.scripts.push_back(
            {.kind = sways ? KinematicScript::Kind::sways : KinematicScript::Kind::steady,
             .sway = sway,
             .target = state.bodies.state(slot)});
    }
    return state;
}

Stepper make_stepper(StepperKind kind, const Description& description, const WorldConfig& config,
                     const WorldState& state)
{
    switch (kind) {
    case StepperKind::flight: return FreeFlightStepper{description, config, state};
    case StepperKind::sliding: return OneBoxStepper<false>{description, config, state};
    case StepperKind::sliding_coulomb: return OneBoxStepper<true>{description, config, state};
    case StepperKind::lone: return RigidStepper<BroadPhase::none>{description, config, state};
    case StepperKind::few: return RigidStepper<BroadPhase::all_pairs>{description, config, state};
    case StepperKind::many: break;
    }
    return RigidStepper<BroadPhase::grid>{description, config, state};
}

} // namespace

base::Result<World> World::freeze(const Description& description, const FreezeOptions& options)
{
    if (auto checked = check(description); !checked) return tl::unexpected{checked.error()};
    if (options.tick < tick_min || options.tick > tick_max) {
        return base::fail("a tick lasts 10 us to 100 ms");
    }
    const FeatureSet needed = required_features(requirements_of(description, options.sleeping));
    const StepperKind kind = options.stepper.value_or(cheapest_stepper(needed));
    if (!abilities_of(kind).covers(needed)) {
        return base::fail(fmt::format("the stepper '{}' cannot do what the scene needs; '{}' "
                                      "can",
                                      name_of(kind), name_of(cheapest_stepper(needed))));
    }
    return World{description, options, kind};
}

World::World(const Description& description, const FreezeOptions& options, StepperKind kind)
    : config_{config_from(description, options)},
      kind_{kind},
      has_fields_{!config_.fields.empty()},
      state_{initial_state(description)},
      stepper_{make_stepper(kind, description, config_, state_)}
{}

World::~World() = default;
World::World(World&&) noexcept = default;
World& World::operator=(World&&) noexcept = default;
World::World(const World&) = default;
World& World::operator=(const World&) = default;

std::optional<Refusal> World::refuse(Refusal refusal)
{
    ++refused_[static_cast<std::size_t>(refusal)];
    return refusal;
}

std::optional<Refusal> World::set_hand(std::uint32_t index, const HandInput& input)
{
    if (index >= config_.hands.count) return refuse(Refusal::no_such_hand);
    const glm::dvec3& position = input.position.value;
    const glm::dvec3& velocity = input.velocity.value;
    if (!is_within(position, reach_max_m) || !is_within(velocity, speed_max_m_per_s)) {
        const auto why = objection(position, reach_max_m);
        return refuse(why ? *why : *objection(velocity, speed_max_m_per_s));
    }
    state_.hands[index] = input;
    return std::nullopt;
}

std::optional<Refusal> World::push(BodyId body, base::Force force)
{
    if (!is_movable(body)) return refuse(Refusal::no_such_body);
    if (const auto why = objection(force.value, force_max_n)) return refuse(*why);
    const glm::dvec3 sum = state_.pushes[body] + force.value;
    if (const auto why = objection(sum, force_max_n)) return refuse(*why);
    if (state_.is_pushed[body] == 0) state_.pushed.add(body);
    state_.is_pushed[body] |= is_pushed_mark;
    state_.pushes[body] = sum;
    return std::nullopt;
}

std::optional<Refusal> World::push(BodyId body, base::Force force, base::Position at)
{
    if (!is_movable(body)) return refuse(Refusal::no_such_body);
    if (const auto why = objection(force.value, force_max_n)) return refuse(*why);
    if (const auto why = objection(at.value, reach_max_m)) return refuse(*why);
    const glm::dvec3 torque = glm::cross(at.value - position(body).value, force.value);
    for (const glm::dvec3& twist : {torque, state_.torques[body] + torque}) {
        if (const auto why = objection(twist, torque_max_n_m)) return refuse(*why);
    }
    if (const auto refused = push(body, force)) return refused;
    return push_torque(body, torque);
}

std::optional<Refusal> World::push_torque(BodyId body, const glm::dvec3& torque)
{
    if (!is_movable(body)) return refuse(Refusal::no_such_body);
    if (const auto why = objection(torque, torque_max_n_m)) return refuse(*why);
    const glm::dvec3 sum = state_.torques[body] + torque;
    if (const auto why = objection(sum, torque_max_n_m)) return refuse(*why);
    std::uint8_t& marks = state_.is_pushed[body];
    if (marks == 0) state_.pushed.add(body);
    if ((marks & is_twisted_mark) == 0) state_.twisted.add(body);
    marks |= is_pushed_mark | is_twisted_mark;
    state_.torques[body] = sum;
    return std::nullopt;
}

std::optional<Refusal> World::apply_impulse(BodyId body, const glm::dvec3& impulse,
                                            base::Position at)
{
    if (!is_movable(body)) return refuse(Refusal::no_such_body);
    if (const auto why = objection(impulse, impulse_max_n_s)) return refuse(*why);
    if (const auto why = objection(at.value, reach_max_m)) return refuse(*why);
    Bodies& bodies = state_.bodies;
    const Slot slot = bodies.slot_of[body];
    const BodyProperties& properties = bodies.properties[slot];
    const glm::dvec3 velocity = bodies.velocity.at(slot) + properties.inverse_mass * impulse;
    const glm::dvec3 turning =
        about_unlocked_axes(properties, glm::cross(at.value - bodies.position.at(slot), impulse));
    const glm::dvec3 momentum = bodies.angular_momentum.at(slot) + turning;
    if (const auto why = objection(velocity, speed_max_m_per_s)) return refuse(*why);
    if (const auto why =
            objection(bodies.apply_inverse_inertia(slot, momentum), turn_max_rad_per_s)) {
        return refuse(*why);
    }
    wake(body);
    const Slot awake = bodies.slot_of[body];
    bodies.velocity.put(awake, velocity);
    bodies.angular_momentum.put(awake, momentum);
    return std::nullopt;
}

/// Makes the body take part in the next tick. Nothing else about it changes.
void World::wake(BodyId body)
{
    std::visit(
        [&](auto& stepper) {
            if constexpr (requires { stepper.wake(state_, body); }) stepper.wake(state_, body);
        },
        stepper_);
}

std::optional<Refusal> World::place(BodyId body, const BodyState& state)
{
    if (!is_movable(body)) return refuse(Refusal::no_such_body);
    if (const auto why = objection(state.position.value, reach_max_m)) return refuse(*why);
    if (const auto why = objection(state.orientation)) return refuse(*why);
    if (const auto why = objection(state.velocity.value, speed_max_m_per_s)) return refuse(*why);
    if (const auto why = objection(state.angular_velocity, turn_max_rad_per_s)) {
        return refuse(*why);
    }
    const Slot slot = state_.bodies.slot_of[body];
    BodyState usable = state;
    usable.orientation = base::normalized(state.orientation);
    const Turning turning = state_.bodies.properties[slot].turning;
    if (!can_turn(turning, state_.bodies.orientation.at(slot), usable.orientation)) {
        return refuse(Refusal::out_of_range);
    }
    if (turning == Turning::locked) usable.orientation = state_.bodies.orientation.at(slot);
    const glm::dvec3 current = state_.bodies.position.at(slot);
    const glm::dvec3& light = state_.bodies.properties[slot].inverse_mass;
    for (const int axis : {0, 1, 2}) {
        if (light[axis] == 0.0) usable.position.value[axis] = current[axis];
    }
    state_.bodies.put(slot, usable);
    std::visit([&](auto& stepper) { stepper.on_body_placed(state_, body); }, stepper_);
    return std::nullopt;
}

std::optional<Refusal> World::place(BodyId body, base::Position position, base::Velocity velocity)
{
    if (!is_movable(body)) return refuse(Refusal::no_such_body);
    if (const auto why = objection(position.value, reach_max_m)) return refuse(*why);
    if (const auto why = objection(velocity.value, speed_max_m_per_s)) return refuse(*why);
    const Slot slot = state_.bodies.slot_of[body];
    const glm::dvec3 current = state_.bodies.position.at(slot);
    const glm::dvec3& light = state_.bodies.properties[slot].inverse_mass;
    for (const int axis : {0, 1, 2}) {
        if (light[axis] != 0.0) continue;
        position.value[axis] = current[axis];
        velocity.value[axis] = 0.0;
    }
    state_.bodies.position.put(slot, position.value);
    state_.bodies.velocity.put(slot, velocity.value);
    std::visit([&](auto& stepper) { stepper.on_body_placed(state_, body); }, stepper_);
    return std::nullopt;
}

std::optional<Refusal> World::shift(BodyId body, base::Displacement way)
{
    if (!is_movable(body)) return refuse(Refusal::no_such_body);
    const Slot slot = state_.bodies.slot_of[body];
    glm::dvec3 place = state_.bodies.position.at(slot);
    const glm::dvec3& light = state_.bodies.properties[slot].inverse_mass;
    for (const int axis : {0, 1, 2}) {
        if (light[axis] != 0.0) place[axis] += way.value[axis];
    }
    if (const auto why = objection(place, reach_max_m)) return refuse(*why);
    state_.bodies.position.put(slot, place);
    std::visit([&](auto& stepper) { stepper.on_body_shifted(state_, body); }, stepper_);
    return std::nullopt;
}

std::optional<Refusal> World::shift(BodyId body, base::Displacement way, const glm::dvec3& turn)
{
    if (!is_movable(body)) return refuse(Refusal::no_such_body);
    if (const auto why = objection(turn, base::two_pi)) return refuse(*why);
    const Slot before = state_.bodies.slot_of[body];
    const glm::dquat orientation = state_.bodies.orientation.at(before);
    const glm::dvec3 by = about_unlocked_axes(state_.bodies.properties[before], turn);
    state_.bodies.orientation.put(before, rotated(orientation, by));
    const auto refused = shift(body, way);
    if (refused) state_.bodies.orientation.put(before, orientation);
    return refused;
}

std::optional<Refusal> World::drive(BodyId body, base::Velocity velocity,
                                    const glm::dvec3& angular_velocity)
{
    if (!is_kinematic(body)) return refuse(Refusal::no_such_body);
    if (const auto why = objection(velocity.value, speed_max_m_per_s)) return refuse(*why);
    if (const auto why = objection(angular_velocity, turn_max_rad_per_s)) return refuse(*why);
    const Slot slot = slot_of(body);
    state_.scripts[slot - state_.bodies.movable] = {};
    state_.bodies.velocity.put(slot, velocity.value);
    state_.bodies.angular_momentum.put(slot, angular_velocity);
    return std::nullopt;
}

std::optional<Refusal> World::move(BodyId body, const BodyState& target)
{
    if (!is_kinematic(body)) return refuse(Refusal::no_such_body);
    if (const auto why = objection(target.position.value, reach_max_m)) return refuse(*why);
    if (const auto why = objection(target.orientation)) return refuse(*why);
    if (const auto why = objection(target.velocity.value, speed_max_m_per_s)) return refuse(*why);
    if (const auto why = objection(target.angular_velocity, turn_max_rad_per_s)) {
        return refuse(*why);
    }
    const glm::dvec3 way = target.position.value - position(body).value;
    if (const auto why = objection(way / config_.tick, speed_max_m_per_s)) return refuse(*why);
    KinematicScript& script = state_.scripts[slot_of(body) - state_.bodies.movable];
    script = {.kind = KinematicScript::Kind::target, .target = target};
    script.target.orientation = base::normalized(target.orientation);
    return std::nullopt;
}

TickCost World::tick_cost_bound() const
{
    return std::visit([&](const auto& stepper) { return stepper.tick_cost_bound(config_); },
                      stepper_);
}

void World::tick()
{
    if (!has_fields_) {
        step();
        return;
    }
    push_by_fields();
    step();
    feel_fields(config_, state_);
}

inline void World::step()
{
    std::visit([&](auto& stepper) { stepper.step(config_, state_); }, stepper_);
    if (!state_.pushed.is_empty()) forget_pushes();
    ++state_.ticks;
}

void World::push_by_fields()
{
    Bodies& bodies = state_.bodies;
    if (kind_ == StepperKind::flight) state_.touches.fill({}); // this stepper has no hands
    for (Slot slot = 0; slot < bodies.movable; ++slot) {
        glm::dvec3 force{0.0};
        for (const FieldDescription& field : config_.fields)
            force += force_on_body(field, config_, bodies, slot);
        if (force == glm::dvec3{0.0}) continue;
        const BodyId body = bodies.properties[slot].id;
        if (state_.is_pushed[body] == 0) state_.pushed.add(body);
        state_.is_pushed[body] |= is_pushed_mark;
        state_.pushes[body] += force;
    }
}

void World::forget_pushes()
{
    for (const BodyId body : state_.pushed) {
        state_.pushes[body] = glm::dvec3{0.0};
        state_.torques[body] = glm::dvec3{0.0};
        state_.is_pushed[body] = 0;
    }
    state_.pushed.clear();
    state_.twisted.clear();
}

bool World::is_movable(BodyId id) const
{
    return id < state_.bodies.size() && state_.bodies.slot_of[id] < state_.bodies.movable;
}

bool World::is_kinematic(BodyId id) const
{
    return id < state_.bodies.size() &&
           state_.bodies.properties[state_.bodies.slot_of[id]].is_kinematic;
}

BodyState World::body(BodyId id) const { return state_.bodies.state(slot_of(id)); }

bool World::is_awake(BodyId id) const { return slot_of(id) < state_.bodies.awake; }

void World::restore(const Snapshot& snapshot)
{
    base::ensure(snapshot.stepper.index() == stepper_.index() &&
                 snapshot.state.bodies.size() == state_.bodies.size());
    state_ = snapshot.state;
    stepper_ = snapshot.stepper;
}

void World::restore(const World& other)
{
    base::ensure(other.kind_ == kind_ && other.state_.bodies.size() == state_.bodies.size());
    state_ = other.state_;
    stepper_ = other.stepper_;
}

std::uint64_t World::hash() const
{
    const Bodies& bodies = state_.bodies;
    BitHash hash;
    hash.add(state_.ticks);
    for (BodyId id = 0; id < bodies.size(); ++id) {
        const Slot slot = bodies.slot_of[id];
        for (const auto* lanes : {&bodies.position, &bodies.velocity, &bodies.angular_momentum}) {
            hash.add(lanes->x[slot]);
            hash.add(lanes->y[slot]);
            hash.add(lanes->z[slot]);
        }
        const glm::dquat turn = bodies.orientation.at(slot);
        for (const double part : {turn.w, turn.x, turn.y, turn.z}) hash.add(part);
    }
    return hash.value();
}

} // namespace hapnet::scene
