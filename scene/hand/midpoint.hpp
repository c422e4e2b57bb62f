// SPDX-FileCopyrightText: 2026 The Hapnet authors
// SPDX-License-Identifier: MIT
#pragma once

#include "scene/hand/surface.hpp"

#include <array>
#include <span>

namespace hapnet::scene {

/// A rigid body under any number of springs, which may hold: the implicit midpoint rule, in
/// sub-ticks short against the stiffest mode. The mean force of a unilateral spring over a sub-tick
/// is its energy's difference over its depth's (a discrete gradient): so with held directions
/// neither contact that begins nor one that ends makes or loses energy. Second order; stable
/// however stiff. Forces add to what is in `work`.
class MidpointRule {
public:
    MidpointRule(MovingBody& body, const BodyDynamics& dynamics,
                 std::span<const HandSpring> springs, std::span<SpringImpulse> work);

    void advance(double time);

private:
    static constexpr std::size_t springs_max = 8;
    static constexpr std::size_t rows_max = 3 * springs_max;

    /// One direction of one spring.
    struct Row {
        std::size_t spring = 0;
        glm::dvec3 normal{0.0};
        glm::dvec3 lever{0.0};
        glm::dvec3 inverse_inertia_lever{0.0}; // the inverse inertia times the lever
        double depth = 0.0;                    // at the start of the sub-tick
        double closing = 0.0; // mean over the sub-tick, without the springs' forces
        double mean = 0.0;    // mean closing with them
        double force = 0.0;   // mean
        double slope = 0.0;   // of the force over the mean closing
    };
    struct Spring {
        const HandSpring* form = nullptr;
        BoxSurface surface;
        glm::dvec3 hand{0.0};   // seen from the body's centre; of one that holds, where it pulls
        glm::dvec3 anchor{0.0}; // of one that holds, in the body's frame
        double depth = 0.0;     // carried from one sub-tick to the next while it acts
    };
    using Matrix = std::array<std::array<double, rows_max>, rows_max>;

    [[nodiscard]] int substeps(double time);
    void set_rows(double substep);
    void solve(double substep);
    void update_forces(double substep);
    void newton_step(double substep);
    void limit_grip_force(std::size_t first);
    void apply(double substep);

    MovingBody& body_;
    const BodyDynamics& dynamics_;
    std::span<SpringImpulse> work_;
    bool rotates_;
    glm::dmat3 inverse_inertia_; // halfway, of the sub-tick
    glm::dmat3 inertia_now_;     // inverse
    std::size_t springs_ = 0;
    std::size_t rows_ = 0;
    std::array<Spring, springs_max> spring_;
    std::array<Row, rows_max> row_;
    Matrix coupling_{};
};

} // namespace hapnet::scene
