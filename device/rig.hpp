// SPDX-FileCopyrightText: 2026 The Hapnet authors
// SPDX-License-Identifier: MIT
#pragma once

#include "device/device.hpp"
#include "device/governor.hpp"
#include "device/mount.hpp"

#include <memory>

namespace hapnet::device {

/// Counters of a device's reports.
struct RigCounters {
    std::uint64_t reads = 0;
    std::uint64_t repeated = 0;
    std::uint64_t repeated_most = 0;
};
constexpr auto fields_of(base::Tag<RigCounters>)
{
    using C = RigCounters;
    return base::fields(
        "device counters", base::member("reads", &C::reads, "Reads of the device."),
        base::member("repeated", &C::repeated, "Those without a new sample."),
        base::member("repeated_most", &C::repeated_most, "The longest row of these."));
}

/// A device mounted in the scene, with the governor before its motors. Loops use devices only
/// through this class. Inputs and outputs are in the scene's frame.
class Rig {
public:
    /// The limits of the device itself apply, too; see limits_for().
    Rig(std::unique_ptr<Device> device, const GovernorLimits& limits, const Mount& mount = {});

    /// Calibrates as far as necessary, and reads.
    [[nodiscard]] const Sample& read(base::TimePoint now);
    /// Governs the wanted force, applies the result, and returns the result at the hand. Call it
    /// once per read().
    base::Force apply(const base::Force& wanted, bool permitted, base::TimePoint now);
    /// Governs the force like apply(), but gives the device zero force: it was halted after read(),
    /// so a force for that position may be outdated. The governor notices the halt in the next
    /// tick.
    base::Force withhold(const base::Force& wanted, bool permitted, base::TimePoint now);

    /// Passes the start of a session on to the holder of the device.
    void on_cue(const Cue& cue) { device_->on_cue(cue); }

    [[nodiscard]] GovernorState governor_state() const { return governor_.state(); }
    [[nodiscard]] const Governor& governor() const { return governor_; }
    [[nodiscard]] Governor& governor() { return governor_; }
    [[nodiscard]] const RigCounters& counters() const { return counters_; }
    [[nodiscard]] Device& device() { return *device_; }
    [[nodiscard]] const Device& device() const { return *device_; }
    [[nodiscard]] const Mount& mount() const { return mount_; }
    /// Returns the calibration step as of the last read().
    [[nodiscard]] CalibrationStep calibration() const { return calibration_; }

private:
    void count(std::uint64_t sequence_before);
    [[nodiscard]] GovernedForce govern(const base::Force& wanted, bool permitted,
                                       base::TimePoint now);

    std::unique_ptr<Device> device_;
    Governor governor_;
    Mount mount_;
    CalibrationStep calibration_ = CalibrationStep::done;
    RigCounters counters_;
    std::uint64_t repeated_ = 0; // consecutive latest reads without a new sample
    bool is_at_fault_ = false;   // fault state last reported to the device
    Sample own_;                 // last sample, in the device's frame
    Sample scene_;               // last sample, in the scene's frame
};

} // namespace hapnet::device
