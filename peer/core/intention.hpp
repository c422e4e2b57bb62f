// SPDX-FileCopyrightText: 2026 The Hapnet authors
// SPDX-License-Identifier: MIT
#pragma once

#include "device/capabilities.hpp"
#include "peer/core/sync/alpha_beta.hpp"
#include "proto/base/space.hpp"
#include "proto/base/time.hpp"
#include "proto/wire/message.hpp"

namespace hapnet::peer {

/// A model of a hand with its device as the scene sees it: a mass with damping and Coulomb
/// friction, drawn by a spring to the place where the person intends to be.
struct HandDynamics {
    double mass_kg = 0.22;
    double damping_ns_per_m = 7.0;
    /// The stiffness suits relaxed, nominal and firm grips. With a contact of 500 N/m, the model
    /// still holds if it is wrong by a factor of two.
    double stiffness_n_per_m = 300.0;
    double friction_n = 0.0;

    friend bool operator==(const HandDynamics&, const HandDynamics&) = default;
};

/// Returns the dynamics that a hand model describes. Missing values get defaults.
[[nodiscard]] HandDynamics dynamics_of(const wire::HandModel& said);

/// Returns the hand model that a peer sends in its hello. It contains the known properties of the
/// device. Those of the person are unknown.
[[nodiscard]] wire::HandModel hand_model_of(const device::Capabilities& capabilities);

/// The place where a hand intends to be. Its own peer estimates it from the motion of the hand and
/// the force on it, because partners predict each other's goal and not each other's position
/// (Takagi et al., Nature Human Behaviour 2017). The sender computes it, because it knows every
/// sample, while a receiver at 97 % loss has too few of them to filter.
class Intention {
public:
    explicit Intention(const HandDynamics& hand) : hand_{hand} {}

    struct Sample {
        base::Position hip;
        base::Velocity velocity;
        base::Force force; // force sent to the device in the previous tick
    };
    /// Adds the sample of a tick. Call reset() instead for a hand that is not held, which has no
    /// intention.
    void add(const Sample& sample, base::TimePoint at);
    void reset() { is_known_ = false; }

    /// True if the intention is known. Otherwise it equals the position of the HIP.
    [[nodiscard]] bool is_known() const { return is_known_; }
    [[nodiscard]] base::Position place() const { return {filter_.value()}; }
    [[nodiscard]] base::Velocity velocity() const { return {filter_.slope()}; }
    /// Writes the hand's position, its intention and the velocities of both into a state message.
    void say(wire::State& state, base::Position hip, base::Velocity hip_velocity) const;

private:
    [[nodiscard]] glm::dvec3 within_friction(const glm::dvec3& raw) const;

    /// Time constants of filters. The first removes the effect of the device's resolution from the
    /// velocity. The second removes from the intention the steps that 97 % loss causes in the
    /// remote's forces.
    static constexpr double velocity_filter_s = 0.015;
    static constexpr double filter_s = 0.020;
    /// The speed below which friction may hold the hand.
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
