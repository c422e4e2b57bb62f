// SPDX-FileCopyrightText: 2026 The Hapnet authors
// SPDX-License-Identifier: MIT
#include "device/omni/tracker.hpp"

#include <algorithm>
#include <cstdlib>
#include <utility>

namespace hapnet::device::omni {

namespace {

// The greatest jitter of a stylus at rest.
constexpr int resting_counts = 3;
// The number of lost reports after which a hand may be anywhere.
constexpr std::uint32_t skipped_max = 100;
// The tolerance of the ranges of the joints and of the inkwell's pose, which are not known more
// precisely.
constexpr double slack_radians = 0.15;

int farthest(const Counts& a, const Counts& b)
{
    return std::max({std::abs(a.x - b.x), std::abs(a.y - b.y), std::abs(a.z - b.z)});
}

} // namespace

void Tracker::on_report(const Report& report, base::TimePoint now)
{
    heard_at_ = now;
    heard_nonsense_ = false;
    if (is_jump(report)) lose();
    counts_ = report.counts;
    follow_dock(report, now);
    buttons_.update(report.buttons, now);
    buttons_.tell(sample_);
    sample_.docked = report.docked;
    ++sample_.sequence;
    if (!zero_) return;
    const Joints joints = joints_at(report.counts, *zero_);
    if (!is_reachable(joints, slack_radians)) return lose();
    sample_.hip = position_of(joints);
    has_moved_ = true;
}

void Tracker::lose()
{
    lost_ = true;
    zero_.reset();
    resting_since_.reset();
}

bool Tracker::is_jump(const Report& report) const
{
    if (!counts_ || report.skipped > skipped_max) return false;
    return farthest(report.counts, *counts_) >
           jump_max_counts * (1 + static_cast<int>(report.skipped));
}

void Tracker::follow_dock(const Report& report, base::TimePoint now)
{
    if (!report.docked) return resting_since_.reset();
    if (!resting_since_ || farthest(report.counts, resting_at_) > resting_counts) {
        resting_since_ = now;
        resting_at_ = report.counts;
    }
    if (now - *resting_since_ < rest) return;
    lost_ = false;
    if (zero_ && farthest(report.counts, counts_at(in_inkwell_, *zero_)) <= resting_counts) return;
    zero_ = zero_from(report.counts, in_inkwell_);
    velocity_ = VelocityFilter{30.0}; // the new zero changes the position without a motion
}

const Sample& Tracker::at(base::TimePoint now)
{
    if (!heard_at_) heard_at_ = now;
    // If several reports arrive together, only the last one counts, because the time between them
    // is not known.
    if (std::exchange(has_moved_, false)) sample_.velocity = velocity_.at(sample_.hip, now);
    sample_.calibrated = zero_.has_value();
    sample_.fault = fault_at(now);
    if (!zero_ || sample_.fault != Fault::none) sample_.velocity = {};
    return sample_;
}

Fault Tracker::fault_at(base::TimePoint now) const
{
    if (gone_) return Fault::disconnected;
    if (now - *heard_at_ >= silence_max) {
        return heard_nonsense_ ? Fault::communication : Fault::timeout;
    }
    return lost_ ? Fault::not_calibrated : Fault::none;
}

CalibrationStep Tracker::calibration() const
{
    if (gone_) return CalibrationStep::failed;
    if (zero_) return CalibrationStep::done;
    return resting_since_ ? CalibrationStep::busy : CalibrationStep::dock_stylus;
}

bool Tracker::may_push() const { return zero_ && !sample_.docked && sample_.fault == Fault::none; }

} // namespace hapnet::device::omni
