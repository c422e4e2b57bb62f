// SPDX-FileCopyrightText: 2026 The Hapnet authors
// SPDX-License-Identifier: MIT
#pragma once

#include "scene/bounded.hpp"
#include "scene/solver/anderson.hpp"
#include "scene/solver/block_solver.hpp"
#include "scene/solver/held_island.hpp"
#include "scene/solver/islands.hpp"

#include <cstdint>
#include <limits>
#include <span>

namespace hapnet::scene {

/// The limits at which the solver stops.
struct SolverLimits {
    double tolerance = 0.0;       // m/s: a contact whose error is less is left alone
    double converged = 0.0;       // m/s: finished when no contact changes its speed by more
    std::uint32_t sweeps_max = 1; // greatest number of sweeps over an island
    std::uint32_t sweeps_min = 1; // sweeps that every island may use: the first, then to and fro
    /// The greatest number of visits over all islands. An island gets its least sweeps even beyond
    /// them.
    std::uint32_t visits_max = std::numeric_limits<std::uint32_t>::max();
};

/// The effort of a solve, and the change of its last sweep.
struct SolverOutcome {
    std::uint32_t sweeps = 0; // sweeps of the island that needed the most
    double change = 0.0;      // m/s: largest change of a contact's speed in the last sweep
    bool in_balance = true;   // in balance from the start: no impulse had to change
    std::uint64_t visits = 0; // visits to contacts
};

/// Solves all contacts of a tick for the velocities at its end. It solves block after block, each
/// as a whole (projected Gauss-Seidel). A contact that is already in balance costs only a check,
/// and bodies that are at rest or nearly so are done with one sweep. Other bodies that touch each
/// other form islands. An island is swept again and again, to and fro, with Anderson mixing. The
/// mixing makes heavy bodies on light ones, and stacks, converge.
class ContactSolver {
public:
    ContactSolver(std::size_t bodies, std::size_t blocks);

    /// Begins a tick without contacts, with the bodies 1 .. `bodies` and after them `kinematic`
    /// ones. Kinematic bodies move by themselves: their responses have to be zero.
    void begin(std::size_t bodies, std::size_t kinematic = 0);

    /// True if impulses move the body. A body that does not respond does not join others to an
    /// island.
    [[nodiscard]] bool responds(SolverIndex body) const { return body - 1 < responding_; }
    /// Returns a body of the block that responds to impulses.
    [[nodiscard]] SolverIndex responding_of(const ContactBlock& block) const
    {
        return responds(block.a) ? block.a : block.b;
    }
    [[nodiscard]] bool is_kinematic(SolverIndex body) const { return body > responding_; }

    [[nodiscard]] BodyResponse& response(SolverIndex body) { return responses_[body]; }
    /// Returns the body's motion at the end of the tick.
    [[nodiscard]] BodyMotion& end_motion(SolverIndex body) { return end_motions_[body]; }
    /// Returns the body's mean motion over the tick, which moves the body.
    [[nodiscard]] BodyMotion& mean_motion(SolverIndex body) { return mean_motions_[body]; }

    /// Returns the greatest number of visits that a solve of all contacts can take.
    [[nodiscard]] std::uint64_t visits_bound(const SolverLimits& limits) const;

    [[nodiscard]] std::size_t bodies_max() const { return bodies_max_; }
    [[nodiscard]] std::size_t blocks_max() const { return blocks_max_; }
    [[nodiscard]] bool is_full() const { return blocks_.is_full(); }
    ContactBlock& add() { return blocks_.add(); }
    [[nodiscard]] std::span<ContactBlock> blocks() { return blocks_.all(); }

    /// Changes the impulses of the contacts and the velocities at the end of the tick.
    SolverOutcome solve_velocities(const SolverLimits& limits);
    /// Solves the islands with `picked` bodies (1 at their solver index) once more.
    SolverOutcome solve_velocities_anew(const SolverLimits& limits,
                                        std::span<const std::uint8_t> picked);
    /// As solve_velocities(), for the mean velocities: without friction, and with impulses that
    /// begin at zero.
    SolverOutcome correct_positions(const SolverLimits& limits);
    /// True if a contact with the given mean velocities would overlap more at the end than is
    /// allowed. The limits of corrections are rates: they are given for a contact of size 1 m and
    /// scale with its size.
    [[nodiscard]] static bool overlaps(const ContactBlock& block, const ContactVector& velocity,
                                       const SolverLimits& limits)
    {
        for (std::size_t i = 0; i < block.count; ++i) {
            if (block.normal_speed(velocity, i) <
                block.speed_min[i] - limits.tolerance * block.size)
                return true;
        }
        return false;
    }
    /// Corrects the positions once more, after the responses of bodies have changed.
    SolverOutcome correct_positions_again(const SolverLimits& limits);
    /// Solves one block for given velocities, which stay as they are. Returns the impulse.
    ContactVector solve_alone(ContactBlock& block, const ContactVector& velocity, double tolerance);

private:
    enum class Mode : std::uint8_t { contacts, positions };
    /// The problem to solve: the velocities and the mode.
    struct Task {
        Mode mode = Mode::contacts;
        std::span<BodyMotion> motions;
        SolverLimits limits;
    };

    /// The accuracy of a slipping block's solution: full, or by one iteration, which the next sweep
    /// continues.
    enum class Effort : std::uint8_t { full, one_iteration };

    /// The blocks of an island.
    using Island = std::span<const std::uint32_t>;

    SolverOutcome run(const Task& task);
    template <typename Do>
    void for_moving_islands(const Task& task, Do&& act);
    SolverOutcome run_islands(const Task& task);
    SolverOutcome run_island(const Task& task, Island island);
    SolverOutcome run_unmixed(const Task& task, Island island);
    void save(const Task& task, Island island);
    void restore(const Task& task, Island island);
    double sweep(const Task& task, Island island);
    void read_impulses(Island island, std::span<double> impulses) const;
    [[nodiscard]] HeldIsland::Task held_task(const Task& task, Island island);
    [[nodiscard]] bool may_hold(const Task& task, Island island);
    void take_held(const Task& task, Island island);
    void take_mixture(const Task& task, Island island);
    void undo_mixture(const Task& task, Island island);
    double solve_block(ContactBlock& block, const Task& task, Effort depth);
    void apply(const ContactBlock& block, const ContactVector& change,
               std::span<BodyMotion> motions);
    void count_contacts();
    [[nodiscard]] bool is_alone(const ContactBlock& block) const;
    void find_islands();

    SolverIndex responding_ = 0; // number of bodies that respond; later ones move by themselves
    Scratch<BodyResponse> responses_;
    Scratch<BodyMotion> end_motions_;
    Scratch<BodyMotion> mean_motions_;
    Scratch<ContactBlock> blocks_;
    std::size_t bodies_max_;
    std::size_t blocks_max_;

    Scratch<std::uint32_t> contacts_; // number of contacts of each body

    // By solver index; then the blocks in the order of their islands, and where each ends.
    Islands islands_;
    Scratch<std::uint32_t> starts_;
    Scratch<std::uint32_t> order_;
    Scratch<double> before_, after_, good_; // impulses of an island
    Scratch<BodyMotion> saved_;             // motions of the island's bodies
    Anderson anderson_;
    HeldIsland held_;
};

} // namespace hapnet::scene
