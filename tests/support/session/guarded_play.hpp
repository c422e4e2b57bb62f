// SPDX-FileCopyrightText: 2026 The Hapnet authors
// SPDX-License-Identifier: MIT
#pragma once

#include "device/governor/energy.hpp"
#include "lab/virtual_time/world.hpp"
#include "tests/support/session/work_of_5s.hpp"

#include <cstddef>
#include <cstdint>

namespace hapnet::test {

/// The energy that a player's hand gets, measured without the governor's own figures.
class HandEnergy {
public:
    explicit HandEnergy(const lab::virtual_time::VirtualPlayer& player);

    /// Call after each tick, which ended `now`.
    void add(const lab::virtual_time::VirtualPlayer& player, base::TimePoint now);

    /// The largest net work into the hand within 5 s, J.
    [[nodiscard]] double work_5s_j() const { return work_.most_j(); }
    /// The largest mean power of 5 ms, W.
    [[nodiscard]] double power_w() const;

private:
    base::Position hip_;
    base::Force held_;
    WorkOf5s work_;
    device::EnergyGuard observer_;
};

/// The result of a session whose energy is limited, or not.
struct GuardedPlay {
    std::uint64_t hash = 0;        // over the bits of all forces and bodies in every tick
    std::uint64_t limited = 0;     // how often a governor limited the energy
    std::size_t guarded_hands = 0; // hands whose governor has a limit of energy
    double work_5s_j = 0.0;        // of the hand that got the most
    double power_w = 0.0;          // of the hand that got the most
};

/// Plays a session from its start to its end.
[[nodiscard]] GuardedPlay play_guarded(const lab::virtual_time::Setting& setting);

} // namespace hapnet::test
