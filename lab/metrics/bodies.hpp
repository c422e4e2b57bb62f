// SPDX-FileCopyrightText: 2026 The Hapnet authors
// SPDX-License-Identifier: MIT
#pragma once

#include "lab/metrics/spread.hpp"
#include "lab/virtual_time/trace.hpp"
#include "proto/base/describe.hpp"

#include <optional>
#include <vector>

namespace hapnet::lab::metrics {

/// The distance and the angle between the copies of one shared body at equal times, in metres and
/// radians. With more than two copies, each value is that of the two copies that are farthest apart
/// in the mean.
struct BodyApart {
    /// |x_A - x_B|.
    std::optional<Spread> discrepancy_x_m{};
    /// The distance in space.
    std::optional<Spread> discrepancy_m{};
    /// The angle between the orientations; nullopt: the body never turned.
    std::optional<Spread> turned_apart_rad{};
    /// The largest distance of any two copies from 2 s after hands off to the end; nullopt: the
    /// session was not played so far.
    std::optional<double> settled_m{};
    std::optional<double> settled_rad{};

    friend bool operator==(const BodyApart&, const BodyApart&) = default;
};
constexpr auto fields_of(base::Tag<BodyApart>)
{
    using B = BodyApart;
    return base::fields(
        "body", base::member("discrepancy_x_m", &B::discrepancy_x_m, "|x_A - x_B|."),
        base::member("discrepancy_m", &B::discrepancy_m, "The distance in space."),
        base::member("turned_apart_rad", &B::turned_apart_rad,
                     "The angle between the orientations; null: it never turned."),
        base::member("settled_m", &B::settled_m,
                     "The largest distance from 2 s after hands off to the end; null: it was not "
                     "played so far."),
        base::member("settled_rad", &B::settled_rad, "Likewise the angle."));
}

/// Returns an entry for each shared body, in the order of their ids. The trace is not empty.
[[nodiscard]] std::vector<BodyApart> bodies_apart(const virtual_time::Trace& trace);

/// These functions return the spread of the body that is farthest apart in the mean, by |x_A - x_B|
/// and by the angle.
[[nodiscard]] std::optional<Spread> widest_discrepancy_x(const std::vector<BodyApart>& bodies);
[[nodiscard]] std::optional<Spread> widest_turned_apart(const std::vector<BodyApart>& bodies);

} // namespace hapnet::lab::metrics
