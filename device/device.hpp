// SPDX-FileCopyrightText: 2026 The Hapnet authors
// SPDX-License-Identifier: MIT
#pragma once

#include "proto/base/random.hpp"
#include "proto/base/space.hpp"
#include "proto/base/time.hpp"

#include <cstdint>
#include <string>

namespace hapnet::device {

/// What a device says of its stylus. Positions are in the scene's frame: placing the workspace
/// in the scene is the device's affair.
struct Sample {
    base::Position hip;
    base::Velocity velocity; // already smoothed as the device's resolution demands
    bool gripping = false;   // the primary button is held down
};

/// What the session tells whoever holds the device. A person reads it off the screen; a
/// simulated hand acts its task by it.
struct Cue {
    base::TimePoint start;   // of the session
    base::Duration hands_on; // from the start; then the hands let go
    base::Seed seed;         // of the session
    std::uint16_t peer_id = 0;
    bool is_left = true;
};

/// A haptic device: three degrees of freedom in and out. The one interface to all of them.
/// Forces that reach apply() have passed the governor.
class Device {
public:
    Device() = default;
    virtual ~Device() = default;
    Device(const Device&) = delete;
    Device& operator=(const Device&) = delete;

    /// The stylus at `now`; `now` never runs backwards.
    [[nodiscard]] virtual Sample read(base::TimePoint now) = 0;
    /// Holds this force until the next call.
    virtual void apply(base::Force force) = 0;
    /// The session's start became known, or changed.
    virtual void on_cue(const Cue& cue) = 0;
    /// For logs and records, such as "simulated Omni, simulated hand".
    [[nodiscard]] virtual std::string description() const = 0;
};

} // namespace hapnet::device
