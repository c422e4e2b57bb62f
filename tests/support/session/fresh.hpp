// SPDX-FileCopyrightText: 2026 The Hapnet authors
// SPDX-License-Identifier: MIT
#pragma once

#include "peer/core/remote.hpp"

namespace hapnet::peer {

/// Lets a remote's state grow as old as makes it so fresh in this tick, 0 to 1.
inline void look_when_fresh_by(double freshness, Remote& remote)
{
    const Staleness usual;
    const auto faded = std::chrono::duration_cast<base::Duration>((1.0 - freshness) * usual.fade);
    remote.look(remote.arrived().value_or(base::TimePoint{}) + usual.hold + faded);
}

} // namespace hapnet::peer
