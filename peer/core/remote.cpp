// SPDX-FileCopyrightText: 2026 The Hapnet authors
// SPDX-License-Identifier: MIT
#include "peer/core/remote.hpp"

#include <algorithm>
#include <cstdlib>

namespace hapnet::peer {

bool Remote::update(const wire::State& state, base::TimePoint arrived)
{
    const bool is_stale = state_ && state.sequence <= state_->sequence;
    if (is_stale && stale_ == Stale::drop) return false;
    arrived_ = arrived_ ? std::max(*arrived_, arrived) : arrived;
    state_ = state;
    if (count_ == 1 && state.bodies.size() == 1 && bodies_[0].body == state.bodies.first()->body) {
        bodies_[0] = *state.bodies.first(); // as in the paper's scene
    } else {
        take(state);
    }
    return true;
}

void Remote::take(const wire::State& state)
{
    std::int64_t most = 0; // of the impulse that its hand has given to one of them since
    for (const wire::BodyState& body : state.bodies) {
        std::size_t i = 0;
        while (i < count_ && bodies_[i].body != body.body) ++i;
        if (i == count_) {
            if (count_ == bodies_.size()) continue; // of which no honest session tells
            bodies_[count_] = {};
            bodies_[count_++].body = body.body;
        }
        if (count_ > 1 && state.touching) {
            std::int64_t given = 0;
            for (const std::int64_t part :
                 wire::difference(body.caused_impulse_uns, bodies_[i].caused_impulse_uns))
                given += std::abs(part);
            if (given > most) {
                most = given;
                touched_ = i;
            }
        }
        bodies_[i] = body;
    }
}

const wire::BodyState* Remote::body(std::uint16_t id) const
{
    const auto* const end = bodies_.begin() + count_;
    const auto* const found =
        std::find_if(bodies_.begin(), end, [id](const auto& body) { return body.body == id; });
    return found == end ? nullptr : found;
}

const wire::BodyState* Remote::touched() const
{
    return state_ && state_->touching && touched_ < count_ ? &bodies_[touched_] : nullptr;
}

void Remote::forget()
{
    state_.reset();
    count_ = 0;
    touched_ = 0;
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
