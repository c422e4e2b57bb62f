// SPDX-FileCopyrightText: 2026 The Hapnet authors
// SPDX-License-Identifier: MIT
#pragma once

#include "proto/base/ensure.hpp"
#include "proto/base/time.hpp"
#include "scene/one_box/step.hpp"
#include "scene/requirements.hpp"
#include "scene/rigid/free_flight.hpp"
#include "scene/rigid/step.hpp"
#include "scene/state.hpp"

#include <array>
#include <cstdint>
#include <optional>
#include <variant>

namespace hapnet::scene {

inline constexpr base::Duration tick_min{std::chrono::microseconds{10}};
inline constexpr base::Duration tick_max{std::chrono::milliseconds{100}};

/// Options for freezing a scene.
struct FreezeOptions {
    base::Duration tick{std::chrono::milliseconds{1}}; // tick_min..tick_max
    bool sleeping = true;                              // bodies at rest fall asleep
    /// A stepper to use instead of the cheapest one. It must support all that the scene requires.
    std::optional<StepperKind> stepper{};
};

/// The reason why an input was refused. The world stays as it was.
enum class Refusal : std::uint8_t { not_finite, out_of_range, no_such_body, no_such_hand };
inline constexpr std::size_t refusals = 4;

/// The number of refused inputs, by cause.
using RefusalCounts = std::array<std::uint64_t, refusals>;

/// The stepper that moves a world by ticks. It is chosen when the scene is frozen. Each stepper is
/// a value with the functions step(config, state); on_body_placed(state, body), for after a body
/// was put elsewhere; and on_body_shifted(state, body), for after a body was moved by a little.
/// Steppers whose bodies sleep also have wake(state, body). The order is that of StepperKind.
using Stepper = std::variant<FreeFlightStepper, OneBoxStepper<false>, OneBoxStepper<true>,
                             RigidStepper<BroadPhase::none>, RigidStepper<BroadPhase::all_pairs>,
                             RigidStepper<BroadPhase::grid>>;

/// A scene that runs. It does no I/O, reads no clock, and takes no memory after freeze(). Set its
/// inputs with set_hand() and push(), advance it with tick(), and read the result. An input that is
/// not finite or out of range is refused and counted, and changes nothing.
///
/// A World is a value: copies run independently. Equal inputs give equal bits with every compiler.
class World {
public:
    /// Makes a world from a description. The error says what is wrong with the description or the
    /// options.
    [[nodiscard]] static base::Result<World> freeze(const Description& description,
                                                    const FreezeOptions& options = {});

    // These are defined in world.cpp. Otherwise every file that uses a World would compile copies
    // of all steppers.
    ~World();
    World(World&&) noexcept;
    World& operator=(World&&) noexcept;
    World(const World&);
    World& operator=(const World&);

    /// Sets the place and motion of a hand, from the next tick on.
    std::optional<Refusal> set_hand(std::uint32_t index, const HandInput& input);
    /// Applies a force to a movable body's centre for the next tick. Several pushes before one tick
    /// add up.
    std::optional<Refusal> push(BodyId body, base::Force force);
    /// Applies a force to a movable body at a point in the world's frame for the next tick. Several
    /// pushes before one tick add up. The force also turns the body, as far as the body can turn.
    /// Its torque is about the present centre.
    std::optional<Refusal> push(BodyId body, base::Force force, base::Position at);
    /// Applies a torque in N m, in the world's frame, for the next tick. Several torques before one
    /// tick add up. A body does not turn about an axis about which it cannot turn.
    std::optional<Refusal> push_torque(BodyId body, const glm::dvec3& torque);
    /// Applies an impulse in N s at a point in the world's frame. The velocity and the angular
    /// momentum change at once. It is refused as out of range if the body were then faster than
    /// place() allows.
    std::optional<Refusal> apply_impulse(BodyId body, const glm::dvec3& impulse, base::Position at);
    /// Puts a movable body somewhere and wakes it. Locked coordinates stay as they are; an
    /// orientation that the body cannot have is refused.
    std::optional<Refusal> place(BodyId body, const BodyState& state);
    /// Puts a movable body at a place with a velocity, as above. Its orientation and angular
    /// velocity stay.
    std::optional<Refusal> place(BodyId body, base::Position position, base::Velocity velocity);

    /// Moves a movable body by a little. Hands that hold it, or press on one of its faces, go on
    /// doing so. Locked coordinates stay as they are.
    std::optional<Refusal> shift(BodyId body, base::Displacement way);
    /// Moves a body like shift(), and turns it about its centre by `turn` radians (world's frame),
    /// as far as it can turn. Its angular momentum stays.
    std::optional<Refusal> shift(BodyId body, base::Displacement way, const glm::dvec3& turn);

    /// Makes a kinematic body move from where it is with this velocity and angular velocity, until
    /// its motion is set again.
    std::optional<Refusal> drive(BodyId body, base::Velocity velocity,
                                 const glm::dvec3& angular_velocity);
    /// Makes a kinematic body reach `target` by the end of the next tick, on a straight line and by
    /// the shortest turn. Then it goes on with the velocity and angular velocity of `target`.
    std::optional<Refusal> move(BodyId body, const BodyState& target);

    void tick();

    [[nodiscard]] BodyState body(BodyId id) const;
    /// The position of body(id), without the rest of its state.
    [[nodiscard]] base::Position position(BodyId id) const
    {
        return {state_.bodies.position.at(slot_of(id))};
    }
    [[nodiscard]] base::Velocity velocity(BodyId id) const
    {
        return {state_.bodies.velocity.at(slot_of(id))};
    }
    [[nodiscard]] bool is_awake(BodyId id) const;
    [[nodiscard]] const HandTouch& touch(std::uint32_t hand) const { return state_.touches[hand]; }
    [[nodiscard]] const WorldState& state() const { return state_; }
    [[nodiscard]] const WorldConfig& frozen() const { return config_; }
    /// Returns the cost of the last tick. tick_cost_bound() returns the greatest cost of a tick of
    /// this scene.
    [[nodiscard]] const TickCost& tick_cost() const { return state_.tick_cost; }
    [[nodiscard]] TickCost tick_cost_bound() const;
    [[nodiscard]] StepperKind stepper_kind() const { return kind_; }
    [[nodiscard]] const Stepper& stepper() const { return stepper_; }
    [[nodiscard]] std::uint64_t ticks() const { return state_.ticks; }
    [[nodiscard]] const RefusalCounts& refused() const { return refused_; }

    /// The data that the next tick depends on.
    struct Snapshot {
        WorldState state;
        Stepper stepper;
    };
    [[nodiscard]] Snapshot snapshot() const { return {state_, stepper_}; }
    /// Restores a snapshot, which must be of a world frozen from the same description and options.
    /// Takes no memory.
    void restore(const Snapshot& snapshot);
    /// Takes over the state of another world, which must be frozen from the same description and
    /// options.
    void restore(const World& other);

    /// Returns a hash over every bit of every body's state, by id. Equal states have equal hashes.
    [[nodiscard]] std::uint64_t hash() const;

private:
    World(const Description& description, const FreezeOptions& options, StepperKind kind);
    std::optional<Refusal> refuse(Refusal refusal);
    void wake(BodyId body);
    void step();
    void push_by_fields();
    void forget_pushes();
    [[nodiscard]] Slot slot_of(BodyId id) const
    {
        base::ensure(id < state_.bodies.size());
        return state_.bodies.slot_of[id];
    }
    [[nodiscard]] bool is_movable(BodyId id) const;
    [[nodiscard]] bool is_kinematic(BodyId id) const;

    WorldConfig config_;
    StepperKind kind_;
    bool has_fields_;
    WorldState state_;
    Stepper stepper_;
    RefusalCounts refused_{};
};

} // namespace hapnet::scene
