// SPDX-FileCopyrightText: 2026 The Hapnet authors
// SPDX-License-Identifier: MIT
#pragma once

#include "device/capabilities.hpp"
#include "peer/core/sync/alpha_beta.hpp"
#include "proto/base/space.hpp"
#include "proto/base/time.hpp"
#include "proto/wire/message.hpp"

namespace hapnet::peer {

/// A hand with its device as seen from the scene: a mass with damping, drawn by a spring to where
/// the person means it to be, and Coulomb friction.
struct HandDynamics {
    double mass_kg = 0.22;
    double damping_ns_per_m = 7.0;
    /// Stiff enough for relaxed, nominal and firm grips: coupled to a contact of 500 N/m, a model
    /// that is wrong by a factor of two still holds.
    double stiffness_n_per_m = 300.0;
    double friction_n = 0.0;

    friend bool operator==(const HandDynamics&, const HandDynamics&) = default;
};

/// Returns the dynamics of a hand as its model describes it. Missing values take the usual ones.
[[nodiscard]] HandDynamics dynamics_of(const wire::HandModel& said);

/// Returns the hand model that a peer sends in its hello. It has the known properties of the
/// device. Those of the person are unknown.
[[nodiscard]] wire::HandModel hand_model_of(const device::Capabilities& capabilities);

/// The place where a hand means to be, as its own peer estimates it from its motion and from the
/// force on it: partners predict each other's goal, not each other's place (Takagi et al., Nature
/// Human Behaviour 2017). It is found here, where every sample is known, since a receiver at 97 %
/// loss has too few to filter.
class Intention {
public:
    explicit Intention(const HandDynamics& hand) : hand_{hand} {}

    struct Sample {
        base::Position hip;
        base::Velocity velocity;
        base::Force force; // force on the hand that the device was told in the tick before
    };
    /// Once a tick. A hand that is not held has no intention: reset() then.
    void add(const Sample& sample, base::TimePoint at);
    void reset() { is_known_ = false; }

    /// The HIP's own place while nothing is known.
    [[nodiscard]] bool is_known() const { return is_known_; }
    [[nodiscard]] base::Position place() const { return {filter_.value()}; }
    [[nodiscard]] base::Velocity velocity() const { return {filter_.slope()}; }
    /// Writes the hand's position, its intention and the velocities of both into a state message.
    void say(wire::State& state, base::Position hip, base::Velocity hip_velocity) const;

private:
    [[nodiscard]] glm::dvec3 within_friction(const glm::dvec3& raw) const;

    /// Removes the grain of the device's positions from the velocity, and the steps that 97 % loss
    /// leaves in the remote's pushes from the intention.
    static constexpr double velocity_filter_s = 0.015;
    static constexpr double filter_s = 0.020;
    /// Slower than this, friction may hold the hand.
    static constexpr double slides_above_m_per_s = 0.004;

    HandDynamics hand_;
    bool is_known_ = false;
    glm::dvec3 velocity_{0.0}; // smoothed velocity of the hand
    glm::dvec3 settled_{0.0};  // the intention before the filter
    AlphaBeta filter_{filter_s};
    base::Duration tick_{};
    double share_ = 0.0; // weight of a new velocity after an interval of tick_
};

} // namespace hapnet::peer
