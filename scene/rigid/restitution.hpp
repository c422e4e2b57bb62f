// SPDX-FileCopyrightText: 2026 The Hapnet authors
// SPDX-License-Identifier: MIT
#pragma once

#include "scene/bounded.hpp"
#include "scene/rigid/integrate.hpp"
#include "scene/solver/contact_solver.hpp"
#include "scene/state.hpp"

#include <cstdint>
#include <span>

namespace hapnet::scene {

/// What hits a surface that bounces leaves it at once, at its moment within the tick, and not from
/// the next tick on. The contacts bounce in the order of their moments, each once, and each sees
/// what those before it have changed. No bounce gains energy.
class Restitution {
public:
    /// `blocks`: how many contacts there may be.
    Restitution(const WorldConfig& config, const Bodies& bodies, std::size_t blocks);

    [[nodiscard]] bool is_needed() const { return is_needed_; }

    /// Changes the tentative velocities and their means. Returns whether anything bounced. Where
    /// bodies are `picked` (not 0 at their solver index), of their contacts alone.
    bool apply(ContactSolver& solver, std::span<BodyIntegration> integrations, const Scales& scales,
               Interventions& interventions, std::span<const std::uint8_t> picked = {});

private:
    /// A contact, and when its first point hits, were no other to bounce before.
    struct Hit {
        double time = 0.0;
        std::uint32_t block = 0;
    };

    /// Returns the share of it that gains no energy.
    static double bounce(ContactBlock& block, ContactSolver& solver,
                         std::span<BodyIntegration> integrations, const Scales& scales);

    bool is_needed_;
    Scratch<Hit> hits_;
};

} // namespace hapnet::scene
