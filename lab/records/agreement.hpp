// SPDX-FileCopyrightText: 2026 The Hapnet authors
// SPDX-License-Identifier: MIT
#pragma once

#include "lab/metrics/spread.hpp"
#include "lab/records/session.hpp"
#include "proto/base/time.hpp"

#include <cstdint>
#include <optional>
#include <vector>

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

/// How far the copies of one body are apart at equal times. Metres and radians.
struct BodyAgreement {
    RecordedBody body{};
    /// |x_A - x_B| while both are running; nullopt when they never are.
    std::optional<metrics::Spread> discrepancy_x{};
    /// In space; otherwise the same.
    std::optional<metrics::Spread> discrepancy{};
    /// The angle between their orientations; nullopt, too, for a body that cannot turn.
    std::optional<metrics::Spread> turned_apart{};
    /// The largest distance and angle from 2 s after both let go to the end of the hands-off tail;
    /// nullopt when that was not reached, and the angle of a body that cannot turn.
    std::optional<double> settled_discrepancy{};
    std::optional<double> settled_turned_apart{};
    /// How often its owner changed while both were running, as the side has it that saw more of
    /// it; nullopt when the records do not say who owns it.
    std::optional<std::uint64_t> handovers{};
    /// The share of that time, 0 to 1, in which both say that the same peer owns it. While both
    /// hands move it, each side says its own.
    std::optional<double> same_owner{};
};

/// How well both copies of the scene agree at equal times, namely at each tick of A; B's state
/// then is interpolated linearly between its ticks.
struct Agreement {
    /// Each shared body.
    std::vector<BodyAgreement> bodies;
    /// |x_A - x_B| of the body that is farthest apart in the mean, in metres, while both are
    /// running; nullopt when they never are.
    std::optional<metrics::Spread> discrepancy_x;
    /// ||F_A| - |F_B|| of the forces that the devices were told, after their governors, while both
    /// are running and touch; nullopt when they never do.
    std::optional<ForceDiscrepancy> force_discrepancy;
    /// Likewise of the contact forces, before the governor.
    std::optional<ForceDiscrepancy> contact_force_discrepancy;
    /// The largest of all bodies.
    std::optional<double> settled_discrepancy;
    std::optional<double> settled_turned_apart;
    /// Who touched the cube while both were running; all zero when they never were.
    TouchShares touching;
    /// How long both were running.
    base::Duration scored{};
    /// The share of the session, 0 to 1, in which both have ticks and are running or hands off.
    double overlap = 0.0;
};

[[nodiscard]] Agreement agreement_of(const Session& session);

} // namespace hapnet::lab::records
