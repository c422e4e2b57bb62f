// SPDX-FileCopyrightText: 2026 The Hapnet authors
// SPDX-License-Identifier: MIT
#include "device/rig.hpp"

#include "proto/base/ensure.hpp"

#include <algorithm>
#include <utility>

namespace hapnet::device {

Rig::Rig(std::unique_ptr<Device> device, const GovernorLimits& limits, const Mount& mount)
    : device_{std::move(device)},
      governor_{limits_for(device_->capabilities(), limits)},
      mount_{mount}
{
    base::ensure(mount.scale > 0.0);
}

const Sample& Rig::read(base::TimePoint now)
{
    if (!own_.calibrated) calibration_ = device_->calibrate(now);
    const std::uint64_t before = own_.sequence;
    own_ = device_->read(now);
    count(before);
    if (own_.calibrated) calibration_ = CalibrationStep::done;
    scene_ = own_;
    scene_.hip = mount_.to_scene(own_.hip);
    scene_.velocity = mount_.to_scene(own_.velocity);
    return scene_;
}

void Rig::count(std::uint64_t sequence_before)
{
    ++counters_.reads;
    if (own_.sequence != sequence_before) {
        repeated_ = 0;
        return;
    }
    ++counters_.repeated;
    counters_.repeated_most = std::max(counters_.repeated_most, ++repeated_);
}

GovernedForce Rig::govern(const base::Force& wanted, bool permitted, base::TimePoint now)
{
    const GovernedForce force = governor_.govern({mount_.to_device(wanted), permitted}, own_, now);
    const bool is_at_fault = governor_.fault().fault != Fault::none;
    if (is_at_fault != is_at_fault_) {
        is_at_fault_ = is_at_fault;
        device_->on_fault(is_at_fault);
    }
    return force;
}

base::Force Rig::apply(const base::Force& wanted, bool permitted, base::TimePoint now)
{
    const GovernedForce force = govern(wanted, permitted, now);
    device_->apply(force);
    return force.force();
}

base::Force Rig::withhold(const base::Force& wanted, bool permitted, base::TimePoint now)
{
    const GovernedForce force = govern(wanted, permitted, now);
    device_->apply({});
    return force.force();
}

} // namespace hapnet::device
