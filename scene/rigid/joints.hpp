// SPDX-FileCopyrightText: 2026 The Hapnet authors
// SPDX-License-Identifier: MIT
#pragma once

#include "scene/rigid/integrate.hpp"
#include "scene/rigid/joint_order.hpp"
#include "scene/solver/joint_solver.hpp"
#include "scene/state.hpp"

#include <array>
#include <optional>
#include <span>
#include <vector>

namespace hapnet::scene {

/// What joints make of a tick: their rows for the solver, and what they did.
///
/// A row takes the directions in which its joint acts as they are halfway through the tick (guessed
/// from the velocities at its start), and asks that the mean of the velocities at the start and at
/// the end goes along the joint. Then its impulse does no work whatever it is, as it is met by that
/// mean velocity. What the start misses, after a blow, is taken away. Springs and dampers push with
/// the force of that mean velocity, too (the implicit midpoint rule): passive at any stiffness.
/// What is left in the bodies' places goes as overlaps do, without a change of velocity.
class Joints {
public:
    Joints(const Description& description, const Bodies& bodies, const Scales& scales);

    [[nodiscard]] bool is_empty() const { return joints_.empty(); }
    /// The bodies of a group that move, by their ids.
    [[nodiscard]] std::span<const BodyId> bodies_of(std::size_t group) const
    {
        return {&members_[member_begins_[group]],
                member_begins_[group + 1] - member_begins_[group]};
    }
    /// The group of a body, if it has a joint.
    [[nodiscard]] std::optional<std::uint32_t> group_of(BodyId body) const;

    /// Says which groups are awake.
    void begin_contacts(const Bodies& bodies, ContactSolver& solver) const;
    /// The rows of all awake groups, with last tick's impulses, which count as constant forces of
    /// their bodies. The bodies have to be active.
    void begin_tick(const WorldState& state, ContactSolver& solver);
    void warm_start(ContactSolver& solver, std::span<BodyIntegration> integrations) const;
    /// While bodies turn, the arms turn on which their joints pull: taut chains swing to and fro
    /// the faster the tauter they are. From stiffen() to soften(), around the solver, turning the
    /// arms counts as inertia that a body has more, which is the implicit midpoint rule for it.
    void stiffen(const Bodies& bodies, ContactSolver& solver,
                 std::span<BodyIntegration> integrations);
    void soften(ContactSolver& solver);
    /// Keeps the impulses for the next tick.
    void store_impulses(WorldState& state, ContactSolver& solver);
    /// What the mean velocities that were solved for leave to be corrected.
    void set_way_targets(const WorldState& state, ContactSolver& solver,
                         std::span<const BodyIntegration> integrations);
    /// Rows that contradict each other could throw bodies anywhere: no correction moves a body of
    /// a group farther than the smallest half edge.
    void bound_ways(ContactSolver& solver) const;
    /// At the end: coordinates, and what the springs hold.
    void end_tick(WorldState& state, const JointSolver& solver);
    /// Reads the coordinates of a body's joints where it was put.
    void on_placed(WorldState& state, BodyId body) const;
    /// The same for one group, whose bodies were put elsewhere.
    void read_places(WorldState& state, std::size_t group);

    /// Of the springs of a group, J: at the tick's start and at its end.
    struct Stored {
        double before = 0.0;
        double after = 0.0;
    };
    [[nodiscard]] const Stored& stored(std::size_t group) const { return stored_[group]; }
    /// Whether nothing in the group's joints took energy in this tick.
    [[nodiscard]] bool keeps_energy(const JointSolver& solver, std::size_t group) const;

private:
    /// An orientation's three directions of a joint: its axis, and two across.
    struct Frame {
        glm::dvec3 axis{0.0}, across{0.0}, aside{0.0};
    };
    struct Pose {
        glm::dvec3 centre{0.0};
        glm::dquat orientation{1.0, 0.0, 0.0, 0.0};
    };
    /// What does not change of a joint.
    struct Form {
        JointDescription description;
        std::uint32_t holding = 0; // rows that hold; then a spring, then limits
        glm::dvec3 anchor_a{0.0}, anchor_b{0.0};
        Frame frame_a, frame_b;
        glm::dquat turn{1.0, 0.0, 0.0, 0.0}; // from b to a, in the description
        double rest = 0.0;
        /// A spring that is slack at no length pulls along each axis of the world alike.
        [[nodiscard]] bool pulls_to_point() const
        {
            return description.kind == JointKind::spring && rest == 0.0;
        }
        /// The first row of a limit.
        [[nodiscard]] std::uint32_t limits_begin() const
        {
            const bool pulls = pulls_to_point() && description.stiffness > 0.0;
            const bool along = pulls_to_point() ? description.damping > 0.0 : has_spring();
            return holding + (pulls ? 3U : 0U) + (along ? 1U : 0U);
        }
        [[nodiscard]] bool has_spring() const
        {
            return description.stiffness > 0.0 || description.damping > 0.0;
        }
    };
    /// A joint at a moment.
    struct Place {
        glm::dvec3 arm_a{0.0}, arm_b{0.0};
        glm::dvec3 way{0.0}; // from the one anchor to the other
        Frame a, b;
        glm::dquat turn{1.0, 0.0, 0.0, 0.0};
    };
    /// A body between stiffen() and soften().
    struct Stiffened {
        SolverIndex body = 0;
        glm::dmat3 inertia{0.0};         // its own, in the world's frame
        glm::dmat3 inverse_inertia{0.0}; // as it responds otherwise
        glm::dvec3 spin{0.0};            // predicted without
    };
    struct Arms {
        glm::dvec3 a{0.0}, b{0.0};
    };
    struct Memory {
        std::array<double, JointBlock::rows_max> impulse{};
        double coordinate = 0.0;
    };

    [[nodiscard]] Form form_of(const Description& scene, const JointDescription& joint) const;
    [[nodiscard]] static Pose pose_of(const Bodies& bodies, std::optional<BodyId> body);
    [[nodiscard]] Pose halfway(const Bodies& bodies, std::optional<BodyId> body) const;
    [[nodiscard]] static Place place_of(const Form& form, const Pose& a, const Pose& b);
    static void set_rows(JointBlock& block, const Form& form, const Place& place);
    [[nodiscard]] static double miss_of(const Form& form, const Place& place, std::uint32_t row);
    [[nodiscard]] static double coordinate_of(const Form& form, const Place& place, double last);
    /// A spring as it pulls along one row.
    struct Pull {
        double stiffness = 0.0;
        double damping = 0.0;
        double bend = 0.0;
    };
    void begin_joint(std::uint32_t i, const Bodies& bodies, ContactSolver& solver);
    [[nodiscard]] static Pull pull_of(const Form& form, const Place& start, const Place& middle,
                                      std::uint32_t row, double coordinate);
    void set_spring(JointRow& row, const Pull& pull, double speed, double response) const;
    void set_limit(JointRow& row, const Form& form, double gap, double speed) const;
    [[nodiscard]] double energy_of(std::size_t index, double coordinate) const;

    Scales scales_;
    std::vector<Form> joints_{};
    std::vector<JointId> ids_{};
    std::vector<JointSolver::Group> groups_{};
    std::vector<BodyId> members_{};
    std::vector<std::uint32_t> member_begins_{};
    std::vector<std::uint32_t> group_of_{}; // by body; group count: none
    std::vector<Memory> memories_{};
    std::vector<Stored> stored_{};
    std::vector<Arms> arms_{}; // of this tick
    Scratch<Stiffened> stiffened_{};
    struct Way {
        SolverIndex body = 0;
        BodyMotion mean;
    };
    Scratch<Way> ways_{};                     // before they are corrected, group by group
    std::vector<std::uint32_t> way_begins_{}; // of each group, and the end
};

} // namespace hapnet::scene
