// SPDX-FileCopyrightText: 2026 The Hapnet authors
// SPDX-License-Identifier: MIT
#pragma once

#include "scene/bounded.hpp"
#include "scene/solver/contact_block.hpp"
#include "scene/solver/envelope_ldl.hpp"

#include <cstddef>
#include <cstdint>
#include <span>

namespace hapnet::scene {

/// The impulses that hold an island at rest, all at once. If the points that push continue to push
/// and no contact slips, the impulses solve linear equations. Sweeps need longest for a tall stack
/// that tilts as a whole: its modes converge with the fourth power of its height.
class HeldIsland {
public:
    /// Reserves memory for a scene with this number of bodies and blocks.
    HeldIsland(std::size_t bodies, std::size_t blocks);

    /// The problem to solve: an island's blocks, and the responses and motions of their bodies.
    struct Task {
        std::span<ContactBlock> blocks; // all blocks of the scene
        std::span<const std::uint32_t> island;
        std::span<const BodyResponse> responses;
        std::span<const BodyMotion> motions;
    };
    /// Prepares the equations. Returns false if they do not apply: a contact slips, as all do
    /// without friction; a contact pushes with less than three points or with points on a line; or
    /// the island is too large or too many of its contacts meet in one body.
    [[nodiscard]] bool begin(const Task& task);
    /// Solves the equations after begin(). Returns true if in the solution nothing pulls and
    /// friction is within its limit.
    [[nodiscard]] bool solve(const Task& task);
    /// Returns the impulses of the island's blocks, in the island's order.
    [[nodiscard]] std::span<const ContactImpulse> impulses() const { return impulses_.all(); }

private:
    void factor(const Task& task);
    void miss(const Task& task);
    [[nodiscard]] bool take(const Task& task);

    /// A block that pushes.
    struct Holding {
        std::uint32_t block = 0;
        std::uint32_t row = 0; // first row of the block in the equations
        PlaneFit fit{};        // plane fit through the points that push
    };

    Scratch<Holding> holding_;
    Scratch<std::uint32_t> first_of_body_; // by body: first row of the first block on it
    EnvelopeLdl factors_;
    Scratch<double> answer_;
    Scratch<ContactImpulse> impulses_;
};

} // namespace hapnet::scene
