// SPDX-FileCopyrightText: 2026 The Hapnet authors
// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>

namespace hapnet::scene {

/// The work of a tick, in units of bounded cost. freeze() derives how many of each a tick of the
/// scene may take; a tick counts how many it took. The rest of a tick is a few loops over the awake
/// bodies and the hands.
struct TickCost {
    std::uint64_t pairs = 0;    // of two bodies, or of a body and a plane: looked at closely
    std::uint64_t contacts = 0; // prepared for the solver
    std::uint64_t visits = 0;   // of the solver to one contact: velocities and overlaps
    std::uint64_t spring_rows =
        0;                    // rows of hands' springs on bodies that turn, solved step by step
    std::uint64_t events = 0; // of the one box within the tick
    std::uint64_t looks = 0;  // at two bodies one of which goes far within the tick

    /// True if no count is above that of `bound`.
    [[nodiscard]] bool is_within(const TickCost& bound) const
    {
        return pairs <= bound.pairs && contacts <= bound.contacts && visits <= bound.visits &&
               spring_rows <= bound.spring_rows && events <= bound.events && looks <= bound.looks;
    }
    friend bool operator==(const TickCost&, const TickCost&) = default;
};

} // namespace hapnet::scene
