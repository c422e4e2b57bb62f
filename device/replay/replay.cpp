// SPDX-FileCopyrightText: 2026 The Hapnet authors
// SPDX-License-Identifier: MIT
#include "device/replay/replay.hpp"

#include "proto/base/ensure.hpp"

#include <cmath>
#include <spdlog/fmt/fmt.h>
#include <utility>

namespace hapnet::device {

Replay::Replay(HandTrace trace, std::string source, AfterTheEnd after)
    : trace_{std::move(trace)}, after_{after}
{
    base::ensure(!trace_.empty());
    identity_ = {.backend = "replay",
                 .serial = std::move(source),
                 .model = fmt::format("a recorded hand, {} moments", trace_.size())};
}

Sample Replay::read(base::TimePoint now)
{
    HandMoment moment = trace_.front();
    moment.gripping = false;
    if (start_) moment = at(base::to_seconds(now - *start_));
    return hand_.sample(moment, now);
}

void Replay::apply(const GovernedForce& /*force*/) {} // a recorded hand cannot give way

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
