// SPDX-FileCopyrightText: 2026 The Hapnet authors
// SPDX-License-Identifier: MIT
#include "emulator/core/profile/timeline.hpp"

#include "emulator/core/profile/ramp.hpp"
#include "emulator/core/profile/regimes.hpp"
#include "proto/base/ensure.hpp"

#include <algorithm>
#include <spdlog/fmt/fmt.h>

namespace hapnet::emulator {

namespace {

base::Duration end_of(const Change& change) { return change.time + change.ramp; }

} // namespace

tl::expected<void, Timeline::BadChange> Timeline::validate(const Profile& profile)
{
    Timeline timeline{profile.path};
    for (std::size_t i = 0; i < profile.timeline.size(); ++i) {
        if (const auto added = timeline.add(profile.timeline[i]); !added) {
            return tl::unexpected{BadChange{i, added.error().message}};
        }
    }
    return {};
}

Timeline::Timeline(const Profile& profile) : Timeline{profile.path}
{
    steps_.reserve(profile.timeline.size());
    for (const Change& change : profile.timeline) base::ensure(add(change).has_value());
}

base::Result<void> Timeline::add(const Change& change)
{
    base::ensure(steps_.empty() || steps_.back().change.time <= change.time);
    const std::size_t index = steps_.size();
    Step step{change, at(change.time, index), index};
    const Path after{patched(step.before.up, change.up), patched(step.before.down, change.down)};
    if (auto same = ensure_same_regimes(after, step.before); !same) return same;
    if (change.ramp > base::Duration{0}) {
        auto valid = validate_ramp(step.before.up, change.up);
        if (valid) valid = validate_ramp(step.before.down, change.down);
        if (!valid) return valid;
    }
    for (std::size_t i = index > 0 ? steps_[index - 1].first : 0; i < index; ++i) {
        if (end_of(steps_[i].change) > change.time) {
            step.first = std::min(step.first, steps_[i].first);
        }
    }
    if (index - step.first >= ramps_max) {
        return base::fail(fmt::format("more than {} ramps overlap at this time", ramps_max));
    }
    steps_.push_back(std::move(step));
    return {};
}

Path Timeline::at(base::Duration since_start) const
{
    return at(since_start, steps_until(since_start));
}

Path Timeline::at(base::Duration since_start, std::size_t steps) const
{
    if (steps == 0) return start_;
    const std::size_t first = steps_[steps - 1].first;
    Path path = steps_[first].before;
    for (std::size_t i = first; i < steps; ++i) {
        const auto& [change, before, unused] = steps_[i];
        if (since_start >= end_of(change)) {
            path = {patched(std::move(path.up), change.up),
                    patched(std::move(path.down), change.down)};
            continue;
        }
        const double progress = static_cast<double>((since_start - change.time).count()) /
                                static_cast<double>(change.ramp.count());
        path = {ramped(std::move(path.up), before.up, change.up, progress),
                ramped(std::move(path.down), before.down, change.down, progress)};
    }
    return path;
}

std::optional<base::Duration> Timeline::next_change(base::Duration after) const
{
    const std::size_t steps = steps_until(after);
    std::optional<base::Duration> next;
    if (steps < steps_.size()) next = steps_[steps].change.time;
    for (std::size_t i = steps > 0 ? steps_[steps - 1].first : 0; i < steps; ++i) {
        const Change& change = steps_[i].change;
        if (end_of(change) <= after) continue;
        const auto done = (after - change.time) / ramp_step;
        const auto tick = std::min(change.time + (done + 1) * ramp_step, end_of(change));
        next = next ? std::min(*next, tick) : tick;
    }
    return next;
}

std::size_t Timeline::steps_until(base::Duration since_start) const
{
    const auto later =
        std::upper_bound(steps_.begin(), steps_.end(), since_start,
                         [](base::Duration at, const Step& step) { return at < step.change.time; });
    return static_cast<std::size_t>(later - steps_.begin());
}

} // namespace hapnet::emulator
