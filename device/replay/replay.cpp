// SPDX-FileCopyrightText: 2026 The Hapnet authors
// SPDX-License-Identifier: MIT
#include "device/replay/replay.hpp"

#include "proto/base/ensure.hpp"

#include <algorithm>
#include <spdlog/fmt/fmt.h>
#include <utility>

namespace hapnet::device {

Replay::Replay(HandTrace trace, std::string source)
    : trace_{std::move(trace)}, source_{std::move(source)}
{
    base::ensure(!trace_.empty());
}

Sample Replay::read(base::TimePoint now)
{
    HandMoment moment = trace_.front();
    moment.gripping = false;
    if (start_) moment = at(base::to_seconds(now - *start_));
    return {moment.hip, velocity_.at(moment.hip, now), moment.gripping};
}

void Replay::apply(base::Force /*force*/) {} // what has been cannot give way

void Replay::on_cue(const Cue& cue) { start_ = cue.start; }

HandMoment Replay::at(double seconds) const
{
    const auto next =
        std::upper_bound(trace_.begin(), trace_.end(), seconds,
                         [](double t, const HandMoment& moment) { return t < moment.time_s; });
    if (next == trace_.begin()) return {seconds, next->hip, false};
    const HandMoment& from = *(next - 1);
    if (next == trace_.end()) return {seconds, from.hip, false};
    const double share = (seconds - from.time_s) / (next->time_s - from.time_s);
    return {seconds, {from.hip.value + share * (next->hip - from.hip).value}, from.gripping};
}

std::string Replay::description() const
{
    return fmt::format("replay of {}: {} moments", source_, trace_.size());
}

} // namespace hapnet::device
