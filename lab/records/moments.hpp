// SPDX-FileCopyrightText: 2026 The Hapnet authors
// SPDX-License-Identifier: MIT
#pragma once

#include "lab/records/session.hpp"
#include "proto/base/space.hpp"

#include <vector>

namespace hapnet::lab::records {

/// One moment of a session on both sides: a tick of A and the ticks of B around it. Both ticks of B
/// are the same one when B has a tick at exactly that time.
struct Moment {
    const record::TickRow* a;
    const record::TickRow* before;
    const record::TickRow* after;
    double share; // position of A's tick between `before` and `after`, 0 to 1

    [[nodiscard]] bool both_in(record::Phase phase) const
    {
        return a->phase == phase && before->phase == phase && after->phase == phase;
    }
    [[nodiscard]] bool both_touch() const
    {
        return a->touching && before->touching && after->touching;
    }
    /// Returns ||F_A| - |F_B|| of one of the forces of a tick.
    [[nodiscard]] double force_distance(base::Force record::TickRow::*force) const;
};

/// Returns the moments at which both sides have data, one for each tick of A. They refer to the
/// session.
[[nodiscard]] std::vector<Moment> moments_of(const Session& session);

} // namespace hapnet::lab::records
