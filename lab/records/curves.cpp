// SPDX-FileCopyrightText: 2026 The Hapnet authors
// SPDX-License-Identifier: MIT
#include "lab/records/curves.hpp"

#include "lab/records/agreement.hpp"
#include "lab/records/bodies.hpp"
#include "lab/records/moments.hpp"

#include <cmath>

namespace hapnet::lab::records {

namespace {

constexpr double us_per_s = 1e6;

bool takes_part(const record::TickRow& row)
{
    return row.phase == record::Phase::running || row.phase == record::Phase::hands_off ||
           row.phase == record::Phase::alone;
}

/// Calls take(seconds from the start, distance) while both sides take part.
template <typename Take>
void for_each_apart(const Session& session, const RecordedBody& body,
                    const std::vector<Moment>& moments, const Take& take)
{
    const Copies copies{session, body};
    for (const Moment& moment : moments) {
        if (!takes_part(*moment.a) || !takes_part(*moment.before)) continue;
        if (const auto apart = copies.apart_at(moment))
            take(base::to_seconds(moment.a->at() - session.a.terms.start), *apart);
    }
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
        curves.late_a_us.push_back(us_per_s * base::to_seconds(row.late));
    }
    for (const record::TickRow& row : session.b.ticks) {
        if (!takes_part(row)) continue;
        const double time_s = seconds(session.clock.to_a(row.at()));
        curves.cube_b_mm.push_back({time_s, mm_per_m * row.cube.x()});
        curves.force_b_n.push_back({time_s, norm(row.device)});
        curves.late_b_us.push_back(us_per_s * base::to_seconds(row.late));
    }
    curves.paths = paths_over_time(session);
    const auto moments = moments_of(session);
    for_each_apart(session, session.bodies.front(), moments,
                   [&](double time_s, const Apart& apart) {
                       curves.apart_mm.push_back({time_s, mm_per_m * std::abs(apart.distance.x())});
                   });
    if (session.bodies.size() == 1 && !session.bodies.front().can_turn) return curves;
    for (const RecordedBody& body : session.bodies) {
        BodyCurves& of_body = curves.bodies.emplace_back(BodyCurves{name_of(body), {}, {}});
        for_each_apart(session, body, moments, [&](double time_s, const Apart& apart) {
            of_body.apart_mm.push_back({time_s, mm_per_m * norm(apart.distance)});
            if (!body.can_turn) return;
            of_body.turned_apart_deg.push_back({time_s, deg_per_rad * apart.angle_rad});
        });
    }
    return curves;
}

} // namespace hapnet::lab::records
