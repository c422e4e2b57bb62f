// SPDX-FileCopyrightText: 2026 The Hapnet authors
// SPDX-License-Identifier: MIT
#pragma once

#include "scene/bounded.hpp"
#include "scene/rigid/integrate.hpp"
#include "scene/solver/contact_solver.hpp"
#include "scene/state.hpp"

#include <cstdint>
#include <limits>
#include <span>

namespace hapnet::scene {

/// Bounces of a tick. Each happens at its moment, the earliest first, and takes into account the
/// changes by the earlier ones: a body that a bounce throws against others bounces off them in the
/// same tick. No bounce gains energy.
class Restitution {
public:
    /// `blocks` is the greatest number of contacts.
    Restitution(const WorldConfig& config, const Bodies& bodies, std::size_t blocks,
                const Scales& scales);

    [[nodiscard]] bool is_needed() const { return is_needed_; }

    /// Changes the tentative velocities and their means. Returns true if anything bounced. If
    /// `picked` is not empty, only contacts of bodies bounce whose entry, by solver index, is not
    /// 0.
    bool apply(ContactSolver& solver, std::span<BodyIntegration> integrations,
               Interventions& interventions, std::span<const std::uint8_t> picked = {});

    /// Lowers the least speeds of the points that touch only after the end of the tick, so that the
    /// solver leaves their bounce to the next tick.
    void leave_coming(ContactBlock& block, std::span<const BodyIntegration> integrations) const;

private:
    static constexpr std::uint32_t none = ~std::uint32_t{0};
    static constexpr double never = std::numeric_limits<double>::infinity();
    /// The greatest number of bounces of one contact in a tick. Further ones are left to the
    /// solver.
    static constexpr std::uint32_t bounces_max = 4;

    struct Bouncing {
        std::uint32_t block = 0;
        std::uint32_t bounces = 0;
        double time = never; // s, from the start of the tick: when the first point touches
    };

    void begin(ContactSolver& solver, std::span<const BodyIntegration> integrations,
               std::span<const std::uint8_t> picked);
    void look(Bouncing& contact, const ContactBlock& block,
              std::span<const BodyIntegration> integrations) const;
    /// Makes a contact bounce. Returns the share of its impulse that gains no energy.
    static double bounce(ContactBlock& block, ContactSolver& solver,
                         std::span<BodyIntegration> integrations, const Scales& scales);

    Scales scales_;
    bool is_needed_;
    Scratch<Bouncing> bouncing_;
    // The contacts of each body: link 2 i belongs to the first body of contact i.
    Scratch<std::uint32_t> next_;
    Scratch<std::uint32_t> heads_; // by solver index
};

} // namespace hapnet::scene
