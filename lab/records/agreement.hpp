// SPDX-FileCopyrightText: 2026 The Hapnet authors
// SPDX-License-Identifier: MIT
#pragma once

#include "lab/metrics/spread.hpp"
#include "lab/records/session.hpp"
#include "proto/base/describe.hpp"
#include "proto/base/time.hpp"
#include "proto/base/value_kind.hpp"

#include <cstdint>
#include <numbers>
#include <optional>
#include <vector>

namespace hapnet::lab::records {

/// A difference of forces in newtons.
struct ForceDiscrepancy {
    double mean = 0.0;
    double max = 0.0;
};

constexpr auto fields_of(base::Tag<ForceDiscrepancy>)
{
    return base::fields("force discrepancy", base::member("mean", &ForceDiscrepancy::mean),
                        base::member("max", &ForceDiscrepancy::max));
}

/// Shares of time, 0 to 1. A task is played only while a hand touches.
struct TouchShares {
    double a = 0.0;
    double b = 0.0;
    double either = 0.0;
    double both = 0.0;
};

constexpr auto fields_of(base::Tag<TouchShares>)
{
    return base::fields("touching", base::member("a", &TouchShares::a, "Only or also A."),
                        base::member("b", &TouchShares::b, "Only or also B."),
                        base::member("either", &TouchShares::either, "One of the two or both."),
                        base::member("both", &TouchShares::both, "Both at a time."));
}

inline constexpr double mm_per_m = 1e3;
inline constexpr double deg_per_rad = 180.0 / std::numbers::pi;

/// Converts to another unit.
template <typename Figure>
[[nodiscard]] std::optional<Figure> scaled(const std::optional<Figure>& figure, double unit)
{
    return figure ? std::optional<Figure>{unit * *figure} : std::nullopt;
}

/// The agreement of the copies of one body at equal times, in metres and radians.
struct BodyAgreement {
    RecordedBody body{};
    /// |x_A - x_B| while both sides are running; nullopt when they never are.
    std::optional<metrics::Spread> discrepancy_x{};
    /// The distance in space, under the same conditions.
    std::optional<metrics::Spread> discrepancy{};
    /// The angle between the orientations; nullopt also for a body that cannot turn.
    std::optional<metrics::Spread> turned_apart{};
    /// The largest distance and angle from 2 s after both let go to the end of the hands-off tail.
    /// nullopt when that time was not reached; the angle also for a body that cannot turn.
    std::optional<double> settled_discrepancy{};
    std::optional<double> settled_turned_apart{};
    /// The number of changes of the body's owner while both sides were running, by the side that
    /// saw more of them; nullopt when the records do not name the owner.
    std::optional<std::uint64_t> handovers{};
    /// The share of that time, 0 to 1, in which both sides name the same peer as its owner. While
    /// both hands move the body, each side names itself.
    std::optional<double> same_owner{};
};

constexpr auto fields_of(base::Tag<BodyAgreement>)
{
    using B = BodyAgreement;
    return base::fields(
        "body agreement",
        base::computed<B>(
            "name",
            [](const B& one) {
                return one.body.name.empty() ? std::nullopt : std::optional{one.body.name};
            },
            "Its name in the scene; null: it has none."),
        base::computed<B>(
            "discrepancy_mm", [](const B& one) { return scaled(one.discrepancy, mm_per_m); },
            "The distance of its two copies in all axes; null: never both running."),
        base::computed<B>(
            "discrepancy_x_mm", [](const B& one) { return scaled(one.discrepancy_x, mm_per_m); },
            "Likewise in x."),
        base::computed<B>(
            "turned_apart_deg", [](const B& one) { return scaled(one.turned_apart, deg_per_rad); },
            "The angle between their orientations; null, too, where it cannot turn."),
        base::computed<B>(
            "settled_discrepancy_mm",
            [](const B& one) { return scaled(one.settled_discrepancy, mm_per_m); },
            "As that of the session, of this body."),
        base::computed<B>(
            "settled_turned_apart_deg",
            [](const B& one) { return scaled(one.settled_turned_apart, deg_per_rad); },
            "As that of the session, of this body."),
        base::member("handovers", &B::handovers,
                     "How often its [`owner`](record.md#4-body) changed while both are running, by "
                     "the record that has more such changes; null: the records do not say."),
        base::member("same_owner", &B::same_owner,
                     "Share of the time with both running in which both records name the same "
                     "owner; while both hands move a body each names itself."));
}

/// The agreement of both copies of the scene at equal times: at each tick of A. B's state is
/// interpolated linearly between its ticks.
struct Agreement {
    /// The agreement of each shared body.
    std::vector<BodyAgreement> bodies;
    /// |x_A - x_B| of the body that is farthest apart in the mean, in metres, while both sides are
    /// running; nullopt when they never are.
    std::optional<metrics::Spread> discrepancy_x;
    /// ||F_A| - |F_B|| of the forces sent to the devices, after their governors, while both sides
    /// are running and touch; nullopt when they never do.
    std::optional<ForceDiscrepancy> force_discrepancy;
    /// ||F_A| - |F_B|| of the contact forces, before the governor, under the same conditions.
    std::optional<ForceDiscrepancy> contact_force_discrepancy;
    /// The largest value of all bodies.
    std::optional<double> settled_discrepancy;
    std::optional<double> settled_turned_apart;
    /// The shares of the time with both sides running in which they touched the cube; all zero when
    /// they were never both running.
    TouchShares touching;
    /// The time in which both were running.
    base::Duration scored{};
    /// The share of the session, 0 to 1, in which both have ticks and are running or hands off.
    double overlap = 0.0;
};

/// Returns the bodies with their numbers in the scene as keys. Bodies whose records do not hold a
/// number have none.
[[nodiscard]] base::Entries<BodyAgreement> numbered(const std::vector<BodyAgreement>& bodies);

constexpr auto fields_of(base::Tag<Agreement>)
{
    using A = Agreement;
    return base::fields(
        "agreement",
        base::computed<A>(
            "discrepancy_x_mm", [](const A& one) { return scaled(one.discrepancy_x, mm_per_m); },
            "|x_A - x_B| of the body while both are in phase `running`; of several bodies the one "
            "farthest apart on average; of several peers the two. null: never both running."),
        base::member("force_discrepancy_n", &A::force_discrepancy,
                     "||F_A| - |F_B|| of the forces that the devices were told, after their "
                     "governors, while both are running and touch; null: they never do."),
        base::member("contact_force_discrepancy_n", &A::contact_force_discrepancy,
                     "Likewise of the contact forces, before the governors."),
        base::computed<A>(
            "settled_discrepancy_mm",
            [](const A& one) { return scaled(one.settled_discrepancy, mm_per_m); },
            "Largest distance of the two copies, in all axes, from 2 s after the hands were taken "
            "off to the end; of several bodies or pairs the largest. null: the session has 4 s or "
            "less, or was cut off."),
        base::computed<A>(
            "settled_turned_apart_deg",
            [](const A& one) { return scaled(one.settled_turned_apart, deg_per_rad); },
            "Likewise the angle between the orientations; null, too, where no body can turn."),
        base::member("touching", &A::touching,
                     "Share of the time with both running in which these hands touch the body."),
        base::computed<A>(
            "bodies", [](const A& one) { return numbered(one.bodies); },
            "Each shared body, by its number in the scene from 0; of several pairs each quantity "
            "of the worst."),
        base::member("scored_s", &A::scored, "Time with both running."),
        base::member("overlap", &A::overlap,
                     "Share of the session's length in which both are running or hands off."));
}

[[nodiscard]] Agreement agreement_of(const Session& session);

} // namespace hapnet::lab::records
