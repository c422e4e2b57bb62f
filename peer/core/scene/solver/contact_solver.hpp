// SPDX-FileCopyrightText: 2026 The Hapnet authors
// SPDX-License-Identifier: MIT
#pragma once

#include "peer/core/scene/solver/block.hpp"
#include "peer/core/scene/solver/scratch.hpp"

#include <cstdint>
#include <span>

namespace hapnet::scene {

/// When to stop.
struct SolverLimits {
    double quiet = 0.0;  // m/s: a contact that misses by less is left alone
    double enough = 0.0; // m/s: when no contact changed its speed by more, that was it
    std::uint32_t sweeps_max = 1;
};

/// How far it came.
struct SolverOutcome {
    std::uint32_t sweeps = 0;
    double change = 0.0; // m/s, of the last sweep: the largest of a contact's speed
};

/// Solves all contacts of a tick for the velocities at its end: block after block (each as a whole:
/// projected Gauss-Seidel), in turns from the first to the last and back, and when a few sweeps do
/// not do it, along conjugate directions (nonsmooth nonlinear conjugate gradients, Silcowitz,
/// Niebe, Erleben, "Nonsmooth Newton method / NNCG for contact problems", VRIPHYS 2010), which is
/// what carries a heavy body on a light one and a stack. A contact that is in balance already costs
/// a look.
class ContactSolver {
public:
    ContactSolver(std::size_t bodies, std::size_t blocks);

    /// Begins a tick: no contacts, and bodies 1 .. `bodies`.
    void begin(std::size_t bodies);

    [[nodiscard]] BodyResponse& response(SolverIndex body) { return responses_[body]; }
    /// At the end of the tick.
    [[nodiscard]] BodyMotion& ending(SolverIndex body) { return ending_[body]; }
    /// The mean over the tick: what moves the bodies.
    [[nodiscard]] BodyMotion& mean(SolverIndex body) { return mean_[body]; }

    [[nodiscard]] bool is_full() const { return blocks_.is_full(); }
    ContactBlock& add() { return blocks_.add(); }
    void take_back() { blocks_.take_back(); }
    [[nodiscard]] std::span<ContactBlock> blocks() { return blocks_.all(); }

    /// Changes the impulses of the contacts and the velocities at the end of the tick.
    SolverOutcome solve(const SolverLimits& limits);
    /// The same for the mean velocities, without friction, and impulses that begin at zero.
    SolverOutcome separate(const SolverLimits& limits);
    /// What one block changes in velocities that are told.
    Modal solve_one(ContactBlock& block, const Modal& velocity, double quiet);
    void apply(const ContactBlock& block, const Modal& change, std::span<BodyMotion> motions);
    [[nodiscard]] std::span<BodyMotion> endings() { return ending_.all(); }
    [[nodiscard]] std::span<BodyMotion> means() { return mean_.all(); }

private:
    enum class Mode : std::uint8_t { contacts, separations };
    /// What is solved, and for which velocities.
    struct Task {
        Mode mode = Mode::contacts;
        std::span<BodyMotion> motions;
        double quiet = 0.0;
    };

    SolverOutcome run(const Task& task, const SolverLimits& limits);
    double sweep(const Task& task, bool forward);
    double visit(ContactBlock& block, const Task& task);
    void mark();
    double go_on(const Task& task, double was2, bool is_first);

    Scratch<BodyResponse> responses_;
    Scratch<BodyMotion> ending_;
    Scratch<BodyMotion> mean_;
    Scratch<ContactBlock> blocks_;
};

} // namespace hapnet::scene
