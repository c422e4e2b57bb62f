// SPDX-FileCopyrightText: 2026 The Hapnet authors
// SPDX-License-Identifier: MIT
#include "peer/core/farewell.hpp"

namespace hapnet::peer {

bool Farewell::refuse(const Refusal& refusal, base::TimePoint now)
{
    if (refusal_) return false;
    const bool again = times_ > 0 && pending_ == refusal;
    if (again && now - last_refusal_ < refusal_every) return false;
    times_ = again ? times_ + 1 : 1;
    pending_ = refusal;
    last_refusal_ = now;
    if (times_ < refusals_needed) return false;
    refusal_ = refusal.reason;
    return true;
}

void Farewell::leave(wire::ByeReason reason, bool has_audience)
{
    if (is_leaving()) return;
    because_ = reason;
    if (!has_audience) byes_left_ = 0;
}

bool Farewell::says_bye(base::TimePoint now)
{
    if (byes_left_ == 0 || (last_bye_ && now - *last_bye_ < bye_every)) return false;
    last_bye_ = now;
    --byes_left_;
    return true;
}

} // namespace hapnet::peer
