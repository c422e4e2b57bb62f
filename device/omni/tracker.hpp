// SPDX-FileCopyrightText: 2026 The Hapnet authors
// SPDX-License-Identifier: MIT
#pragma once

#include "device/buttons.hpp"
#include "device/device.hpp"
#include "device/omni/encoders.hpp"
#include "device/velocity_filter.hpp"

#include <chrono>
#include <cstdint>
#include <optional>

namespace hapnet::device::omni {

/// One report from an Omni.
struct Report {
    Counts counts{0};
    bool docked = false;
    std::uint8_t buttons = 0;  // one bit each, 1: down
    std::uint32_t skipped = 0; // number of reports lost before this one
};

/// Tracks the stylus and the faults of an Omni by its reports. Positions are not valid until the
/// stylus has rested in its inkwell for 50 ms. They become invalid again after a break, or after
/// the encoders have jumped farther than a hand moves or to angles that the mechanism cannot reach,
/// until the stylus rests in the inkwell again.
class Tracker {
public:
    explicit Tracker(const Joints& in_inkwell = inkwell_pose) : in_inkwell_{in_inkwell} {}

    // Each takes an event. `now` never runs backwards.
    void on_report(const Report& report, base::TimePoint now);
    /// Notes that an invalid report arrived.
    void on_nonsense() { heard_nonsense_ = true; }
    /// Notes an event after which the encoders may have restarted and the arm may have moved.
    /// Continuous counts prove nothing then, so the calibration is lost.
    void on_break() { lose(); }
    /// Notes that the device has been disconnected and does not return.
    void on_gone() { gone_ = true; }

    /// Returns the state at `now`, with the last position if there is no newer one.
    [[nodiscard]] const Sample& at(base::TimePoint now);
    [[nodiscard]] CalibrationStep calibration() const;
    /// True if forces are permitted: the device is calibrated, out of its inkwell and without
    /// fault.
    [[nodiscard]] bool may_push() const;

    /// The greatest movement by a hand in one report: 5 m/s at 1000 reports per second.
    static constexpr int jump_max_counts = 120;
    /// The time for which the stylus must rest in the inkwell before that counts.
    static constexpr base::Duration rest{std::chrono::milliseconds{50}};
    /// The longest silence of the device that is no fault.
    static constexpr base::Duration silence_max{std::chrono::milliseconds{20}};

private:
    void lose();
    void follow_dock(const Report& report, base::TimePoint now);
    [[nodiscard]] bool is_jump(const Report& report) const;
    [[nodiscard]] Fault fault_at(base::TimePoint now) const;

    Joints in_inkwell_;
    std::optional<Joints> zero_; // nullopt: not calibrated
    std::optional<Counts> counts_;
    std::optional<base::TimePoint> heard_at_;
    std::optional<base::TimePoint> resting_since_;
    Counts resting_at_{0};
    bool lost_ = false; // the calibration was lost
    bool gone_ = false;
    bool heard_nonsense_ = false; // nonsense came since the last report
    bool has_moved_ = false;      // a position came since the last at()
    Buttons buttons_;
    VelocityFilter velocity_{30.0}; // cutoff, Hz: one count per millisecond is 55 mm/s
    Sample sample_{.hip = {}, .velocity = {}, .calibrated = false};
};

} // namespace hapnet::device::omni
