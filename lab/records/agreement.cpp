// SPDX-FileCopyrightText: 2026 The Hapnet authors
// SPDX-License-Identifier: MIT
#include "lab/records/agreement.hpp"

#include "lab/records/moments.hpp"

#include <algorithm>
#include <cmath>
#include <vector>

namespace hapnet::lab::records {

namespace {

using namespace std::chrono_literals;
using record::Phase;
using record::TickRow;

// Once both let go, the copies have this long to agree again.
constexpr base::Duration settling_time = 2s;

std::optional<ForceDiscrepancy> force_discrepancy_of(const std::vector<Moment>& moments)
{
    std::vector<double> distances;
    for (const Moment& moment : moments) {
        if (moment.both_in(Phase::running) && moment.both_touch()) {
            distances.push_back(moment.force_distance());
        }
    }
    const auto spread = metrics::spread_of(distances);
    if (!spread) return std::nullopt;
    return ForceDiscrepancy{spread->mean, spread->max};
}

std::optional<double> settled_discrepancy_of(const std::vector<Moment>& moments)
{
    std::optional<base::TimePoint> let_go;
    std::optional<double> largest;
    for (const Moment& moment : moments) {
        if (!moment.both_in(Phase::hands_off)) continue;
        if (!let_go) let_go = moment.a->due;
        if (moment.a->due < *let_go + settling_time) continue;
        largest = std::max(largest.value_or(0.0), norm(moment.cube_distance()));
    }
    return largest;
}

TouchShares touch_shares_of(const std::vector<Moment>& moments)
{
    TouchShares touched;
    double scored = 0.0;
    for (const Moment& moment : moments) {
        if (!moment.both_in(Phase::running)) continue;
        const bool a = moment.a->touching, b = moment.before->touching;
        scored += 1.0;
        touched.a += a ? 1.0 : 0.0;
        touched.b += b ? 1.0 : 0.0;
        touched.either += a || b ? 1.0 : 0.0;
        touched.both += a && b ? 1.0 : 0.0;
    }
    if (scored == 0.0) return {};
    return {touched.a / scored, touched.b / scored, touched.either / scored, touched.both / scored};
}

double overlap_of(const Session& session, const std::vector<Moment>& moments)
{
    const base::TimePoint start = session.a.terms.start;
    const base::Duration length = session.a.terms.length;
    if (length <= 0s) return 0.0;
    const auto shared = std::ranges::count_if(moments, [&](const Moment& moment) {
        const bool within = moment.a->due >= start && moment.a->due - start < length;
        const auto takes_part = [](const TickRow* row) {
            return row->phase == Phase::running || row->phase == Phase::hands_off;
        };
        return within && takes_part(moment.a) && takes_part(moment.before) &&
               takes_part(moment.after);
    });
    return std::min(1.0, base::to_seconds(shared * session.tick) / base::to_seconds(length));
}

} // namespace

Agreement agreement_of(const Session& session)
{
    const auto moments = moments_of(session);
    std::vector<double> distances;
    for (const Moment& moment : moments) {
        if (moment.both_in(Phase::running)) {
            distances.push_back(std::abs(moment.cube_distance().x()));
        }
    }
    return {.discrepancy_x = metrics::spread_of(distances),
            .force_discrepancy = force_discrepancy_of(moments),
            .settled_discrepancy = settled_discrepancy_of(moments),
            .touching = touch_shares_of(moments),
            .scored = static_cast<base::Duration::rep>(distances.size()) * session.tick,
            .overlap = overlap_of(session, moments)};
}

} // namespace hapnet::lab::records
