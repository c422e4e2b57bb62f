// SPDX-FileCopyrightText: 2026 The Hapnet authors
// SPDX-License-Identifier: MIT
#include "lab/records/moments.hpp"

#include <chrono>
#include <cmath>

namespace hapnet::lab::records {

namespace {

// Between ticks of B that are further apart than this, there are no data: the gap is not bridged.
constexpr base::Duration gap_max{std::chrono::milliseconds{10}};

} // namespace

double Moment::force_distance(base::Force record::TickRow::*force) const
{
    const base::Force step = after->*force - before->*force;
    return std::abs(norm(a->*force) - norm(before->*force + share * step));
}

std::vector<Moment> moments_of(const Session& session)
{
    std::vector<Moment> moments;
    const auto b = session.b.ticks;
    const auto time_of = [&](const record::TickRow& row) { return session.clock.to_a(row.at()); };
    auto after = b.begin();
    for (const record::TickRow& a : session.a.ticks) {
        while (after != b.end() && time_of(*after) < a.at()) ++after;
        if (after == b.end()) break;
        if (time_of(*after) == a.at()) {
            moments.push_back({&a, &*after, &*after, 0.0});
            continue;
        }
        if (after == b.begin()) continue;
        const auto before = after - 1;
        const base::Duration gap = after->at() - before->at();
        if (gap > gap_max) continue;
        moments.push_back({&a, &*before, &*after,
                           base::to_seconds(a.at() - time_of(*before)) / base::to_seconds(gap)});
    }
    return moments;
}

} // namespace hapnet::lab::records
