// SPDX-FileCopyrightText: 2026 The Hapnet authors
// SPDX-License-Identifier: MIT
#pragma once

#include "device/capabilities.hpp"
#include "device/fault.hpp"
#include "device/governed_force.hpp"
#include "proto/base/random.hpp"
#include "proto/base/space.hpp"
#include "proto/base/time.hpp"

#include <cstdint>
#include <functional>
#include <optional>
#include <string>

namespace hapnet::device {

/// A device that was seen.
struct Found {
    Identity identity;
    std::optional<DeviceError> unusable{}; // why it cannot be used, and the cure; nullopt: it can
};

/// A device's report on its stylus, in the device's own frame: right-handed, x right, y up, z
/// toward the user, metres.
struct Sample {
    base::Position hip;
    base::Velocity velocity; // already smoothed as the device's resolution demands
    bool gripping = false;   // the primary button is held down
    bool docked = false;     // the stylus rests in its holder, in no hand
    bool calibrated = true;  // false: positions are meaningless
    Fault fault = Fault::none;
    std::uint8_t buttons = 0;  // one bit each, debounced; bit 0 is the primary one
    std::uint16_t presses = 0; // number of presses of the primary button
    /// Grows with every report from the device; an unchanged number marks an old sample.
    std::uint64_t sequence = 0;
};

/// True if a hand holds the stylus at the sample's place. False for an uncalibrated device, a
/// stylus in its holder and a device with a fault, because these tell nothing about the hand.
[[nodiscard]] constexpr bool is_in_hand(const Sample& sample)
{
    return sample.calibrated && !sample.docked && sample.fault == Fault::none;
}

/// The next step of a calibration.
enum class CalibrationStep : std::uint8_t {
    done,
    busy,         // the device calibrates itself: ask again
    dock_stylus,  // the person is to put the stylus into its holder
    sweep_joints, // the person is to move the grip through its whole reach, to every stop
    failed,       // the sample's fault says why
};
/// The step in words for a status line, with what the person is to do. "" for done.
[[nodiscard]] std::string_view describe(CalibrationStep step);

/// The start of a session, for the holder of the device. A person reads it off the screen; a
/// simulated hand plays its task by it.
struct Cue {
    base::TimePoint start;   // start of the session
    base::Duration hands_on; // time from the start until the hands let go
    base::Seed seed;         // seed of the session
    std::uint16_t peer_id = 0;
    bool is_left = true;
    double share = 1.0;   // this hand's share of the force of all hands on its side
    bool is_first = true; // the first of the hands on its side
};

/// A haptic device: up to three degrees of freedom in and out. The one interface to all of them.
///
/// One thread calls all but halt(). No call of a tick (calibrate, read, apply) waits longer than
/// 2 ms for the device: where it has nothing new to say, read() gives the last sample again, with
/// its sequence; where it has gone, with its fault. None throws and none allocates.
class Device {
public:
    Device() = default;
    /// Leaves the motors off.
    virtual ~Device() = default;
    Device(const Device&) = delete;
    Device& operator=(const Device&) = delete;

    [[nodiscard]] virtual const Identity& identity() const = 0;
    [[nodiscard]] virtual const Capabilities& capabilities() const = 0;

    /// Goes on with the calibration; harmless when it is done.
    [[nodiscard]] virtual CalibrationStep calibrate(base::TimePoint /*now*/)
    {
        return CalibrationStep::done;
    }
    /// The stylus at `now`; `now` never runs backwards.
    [[nodiscard]] virtual Sample read(base::TimePoint now) = 0;
    /// Holds this force until the next call; only a Governor can make one.
    virtual void apply(const GovernedForce& force) = 0;
    /// Sets zero force and switches the motors off at once, from any thread and in any state: for
    /// watchdogs and exits. The next apply() ends it.
    virtual void halt() noexcept = 0;

    /// The session's start became known, or changed.
    virtual void on_cue(const Cue& /*cue*/) {}

    /// A fault was latched, or has ended. A person reads it off the screen, with what to do then; a
    /// simulated hand does it.
    virtual void on_fault(bool /*is_latched*/) {}

    /// Call it only when capabilities().pacing is Pacing::device. It calls `beat` once for each
    /// cycle of the device, on the calling thread; call read() and apply() inside `beat`. Returns
    /// when `beat` says false, or when no cycle came for 100 ms; then the host may go on at its own
    /// pace. Lets through what `beat` throws.
    virtual void pace(const std::function<bool()>& /*beat*/) {}
};

/// Returns a description for logs and records, such as "falcon 12345: Novint Falcon".
[[nodiscard]] std::string description(const Device& device);

} // namespace hapnet::device
