// SPDX-FileCopyrightText: 2026 The Hapnet authors
// SPDX-License-Identifier: MIT
#include "lab/records/curves.hpp"

#include "lab/records/moments.hpp"

#include <cmath>

namespace hapnet::lab::records {

namespace {

constexpr double mm_per_m = 1e3;

bool takes_part(const record::TickRow& row)
{
    return row.phase == record::Phase::running || row.phase == record::Phase::hands_off ||
           row.phase == record::Phase::alone;
}

} // namespace

SessionCurves curves_of(const Session& session)
{
    SessionCurves curves;
    const auto seconds = [&](base::TimePoint on_a) {
        return base::to_seconds(on_a - session.a.terms.start);
    };
    for (const record::TickRow& row : session.a.ticks) {
        if (!takes_part(row)) continue;
        curves.cube_a_mm.push_back({seconds(row.at()), mm_per_m * row.cube.x()});
        curves.force_a_n.push_back({seconds(row.at()), norm(row.device)});
    }
    for (const record::TickRow& row : session.b.ticks) {
        if (!takes_part(row)) continue;
        const double time_s = seconds(session.clock.to_a(row.at()));
        curves.cube_b_mm.push_back({time_s, mm_per_m * row.cube.x()});
        curves.force_b_n.push_back({time_s, norm(row.device)});
    }
    for (const Moment& moment : moments_of(session)) {
        if (!takes_part(*moment.a) || !takes_part(*moment.before)) continue;
        curves.apart_mm.push_back(
            {seconds(moment.a->at()), mm_per_m * std::abs(moment.cube_distance().x())});
    }
    return curves;
}

} // namespace hapnet::lab::records
