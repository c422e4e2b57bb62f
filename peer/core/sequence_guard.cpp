// SPDX-FileCopyrightText: 2026 The Hapnet authors
// SPDX-License-Identifier: MIT
#include "peer/core/sequence_guard.hpp"

#include <algorithm>

namespace hapnet::peer {

namespace {

// The steps by which a state changes the usual values. A device may set a pace 1.4 % above the
// nominal one (DeviceTimer), and a queue may drain at almost a millisecond per state.
constexpr base::Duration lead_step{std::chrono::microseconds{125}};
constexpr base::Duration transit_step{std::chrono::milliseconds{1}};

base::Duration stepped(base::Duration from, base::Duration to, base::Duration down,
                       base::Duration up)
{
    return from + std::clamp(to - from, -down, up);
}

} // namespace

SequenceGuard::Usual SequenceGuard::of(const wire::State& state, base::TimePoint arrived) const
{
    const base::Duration numbered = static_cast<base::Duration::rep>(state.sequence) * tick_;
    return {numbered - state.sent.time_since_epoch(), arrived - state.sent, arrived};
}

bool SequenceGuard::admits(const wire::State& state, base::TimePoint arrived) const
{
    if (!usual_ || arrived - usual_->last >= forgotten_after) return true;
    const Usual now = of(state, arrived);
    return now.lead <= usual_->lead + numbered_ahead_max &&
           now.transit >= usual_->transit - faster_max;
}

void SequenceGuard::on_taken(const wire::State& state, base::TimePoint arrived)
{
    const Usual now = of(state, arrived);
    if (!usual_ || arrived - usual_->last >= forgotten_after) {
        usual_ = now;
        return;
    }
    // A peer that sends in fewer ticks falls behind its stamps by the time between two messages.
    const base::Duration pause = std::max(lead_step, arrived - usual_->last);
    usual_->lead = stepped(usual_->lead, now.lead, pause, lead_step);
    usual_->transit = stepped(usual_->transit, now.transit, transit_step, transit_step);
    usual_->last = std::max(usual_->last, arrived);
}

} // namespace hapnet::peer
