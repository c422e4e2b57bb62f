// SPDX-FileCopyrightText: 2026 The Hapnet authors
// SPDX-License-Identifier: MIT
#pragma once

#include "device/fault.hpp"

#include <cstdint>
#include <string_view>

namespace hapnet::device {

/// The rule that latched a fault.
enum class Trip : std::uint8_t {
    none,
    device,   // the device reported the fault itself
    silence,  // no new report came from the device for too long
    loop,     // this program's loop stood still for too long
    speed,    // the device moved faster than a hand can move it
    jump,     // the position changed too far at once
    nonsense, // a position or a velocity that is not a number
    frozen,   // the position does not change at all under force
    runaway,  // the device speeds up against the force: a sign is wrong
};

/// The names of rules in statistics.
constexpr auto names_of(base::Tag<Trip> /*enum*/)
{
    return base::names("none", "device", "silence", "loop", "speed", "jump", "nonsense", "frozen",
                       "runaway");
}

/// A fault that stays until an operator has acted.
struct Latched {
    Fault fault = Fault::none;
    Trip trip = Trip::none;

    friend bool operator==(const Latched&, const Latched&) = default;
};

/// Returns the fault as words, with what to do about it; "" for no fault.
[[nodiscard]] std::string_view what_happened(const Latched& latched);

} // namespace hapnet::device
