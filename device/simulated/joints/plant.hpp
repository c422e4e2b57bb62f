// SPDX-FileCopyrightText: 2026 The Hapnet authors
// SPDX-License-Identifier: MIT
#pragma once

#include "device/omni/encoders.hpp"
#include "device/simulated/operator.hpp"
#include "proto/base/space.hpp"
#include "proto/base/time.hpp"

#include <glm/mat3x3.hpp>
#include <optional>

namespace hapnet::device {

/// The Omni's mechanism and motors, joint by joint. Figures that the data sheet does not have are
/// estimates, and are marked as such.
struct JointPlantFigures {
    double tip_mass_kg = omni::tip_mass_kg;
    double tip_damping_ns_per_m = 0.2; // estimate
    glm::dvec3 rotor_kg_m2{2e-5};      // inertia of each motor at its joint: estimate
    /// Coulomb friction at each joint: 0.26 N at the stylus in its direction, at the origin.
    glm::dvec3 friction_nm{omni::friction_n * omni::depth_m, omni::friction_n* omni::link_m,
                           omni::friction_n* omni::link_m};
    glm::dvec3 torque_max_nm = omni::torque_max_nm;
    double dock_hold_n = 1.0;   // force that pulls the stylus out of its inkwell: estimate
    double dock_reach_m = 4e-3; // distance at which the inkwell catches the stylus
    bool begins_docked = true;  // false: the stylus begins at the origin
    /// The encoders' angles when the power came on.
    omni::Joints zero{{0.30, -0.20, 0.10}};
};

/// A hand on the stylus: it pulls toward its target like a damped spring, and its mass moves with
/// the stylus.
struct Grip {
    base::Position target;
    base::Velocity target_velocity;
    HandImpedance hand{}; // its mass contains the device's own
};

/// An Omni as a mechanism. Its inputs are motor torques and a hand, and its outputs are angles. The
/// apparent mass is at the tip, and the rotors are at the joints. The hand compensates gravity.
/// Every joint ends at hard stops. The inkwell holds the stylus until it is pulled out.
/// Deterministic: the same calls give the same bits.
class JointPlant {
public:
    explicit JointPlant(const JointPlantFigures& figures = {});

    /// Sets the commanded motor torques, N m. They saturate.
    void set_torque(const glm::dvec3& newton_metres);
    /// Sets the hand's grip; nullopt: no hand holds it.
    void set_grip(const std::optional<Grip>& grip) { grip_ = grip; }

    /// Simulates `elapsed`, in equal steps of 50 us at most. The grip's target continues at
    /// constant speed.
    void advance(base::Duration elapsed);

    [[nodiscard]] const omni::Joints& joints() const { return joints_; }
    [[nodiscard]] const glm::dvec3& turning() const { return turning_; } // joint velocities, rad/s
    [[nodiscard]] base::Position tip() const { return tip_; }
    [[nodiscard]] base::Velocity tip_velocity() const { return velocity_; }
    [[nodiscard]] bool is_docked() const { return is_docked_; }
    [[nodiscard]] omni::Counts counts() const { return omni::counts_at(joints_, figures_.zero); }
    /// Returns the motor torques after saturation, N m.
    [[nodiscard]] const glm::dvec3& torque() const { return torque_; }
    [[nodiscard]] const JointPlantFigures& figures() const { return figures_; }

    static constexpr base::Duration step_max{std::chrono::microseconds{50}};

private:
    void step(double seconds);
    [[nodiscard]] glm::dvec3 hand_force() const;
    void rub(const glm::dmat3& mobility, double seconds);
    void stop_at_the_ends();
    void see_where_it_is();
    [[nodiscard]] bool is_pulled_out() const;
    void try_the_inkwell();

    JointPlantFigures figures_;
    omni::Joints joints_;
    glm::dvec3 turning_{0.0};
    glm::dvec3 torque_{0.0};
    std::optional<Grip> grip_;
    bool is_docked_;
    // Values that follow from the angles.
    glm::dmat3 jacobian_{0.0};
    base::Position tip_;
    base::Velocity velocity_;
};

} // namespace hapnet::device
