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

/// A device that was found.
struct Found {
    Identity identity;
    std::optional<DeviceError> unusable{}; // why it cannot be used, and the remedy; nullopt: it can
};

/// A device's report on its stylus, in the device's own frame: right-handed, x right, y up, z
/// toward the user, metres.
struct Sample {
    base::Position hip;
    base::Velocity velocity; // already smoothed as the device's resolution demands
    bool gripping = false;   // the primary button is held down
    bool docked = false;     // the stylus rests in its holder, in no hand
    bool calibrated = true;  // false: positions are not valid
    Fault fault = Fault::none;
    std::uint8_t buttons = 0;  // one bit each, debounced; bit 0 is the primary one
    std::uint16_t presses = 0; // number of presses of the primary button
    /// Grows with every report from the device. An unchanged number marks an old sample.
    std::uint64_t sequence = 0;
};

/// True if a hand holds the stylus at the position of the sample. False for an uncalibrated device,
/// a stylus in its holder and a device with a fault, because their samples contain no information
/// about the hand.
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
    failed,       // the sample's fault is the reason
};
/// Returns the step as words for a status line, with what the person is to do; "" for done.
[[nodiscard]] std::string_view describe(CalibrationStep step);

/// The start of a session, for the holder of the device. A person reads it on the screen; a
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

/// A haptic device with up to three degrees of freedom in and out. This is the only interface to
/// all devices.
///
/// One thread calls all functions but halt(). The functions of a tick (calibrate, read, apply) wait
/// at most 2 ms for the device. If the device has no new report, read() returns the last sample
/// again, with its sequence number. If the device has gone, read() returns it with a fault. No
/// function throws, and none allocates.
class Device {
public:
    Device() = default;
    /// Leaves the motors off.
    virtual ~Device() = default;
    Device(const Device&) = delete;
    Device& operator=(const Device&) = delete;

    [[nodiscard]] virtual const Identity& identity() const = 0;
    [[nodiscard]] virtual const Capabilities& capabilities() const = 0;

    /// Continues the calibration. Calling it has no effect when the calibration is done.
    [[nodiscard]] virtual CalibrationStep calibrate(base::TimePoint /*now*/)
    {
        return CalibrationStep::done;
    }
    /// Returns the state of the stylus at `now`; `now` never runs backwards.
    [[nodiscard]] virtual Sample read(base::TimePoint now) = 0;
    /// Sets the force that the device holds until the next call. Only a Governor can make such a
    /// force.
    virtual void apply(const GovernedForce& force) = 0;
    /// Sets zero force and switches the motors off at once, from any thread and in any state, for
    /// watchdogs and exits. The next apply() ends this state.
    virtual void halt() noexcept = 0;

    /// Notes that the session's start became known, or changed.
    virtual void on_cue(const Cue& /*cue*/) {}

    /// Notes that a fault was latched, or has ended. A person reads this on the screen, with the
    /// instructions; a simulated hand follows the instructions.
    virtual void on_fault(bool /*is_latched*/) {}

    /// Runs the loop at the pace of the device. Call it only when capabilities().pacing is
    /// Pacing::device. It calls `beat` once for each cycle of the device, on the calling thread;
    /// call read() and apply() inside `beat`. Returns when `beat` returns false, or when no cycle
    /// came for 100 ms; then the host may continue at its own pace. It does not catch exceptions of
    /// `beat`.
    virtual void pace(const std::function<bool()>& /*beat*/) {}
};

/// Returns a description for logs and records, such as "falcon 12345: Novint Falcon".
[[nodiscard]] std::string description(const Device& device);

} // namespace hapnet::device
