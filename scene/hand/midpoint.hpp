// SPDX-FileCopyrightText: 2026 The Hapnet authors
// SPDX-License-Identifier: MIT
#pragma once

#include "scene/hand/friction.hpp"
#include "scene/hand/plane_drag.hpp"
#include "scene/hand/surface.hpp"

#include <algorithm>
#include <array>
#include <cstddef>
#include <span>

namespace hapnet::scene {

/// The limit of the work of a tick of the midpoint rule: substeps times steps of Newton's method
/// times rows. A spring that pushes has one row; a spring that holds or has friction has three.
/// With few rows there are more substeps.
struct MidpointBudget {
    static constexpr std::size_t springs_max = 8;
    static constexpr std::size_t rows_max = 3 * springs_max;
    static constexpr std::size_t newton_steps_max = 6;
    static constexpr std::size_t rows_solved_max = 1500;
    [[nodiscard]] static constexpr std::size_t substeps_max(std::size_t rows)
    {
        constexpr std::size_t most = 32;
        return std::min(most,
                        rows_solved_max / (newton_steps_max * std::max<std::size_t>(rows, 1)));
    }
};

/// A rigid body under any number of springs, some of which may hold it, and under drag along a
/// plane. It is solved by the implicit midpoint rule. The substeps are short against the stiffest
/// mode as far as the budget allows. The mean force of a unilateral spring over a substep is its
/// change of energy over its change of depth (a discrete gradient). So with held directions a
/// contact that begins or ends neither makes nor loses energy. The rule is second order and stable
/// however stiff the springs are. Its forces add to the values in `work`.
///
/// All springs act on one body, so Newton's method runs on the body's six velocities. Where its
/// steps end before it has converged, momentum is conserved nevertheless. The caller has to check
/// the energy.
///
/// If `rubs`, a push has two more rows, along the surface, for its friction. Let e be the stretch
/// at the start of a substep and e* = e + h v the stretch at its end if nothing slid. The pull is k
/// (e + e*)/2 + c v, cut to the cone of the push. The new stretch is e*, cut to the stretch that
/// stores that pull. So k |e|^2 / 2 takes in no more than the pull's work, whether the hand sticks
/// or slides.
template <bool rubs = false>
class MidpointRule {
public:
    MidpointRule(MovingBody& body, const BodyDynamics& dynamics,
                 std::span<const HandSpring> springs, std::span<SpringImpulse> work);

    /// Sets the friction of each spring. Call it before the tick where springs may have friction.
    void set_friction(std::span<FrictionSpring> frictions) requires rubs;

    /// Returns the number of rows that it has solved, counted in each step of Newton's method of
    /// each substep.
    std::size_t advance(double time);

private:
    static constexpr std::size_t springs_max = MidpointBudget::springs_max;
    static constexpr std::size_t rows_max = MidpointBudget::rows_max;

    /// The velocities of the centre and of rotation, divided by the square root of the body's
    /// response to forces (PlaneDrag::root_of_response() and RootOfHalf).
    struct Six {
        glm::dvec3 linear{0.0};
        glm::dvec3 angular{0.0};
        friend double dot(const Six& a, const Six& b)
        {
            return glm::dot(a.linear, b.linear) + glm::dot(a.angular, b.angular);
        }
        void add(double scale, const Six& other)
        {
            linear += scale * other.linear;
            angular += scale * other.angular;
        }
        [[nodiscard]] std::array<double, 6> all() const
        {
            return {linear.x, linear.y, linear.z, angular.x, angular.y, angular.z};
        }
    };
    /// A row of the equations: one direction of one spring.
    struct Row {
        std::size_t spring = 0;
        glm::dvec3 normal{0.0};
        glm::dvec3 lever{0.0};
        double depth = 0.0;   // at the start of the substep
        double closing = 0.0; // mean over the substep, without the springs' forces
        Six response{};       // response of the scaled velocities to the row's force
        double mean = 0.0;    // mean closing speed, with the springs' forces
        double force = 0.0;   // mean over the substep
        double slope = 0.0;   // derivative of `force` by `mean`
    };
    struct Spring {
        const HandSpring* form = nullptr;
        BoxSurface surface;
        glm::dvec3 hand{0.0};    // from the body's centre: the hand, or where a grip pulls to
        glm::dvec3 anchor{0.0};  // for a spring that holds: the held point, in the body's frame
        double depth = 0.0;      // kept from one substep to the next while the spring acts
        bool is_limited = false; // the spring holds with its greatest force, along `pull`
        glm::dvec3 pull{0.0};    // unit
    };
    /// The pull of a spring along the surface. Its rows are the two that follow the row of the
    /// push.
    struct Pull {
        FrictionSpring* form = nullptr;
        glm::dvec3 stretch{0.0};
        bool is_cut = false;
        double along_1 = 0.0, along_2 = 0.0; // unit: direction of the cut pull in the two rows
    };

    [[nodiscard]] int substeps(double time);
    void set_rows(const PlaneDrag& drag, double substep);
    void solve(double substep);
    /// Computes the forces at these velocities. Returns how far these velocities are from those
    /// that follow from the forces.
    Six update_forces(const Six& velocities, double substep);
    [[nodiscard]] Six newton_step(const Six& missed, double substep) const;
    void limit_grip_force(std::size_t first);
    [[nodiscard]] bool is_rough(std::size_t spring) const;
    void update_pull(std::size_t push, double substep) requires rubs;
    void slide(std::size_t push, double substep) requires rubs;
    [[nodiscard]] Six newton_step_unsymmetric(const Six& missed,
                                              double substep) const requires rubs;
    void apply(const PlaneDrag& drag, double substep);

    MovingBody& body_;
    const BodyDynamics& dynamics_;
    std::span<SpringImpulse> work_;
    bool rotates_;
    glm::dmat3 inverse_inertia_; // halfway through the substep
    glm::dmat3 inertia_now_;     // inverse inertia at the present time
    std::size_t springs_ = 0;
    std::size_t rows_ = 0;
    std::size_t rows_solved_ = 0;
    std::array<Spring, springs_max> spring_;
    std::array<Row, rows_max> row_;
    std::array<Pull, rubs ? springs_max : 0> pull_;
};

extern template class MidpointRule<false>;
extern template class MidpointRule<true>;

} // namespace hapnet::scene
