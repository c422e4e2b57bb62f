// SPDX-FileCopyrightText: 2026 The Hapnet authors
// SPDX-License-Identifier: MIT
#include "device/replay/replay.hpp"

#include "proto/base/ensure.hpp"

#include <cmath>
#include <spdlog/fmt/fmt.h>
#include <utility>

namespace hapnet::device {

namespace {

constexpr double peak_n = 3.3; // the Omni's

} // namespace

Replay::Replay(HandTrace trace, std::string source, AfterTheEnd after)
    : trace_{std::move(trace)}, after_{after}
{
    base::ensure(!trace_.empty());
    identity_ = {.backend = "replay",
                 .serial = std::move(source),
                 .model = fmt::format("a recorded hand, {} moments", trace_.size())};
    const glm::dvec3 reach{hand_reach_max_m};
    capabilities_.workspace_min = {-reach};
    capabilities_.workspace_max = {reach};
    // It takes any force, and gives way to none: so that its session has forces to record.
    capabilities_.force_max_n = peak_n;
    capabilities_.force_continuous_n = peak_n;
}

Sample Replay::read(base::TimePoint now)
{
    HandMoment moment = trace_.front();
    moment.gripping = false;
    if (start_) moment = at(base::to_seconds(now - *start_));
    Sample sample;
    sample.hip = moment.hip;
    sample.velocity = velocity_.at(moment.hip, now);
    sample.gripping = moment.gripping;
    sample.buttons = moment.gripping ? 1 : 0;
    sample.sequence = ++reads_;
    return sample;
}

void Replay::apply(const GovernedForce& /*force*/) {} // what has been cannot give way

void Replay::on_cue(const Cue& cue) { start_ = cue.start; }

HandMoment Replay::at(double seconds) const
{
    const double first = trace_.front().time_s;
    const double last = trace_.back().time_s;
    const bool again = after_ == AfterTheEnd::begins_again && seconds >= last && last > first;
    if (again) seconds = first + std::fmod(seconds - first, last - first);
    return moment_at(trace_, seconds);
}

} // namespace hapnet::device
