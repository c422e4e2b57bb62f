// SPDX-FileCopyrightText: 2026 The Hapnet authors
// SPDX-License-Identifier: MIT
#pragma once

#include "lab/metrics/spread.hpp"
#include "lab/records/session.hpp"
#include "proto/base/time.hpp"

#include <optional>

namespace hapnet::lab::records {

/// In newtons.
struct ForceDiscrepancy {
    double mean = 0.0;
    double max = 0.0;
};

/// Shares of time, 0 to 1. A task was played only while a hand touched.
struct TouchShares {
    double a = 0.0;
    double b = 0.0;
    double either = 0.0;
    double both = 0.0;
};

/// How well both copies of the scene agree at equal times, namely at each tick of A; B's state
/// then is interpolated linearly between its ticks.
struct Agreement {
    /// |x_A - x_B| of the cube, in metres, while both are running; nullopt when they never are.
    std::optional<metrics::Spread> discrepancy_x;
    /// ||F_A| - |F_B|| of the contact forces while both are running and touch; nullopt when they
    /// never do.
    std::optional<ForceDiscrepancy> force_discrepancy;
    /// The largest distance of the cubes, in metres, from 2 s after both let go to the end of the
    /// hands-off tail; nullopt when that was not reached.
    std::optional<double> settled_discrepancy;
    /// Who touched the cube while both were running; all zero when they never were.
    TouchShares touching;
    /// How long both were running.
    base::Duration scored{};
    /// The share of the session, 0 to 1, in which both have ticks and are running or hands off.
    double overlap = 0.0;
};

[[nodiscard]] Agreement agreement_of(const Session& session);

} // namespace hapnet::lab::records
