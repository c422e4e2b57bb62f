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

/// The most that a tick of the midpoint rule may cost: substeps times steps of Newton's method
/// times rows (a spring that pushes has one, one that holds or has friction three). With few rows
/// there are more substeps.
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

/// A rigid body under any number of springs, which may hold, and drag along a plane: the implicit
/// midpoint rule, in substeps short against the stiffest mode as far as the budget goes. The mean
/// force of a unilateral spring over a substep is its energy's difference over its depth's (a
/// discrete gradient): so with held directions neither contact that begins nor one that ends makes
/// or loses energy. Second order; stable however stiff. Forces add to what is in `work`.
///
/// All springs act on one body, so Newton's method goes on in its six velocities. Where its steps
/// end before it has converged, momentum is kept all the same; energy is the caller's to check.
///
/// Where springs may have friction (`rubs`), a push has two more rows, along the surface. With the
/// stretch e at the start of a substep and e* = e + h v at its end if nothing slid, the pull is
/// k (e + e*)/2 + c v, cut to the cone of the push, and the stretch then e*, cut to what stores
/// that pull. So k |e|^2 / 2 takes in no more than the pull's work, whether it sticks or slides.
template <bool rubs = false>
class MidpointRule {
public:
    MidpointRule(MovingBody& body, const BodyDynamics& dynamics,
                 std::span<const HandSpring> springs, std::span<SpringImpulse> work);

    /// The friction of each spring; has to be set before the tick where springs may have any.
    void set_friction(std::span<FrictionSpring> frictions) requires rubs;

    /// Returns how many rows it has solved: of each substep, once for each step of Newton's method.
    std::size_t advance(double time);

private:
    static constexpr std::size_t springs_max = MidpointBudget::springs_max;
    static constexpr std::size_t rows_max = MidpointBudget::rows_max;

    /// Velocities of the centre and of turning, scaled so that a force changes them by itself.
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
    /// The pull of a spring along the surface; its rows are the two after that of the push.
    struct Pull {
        FrictionSpring* form = nullptr;
        glm::dvec3 stretch{0.0};
        bool is_cut = false;
        double along_1 = 0.0, along_2 = 0.0; // unit: direction of the cut pull in the two rows
    };

    [[nodiscard]] int substeps(double time);
    void set_rows(const PlaneDrag& drag, double substep);
    void solve(double substep);
    /// The forces at these velocities; returns how far they are from what the forces make of them.
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
