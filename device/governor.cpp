// SPDX-FileCopyrightText: 2026 The Hapnet authors
// SPDX-License-Identifier: MIT
#include "device/governor.hpp"

#include "device/governor/joint_torque.hpp"
#include "device/governor/workspace.hpp"
#include "proto/base/ensure.hpp"

#include <algorithm>

namespace hapnet::device {

namespace {

/// True if the force only becomes smaller, without changing its direction.
bool is_release(const base::Force& from, const base::Force& to)
{
    const glm::dvec3& a = from.value;
    const glm::dvec3& b = to.value;
    const double along = a.x * b.x + a.y * b.y + a.z * b.z;
    return along >= b.x * b.x + b.y * b.y + b.z * b.z;
}

} // namespace

Governor::Governor(const GovernorLimits& limits)
    : limits_{limits}, heat_{limits.force_continuous_n, limits.heat_time, limits.heat_start}
{
    base::ensure(validate(limits).has_value());
    if (limits.energy) energy_.emplace(*limits.energy, limits.tick);
}

GovernorState Governor::state() const
{
    if (latch_.is_closed()) return GovernorState::fault;
    if (finding_ == Finding::unheard) return GovernorState::off;
    if (finding_ == Finding::uncalibrated) return GovernorState::calibrating;
    if (strength_ == 0.0) return GovernorState::ready;
    return strength_ < 1.0 ? GovernorState::ramping : GovernorState::active;
}

GovernedForce Governor::govern(const ForceRequest& request, const Sample& sample,
                               base::TimePoint now)
{
    if (energy_) observe(sample, last_time_ ? now - *last_time_ : base::Duration{0});
    const base::Duration gap = pass(now);
    const bool usable = may_push(sample, gap);
    if (!usable) to_zero();
    if (gap != step_.gap) step_ = step_of(gap);
    fade(request.permitted && usable && limits_.axes_out > 0);
    last_ = shape(request.force, sample);
    const GovernedForce given = strength_ > 0.0 ? GovernedForce{last_} : GovernedForce{};
    held_ = given.force();
    return given;
}

void Governor::latch(const Latched& cause)
{
    // A stall of the loop without force has done no harm.
    if (cause.trip == Trip::loop && strength_ == 0.0) return;
    if (!latch_.close(cause)) return;
    to_zero();
    switch (cause.trip) {
    case Trip::none:
    case Trip::device: ++counters_.faults.device; break;
    case Trip::silence: ++counters_.faults.silence; break;
    case Trip::loop: ++counters_.faults.loop; break;
    case Trip::speed: ++counters_.faults.speed; break;
    case Trip::jump: ++counters_.faults.jump; break;
    case Trip::nonsense: ++counters_.faults.nonsense; break;
    case Trip::frozen: ++counters_.faults.frozen; break;
    case Trip::runaway: ++counters_.faults.runaway; break;
    }
}

void Governor::reset()
{
    if (!latch_.is_closed()) return;
    latch_.open();
    ++counters_.resets;
}

void Governor::to_zero()
{
    strength_ = 0.0;
    last_ = {};
    from_zero_ = true;
}

/// Returns the time since the last tick; after a stall it acts as if this were the first one.
base::Duration Governor::pass(base::TimePoint now)
{
    const base::Duration gap = last_time_ ? now - *last_time_ : base::Duration{0};
    last_time_ = now;
    heat_.pass(held_, gap);
    if (gap <= limits_.stall_max) return gap;
    ++counters_.stalled;
    if (gap > limits_.fault_after) latch({Fault::timeout, Trip::loop});
    to_zero();
    return base::Duration{0};
}

bool Governor::may_push(const Sample& sample, base::Duration gap)
{
    const SampleCheck::Result result = check_.look(limits_, sample, gap, {strength_ > 0.0, last_});
    finding_ = result.finding;
    count(finding_);
    if (finding_ == Finding::tripped) latch(result.fault);
    if (!latch_.is_closed()) return finding_ == Finding::usable;
    const bool is_well = finding_ == Finding::usable || finding_ == Finding::docked;
    if (!is_well) {
        latch_.on_bad_sample(sample);
    } else if (latch_.on_sample(sample, gap)) {
        ++counters_.resets;
    }
    return false; // a latch that has just opened permits force from the next tick on
}

void Governor::count(Finding finding)
{
    switch (finding) {
    case Finding::silent: ++counters_.silent; break;
    case Finding::docked: ++counters_.docked; break;
    case Finding::uncalibrated: ++counters_.uncalibrated; break;
    case Finding::too_fast: ++counters_.too_fast; break;
    case Finding::usable:
    case Finding::unheard:
    case Finding::tripped: break;
    }
}

Governor::Step Governor::step_of(base::Duration gap) const
{
    // A late tick fades for all the time that has passed, but ramps up for one tick only.
    const double seconds = base::to_seconds(std::min(gap, limits_.tick));
    return {.gap = gap,
            .ramp = seconds / base::to_seconds(limits_.ramp_in),
            .fade = base::to_seconds(gap) / base::to_seconds(limits_.fade_out),
            .slew_n = limits_.slew_max_n_per_s * seconds,
            .slew_ramping_n =
                std::min(limits_.slew_max_n_per_s, limits_.slew_ramping_n_per_s) * seconds};
}

void Governor::fade(bool permitted)
{
    strength_ = std::clamp(strength_ + (permitted ? step_.ramp : -step_.fade), 0.0, 1.0);
    if (strength_ < 1.0) ++counters_.faded;
    if (strength_ == 0.0) from_zero_ = true;
    if (strength_ == 1.0) from_zero_ = false;
}

base::Force Governor::shape(base::Force wanted, const Sample& sample)
{
    if (!base::is_finite(wanted)) {
        ++counters_.not_finite;
        return {};
    }
    if (limits_.axes_out < 3) {
        const base::Force all = wanted;
        for (int axis = std::max(0, limits_.axes_out); axis < 3; ++axis) wanted.value[axis] = 0.0;
        if (!(wanted == all)) ++counters_.flattened;
    }
    const bool inside = is_inside(limits_, sample.hip);
    if (!inside) {
        const base::Force all = wanted;
        wanted = with_outward_part_faded(limits_, sample.hip, wanted);
        if (!(wanted == all)) ++counters_.outside;
    }
    base::Force force = base::limited(wanted, limits_.force_max_n);
    if (!(force == wanted)) ++counters_.clamped;
    const double bearable_n = heat_.force_max_n(limits_.force_max_n);
    if (bearable_n < limits_.force_max_n && base::norm(force) > bearable_n) {
        ++counters_.heat_limited;
        force = base::limited(force, bearable_n);
    }
    force = slew(strength_ * force);
    if (strength_ == 0.0) return {}; // zero when in doubt, whatever the slew limit
    if (!inside) force = with_outward_part_cut(limits_, sample.hip, force);
    if (limits_.joints) {
        const double share = share_that_joints_bear(*limits_.joints, sample.hip, force);
        if (share < 1.0) ++counters_.joint_limited;
        force = share * force;
    }
    return energy_ ? within_energy(force, sample) : force;
}

base::Force Governor::within_energy(const base::Force& wanted, const Sample& sample)
{
    const base::Force force = energy_->allow(wanted, sample.velocity);
    if (!(force == wanted)) ++counters_.energy_limited;
    return force;
}

/// Accounts for the last force, which was held until now. Call it before anything else in a tick.
/// It does not matter whether a fault was latched in the meantime: a record does not show whether a
/// watchdog noticed a stall before the governor did.
void Governor::observe(const Sample& sample, base::Duration gap)
{
    const bool has_place = sample.calibrated && base::is_finite(sample.hip) &&
                           (sample.fault == Fault::none || sample.fault == Fault::timeout);
    if (has_place) {
        energy_->pass(held_, sample.hip, gap);
    } else {
        energy_->lose_place();
    }
}

base::Force Governor::slew(const base::Force& wanted)
{
    const bool gently = from_zero_ && !is_release(last_, wanted);
    const double step_max = gently ? step_.slew_ramping_n : step_.slew_n;
    const base::Force step = wanted - last_;
    if (base::norm(step) <= step_max) return wanted;
    ++counters_.slewed;
    return last_ + base::limited(step, step_max);
}

} // namespace hapnet::device
