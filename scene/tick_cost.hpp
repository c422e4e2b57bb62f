// SPDX-FileCopyrightText: 2026 The Hapnet authors
// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>

namespace hapnet::scene {

/// The work of a tick, in units of bounded cost. freeze() derives how many of each a tick of the
/// scene may take, and a tick counts how many it took. The work that is not counted is a few loops
/// over the awake bodies and the hands.
struct TickCost {
    std::uint64_t pairs = 0;    // pairs of bodies, or of a body and a plane, looked at closely
    std::uint64_t contacts = 0; // contacts prepared for the solver
    std::uint64_t visits = 0;   // visits of the solver to contacts, for velocities and overlaps
    /// Rows of hands' springs that the midpoint rule solved, counted in each Newton step.
    std::uint64_t spring_rows = 0;
    std::uint64_t events = 0; // events of OneBoxStepper within the tick
    std::uint64_t looks = 0;  // looks at two bodies, one of which goes far within the tick

    /// True if no count is above that of `bound`.
    [[nodiscard]] bool is_within(const TickCost& bound) const
    {
        return pairs <= bound.pairs && contacts <= bound.contacts && visits <= bound.visits &&
               spring_rows <= bound.spring_rows && events <= bound.events && looks <= bound.looks;
    }
    friend bool operator==(const TickCost&, const TickCost&) = default;
};

} // namespace hapnet::scene
