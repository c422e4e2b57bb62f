// SPDX-FileCopyrightText: 2026 The Hapnet authors
// SPDX-License-Identifier: MIT
#include "device/governor/sample_check.hpp"

#include <algorithm>
#include <limits>

namespace hapnet::device {

namespace {

// The greatest difference between the time of a sample and the time at which it was read. A step
// that is possible within this additional time at the highest speed is no jump.
constexpr base::Duration jump_grace{std::chrono::milliseconds{4}};

double squared(const glm::dvec3& v) { return v.x * v.x + v.y * v.y + v.z * v.z; }

} // namespace

SampleCheck::Result SampleCheck::look(const GovernorLimits& limits, const Sample& sample,
                                      base::Duration passed, const Push& push)
{
    const bool says_silent = sample.fault == Fault::timeout; // the backend receives nothing
    if (sample.fault != Fault::none && !says_silent) {
        placed_ = false;
        return {Finding::tripped, {sample.fault, Trip::device}};
    }
    if (!heard_ && sample.sequence == 0 && !says_silent) return {Finding::unheard};
    const bool is_new = !says_silent && (!heard_ || sample.sequence != sequence_);
    heard_ = true;
    sequence_ = sample.sequence;
    silence_ += passed;
    const base::Duration since_last = silence_;
    // A device without motors may be silent: a cap or a grip at rest sends no reports.
    if (is_new || (limits.axes_out <= 0 && !says_silent)) silence_ = base::Duration{0};

    if (silence_ >= limits.fault_after) {
        return {Finding::tripped, {Fault::timeout, Trip::silence}};
    }
    if (says_silent || silence_ >= limits.stall_max) return {Finding::silent};
    if (!sample.calibrated) {
        placed_ = false;
        return {Finding::uncalibrated};
    }
    if (!base::is_finite(sample.hip) || !base::is_finite(sample.velocity)) {
        placed_ = false;
        return {Finding::tripped, {Fault::communication, Trip::nonsense}};
    }
    const Trip trip = too_fast(limits, sample, since_last);
    const Trip unfit = limits.checks_motion ? misfit(sample, passed, push, is_new) : Trip::none;
    if (is_new) {
        place_ = sample.hip;
        placed_ = true;
    }
    if (trip != Trip::none) {
        if (push.may_be_felt) return {Finding::tripped, {Fault::over_velocity, trip}};
        return {Finding::too_fast};
    }
    if (unfit == Trip::frozen) return {Finding::tripped, {Fault::communication, unfit}};
    if (unfit == Trip::runaway) return {Finding::tripped, {Fault::over_velocity, unfit}};
    return {sample.docked ? Finding::docked : Finding::usable};
}

/// Compares motion and force. Returns the reason why they are inconsistent; Trip::none: they are
/// consistent.
Trip SampleCheck::misfit(const Sample& sample, base::Duration passed, const Push& push, bool is_new)
{
    constexpr base::Duration piece{std::chrono::milliseconds{25}};
    const double force_n = base::norm(push.force);
    const bool stays = placed_ && sample.hip == place_ && force_n >= frozen_force_n;
    if (!stays) {
        frozen_ = base::Duration{0};
    } else if (is_new) { // an old sample has no information about the encoders
        frozen_ += passed;
    }
    if (frozen_ >= frozen_after) return Trip::frozen;

    if (force_n < runaway_force_n) {
        slowest_.reset();
        return Trip::none;
    }
    const glm::dvec3& f = push.force.value;
    const glm::dvec3& v = sample.velocity.value;
    const double against = -(f.x * v.x + f.y * v.y + f.z * v.z) / force_n;
    if (!slowest_) slowest_ = Slowest{against, against, {}};
    slowest_->now = std::min(slowest_->now, against);
    const double slowest = std::min(slowest_->now, slowest_->before);
    slowest_->into_piece += passed;
    if (slowest_->into_piece >= piece) slowest_ = Slowest{against, slowest_->now, {}};
    // A motion that only slows down through rest has not sped up.
    return against - std::max(0.0, slowest) >= runaway_m_per_s ? Trip::runaway : Trip::none;
}

Trip SampleCheck::too_fast(const GovernorLimits& limits, const Sample& sample,
                           base::Duration since_last) const
{
    const double most = limits.speed_max_m_per_s;
    if (most == std::numeric_limits<double>::infinity()) return Trip::none;
    if (squared(sample.velocity.value) > most * most) return Trip::speed;
    if (!placed_) return Trip::none;
    const double step_max = most * base::to_seconds(since_last + jump_grace);
    const bool jumped = squared((sample.hip - place_).value) > step_max * step_max;
    return jumped ? Trip::jump : Trip::none;
}

} // namespace hapnet::device
