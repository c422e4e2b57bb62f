// SPDX-FileCopyrightText: 2026 The Hapnet authors
// SPDX-License-Identifier: MIT
#include "peer/core/sync/estimator_predictor.hpp"

#include <algorithm>

namespace hapnet::peer {

namespace {

constexpr std::uint32_t delay_memory = 500; // messages in the mean; SEP uses only the median

double dot_of(const glm::dvec3& a, const glm::dvec3& b)
{
    return a.x * b.x + a.y * b.y + a.z * b.z;
}

} // namespace

EstimatorPredictor::EstimatorPredictor(const EstimatorPredictorOptions& options)
    : options_{options},
      base_{options.base},
      delay_{delay_memory},
      force_{base::to_seconds(options.time_constant)},
      hip_{base::to_seconds(options.time_constant)}
{}

void EstimatorPredictor::hear(const ReceivedState& received)
{
    base_.hear(received);
    if (const auto age = one_way_delay(received)) delay_.add(*age);
    if (!received.taken) return;
    const wire::State& state = received.state;
    const bool starts = !has_heard_ || state.sent - hip_.at() > options_.gap_max;
    sample_ = base::limited(state.contact_force, received.force_max_n);
    // A force begins and ends with a step, whose slope must not be extrapolated.
    if (starts || state.touching != touching_) {
        force_.restart(sample_.value, state.sent);
        force_shown_.reset();
    } else {
        force_.add(sample_.value, state.sent);
    }
    if (starts) {
        hip_.restart(state.hip.value, state.sent);
        hip_shown_.reset();
    } else {
        hip_.add(state.hip.value, state.sent);
    }
    touching_ = state.touching;
    arrived_ = received.arrived;
    has_heard_ = true;
}

void EstimatorPredictor::forget()
{
    base_.forget();
    delay_.reset();
    has_heard_ = false;
    touching_ = false;
    sample_ = {};
    force_shown_.reset();
    hip_shown_.reset();
}

Outcome EstimatorPredictor::tick(scene::World& world, const Situation& situation)
{
    CombinedRemote remote = combined_remote(situation, options_.base);
    const Ahead by = ahead(situation);
    if (remote.touching && has_heard_) {
        remote.force = situation.remote.freshness() * force(situation, by.force_s);
    } else {
        force_shown_.reset();
    }
    Outcome outcome = base_.tick(world, situation, remote);
    if (has_heard_) outcome.remote_hip = hip(situation, by.hip_s);
    return outcome;
}

EstimatorPredictor::Ahead EstimatorPredictor::ahead(const Situation& situation) const
{
    if (!has_heard_) return {};
    // The age of the last sample. It counts from the arrival if the remote's clock is unknown.
    const auto clock = situation.clock.estimate();
    const base::Duration age =
        clock ? (situation.now - hip_.at()) + clock->offset : situation.now - arrived_;
    const base::Duration usual = delay_.median();
    const base::Duration late = age - (usual + options_.fade_after);
    double share = 1.0;
    if (late > base::Duration{0}) {
        share = late < options_.fade_within
                    ? 1.0 - base::to_seconds(late) / base::to_seconds(options_.fade_within)
                    : 0.0;
    }
    const auto by = [&](base::Duration most) {
        return share * base::to_seconds(std::clamp(age, base::Duration{0}, most));
    };
    return {.force_s = by(options_.force_ahead_max),
            .hip_s = by(usual + options_.hip_ahead_beyond_delay)};
}

base::Force EstimatorPredictor::force(const Situation& situation, double ahead_s)
{
    const base::Force wanted{force_.value() + ahead_s * force_.slope()};
    base::Force given = wanted;
    if (force_shown_) {
        const double step = options_.force_slew_n_per_s * base::to_seconds(situation.tick);
        given = *force_shown_ + base::limited(wanted - *force_shown_, step);
    }
    // The force is never opposite to the last sample, nor greater than that of a contact.
    const double length = base::norm(sample_);
    if (!(length > 0.0)) return {};
    const glm::dvec3 direction = sample_.value / length;
    const double along_it = std::clamp(dot_of(given.value, direction), 0.0, situation.force_max_n);
    force_shown_ = along(base::Force{along_it * direction}, options_.base.axes);
    return *force_shown_;
}

base::Position EstimatorPredictor::hip(const Situation& situation, double ahead_s)
{
    const base::Position wanted{hip_.value() + ahead_s * hip_.slope()};
    base::Position given = wanted;
    if (hip_shown_) {
        const double step = options_.hip_slew_m_per_s * base::to_seconds(situation.tick);
        given = *hip_shown_ + base::limited(wanted - *hip_shown_, step);
    }
    hip_shown_ = given;
    return given;
}

} // namespace hapnet::peer
