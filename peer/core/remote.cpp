// SPDX-FileCopyrightText: 2026 The Hapnet authors
// SPDX-License-Identifier: MIT
#include "peer/core/remote.hpp"

#include <algorithm>

namespace hapnet::peer {

bool Remote::update(const wire::State& state, base::TimePoint arrived)
{
    const bool is_stale = state_ && state.sequence <= state_->sequence;
    if (is_stale && stale_ == Stale::drop) return false;
    arrived_ = arrived_ ? std::max(*arrived_, arrived) : arrived;
    state_ = state;
    if (const wire::BodyState* const body = state.bodies.first()) body_ = *body;
    return true;
}

void Remote::forget()
{
    state_.reset();
    body_.reset();
    arrived_.reset();
}

double Remote::freshness(base::TimePoint now) const
{
    if (!arrived_) return 0.0;
    const base::Duration past_hold = (now - *arrived_) - staleness_.hold;
    if (past_hold <= base::Duration{0}) return 1.0;
    if (past_hold >= staleness_.fade) return 0.0;
    return 1.0 - base::to_seconds(past_hold) / base::to_seconds(staleness_.fade);
}

} // namespace hapnet::peer
