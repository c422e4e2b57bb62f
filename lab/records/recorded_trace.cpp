// SPDX-FileCopyrightText: 2026 The Hapnet authors
// SPDX-License-Identifier: MIT
#include "lab/records/recorded_trace.hpp"

#include "lab/records/agreement.hpp"
#include "lab/records/bodies.hpp"
#include "peer/core/peer.hpp"

#include <algorithm>
#include <cstddef>
#include <utility>
#include <vector>

namespace hapnet::lab::records {

namespace {

// Between rows that are further apart than this, there are no data. Such a gap does not count as
// covered.
constexpr base::Duration bridge_max{std::chrono::milliseconds{10}};

virtual_time::Sample sample_of(const record::TickRow& row)
{
    return {.body = row.cube,
            .body_velocity = row.cube_velocity,
            .hip = row.hip,
            .hip_velocity = row.hip_velocity,
            .on_hand = row.device,
            .on_body = -row.contact,
            .touching = row.touching,
            .holding = false,
            .remote_touching = row.remote_touching};
}

/// The rows of a side while it was running, on A's clock. They must be read in the order of time.
class RunningRows {
public:
    /// `clock` relates the clock of these rows, as B's, to A's; it is empty if the rows are A's.
    RunningRows(const Side& side, const Clock& clock, const std::vector<RecordedBody>& bodies)
        : clock_{clock}
    {
        for (const RecordedBody& body : bodies) poses_.emplace_back(side, body);
        const auto runs = [](const record::TickRow& row) {
            return row.phase == record::Phase::running;
        };
        const auto first = std::ranges::find_if(side.ticks, runs);
        const auto last = std::find_if_not(first, side.ticks.end(), runs);
        rows_ = {first, last};
    }

    [[nodiscard]] bool empty() const { return rows_.empty(); }
    [[nodiscard]] base::TimePoint begin() const { return clock_.to_a(rows_.front().at()); }
    [[nodiscard]] base::TimePoint end() const { return clock_.to_a(rows_.back().at()); }

    struct Reading {
        virtual_time::Sample sample;
        std::vector<virtual_time::Pose> further; // poses of the bodies after the first
        bool is_bridged = false;                 // true: a row is missing around that time
    };
    /// Returns the reading at a time from begin() to end(). The time must not be before that of the
    /// last call.
    [[nodiscard]] Reading at(base::TimePoint time)
    {
        const base::TimePoint here = clock_.to_b(time);
        while (at_ + 1 < rows_.size() && rows_[at_ + 1].at() <= here) ++at_;
        const record::TickRow& row = rows_[at_];
        if (at_ + 1 == rows_.size()) return reading_between(row, row, 0.0);
        const record::TickRow& next = rows_[at_ + 1];
        const base::Duration gap = next.at() - row.at();
        const double share = base::to_seconds(here - row.at()) / base::to_seconds(gap);
        Reading reading = reading_between(row, next, share);
        reading.is_bridged |= gap > bridge_max;
        return reading;
    }

private:
    [[nodiscard]] Reading reading_between(const record::TickRow& row, const record::TickRow& next,
                                          double share) const
    {
        Reading reading{between(sample_of(row), sample_of(next), share), {}, false};
        for (std::size_t i = 0; i < poses_.size(); ++i) {
            const auto earlier = poses_[i].at(row);
            const auto later = poses_[i].at(next);
            reading.is_bridged |= !earlier || !later;
            const auto pose = earlier && later ? between(*earlier, *later, share)
                                               : earlier.value_or(virtual_time::Pose{row.cube});
            if (i > 0) {
                reading.further.push_back(pose);
            } else {
                reading.sample.orientation = pose.orientation;
            }
        }
        return reading;
    }

    std::vector<Poses> poses_; // poses of each body
    std::span<const record::TickRow> rows_;
    Clock clock_;
    std::size_t at_ = 0;
};

/// Returns the largest distance and angle of each body over all these pairs; empty: in one pair the
/// hands were not off long enough.
std::vector<virtual_time::Settled> settled_in(std::span<const Session> sessions,
                                              const std::vector<RecordedBody>& bodies)
{
    std::vector<virtual_time::Settled> settled(bodies.size());
    for (const Session& session : sessions) {
        const Agreement agreement = agreement_of(session);
        for (std::size_t i = 0; i < bodies.size(); ++i) {
            const auto body = std::ranges::find_if(agreement.bodies, [&](const BodyAgreement& one) {
                return one.body.number == bodies[i].number;
            });
            if (!body->settled_discrepancy) return {};
            settled[i].metres = std::max(settled[i].metres, *body->settled_discrepancy);
            settled[i].radians =
                std::max(settled[i].radians, body->settled_turned_apart.value_or(0.0));
        }
    }
    return settled;
}

/// One peer of a session: its recorded part, and its clock relative to A's.
struct Party {
    const Side* side = nullptr;
    Clock clock{};
};

/// Returns the parties in the order of their ids.
std::vector<Party> parties_of(std::span<const Session> sessions)
{
    std::vector<Party> parties{{&sessions.front().a, {}}};
    for (const Session& session : sessions) parties.push_back({&session.b, session.clock});
    std::ranges::sort(parties, {}, [](const Party& party) { return party.side->peer_id; });
    return parties;
}

} // namespace

std::vector<RecordedBody> bodies_of(std::span<const Session> sessions)
{
    std::vector<RecordedBody> bodies = sessions.front().bodies;
    for (const Session& session : sessions.subspan(1)) {
        std::erase_if(bodies, [&](const RecordedBody& body) {
            const auto& others = session.bodies;
            return std::ranges::find(others, body.number, &RecordedBody::number) == others.end();
        });
    }
    return bodies;
}

virtual_time::Trace trace_of(const Session& session) { return trace_of(std::span{&session, 1}); }

virtual_time::Trace trace_of(std::span<const Session> sessions)
{
    const Session& session = sessions.front();
    virtual_time::Trace trace{.tick = session.tick};
    if (const auto task = device::task_named(session.task)) trace.task = *task;
    const std::vector<Party> parties = parties_of(sessions);
    const std::vector<RecordedBody> bodies = bodies_of(sessions);
    trace.sides.resize(parties.size());
    std::vector<RunningRows> rows;
    for (const Party& party : parties)
        if (rows.emplace_back(*party.side, party.clock, bodies).empty()) return trace;
    if (bodies.empty()) return trace;

    base::TimePoint begin = rows.front().begin(), end = rows.front().end();
    for (const RunningRows& one : rows) {
        begin = std::max(begin, one.begin());
        end = std::min(end, one.end());
    }
    base::Duration::rep bridged = 0;
    trace.further_bodies = bodies.size() - 1;
    trace.further.resize(parties.size());
    for (base::TimePoint time = begin; time <= end; time += session.tick) {
        bool is_bridged = false;
        for (std::size_t side = 0; side < rows.size(); ++side) {
            const auto reading = rows[side].at(time);
            trace.sides[side].push_back(reading.sample);
            auto& further = trace.further[side];
            further.insert(further.end(), reading.further.begin(), reading.further.end());
            is_bridged |= reading.is_bridged;
        }
        if (is_bridged) ++bridged;
    }
    trace.begin = begin - parties.front().clock.to_a(parties.front().side->terms.start);
    if (bodies.front().has_rows) trace.settled = settled_in(sessions, bodies);
    const auto samples = static_cast<base::Duration::rep>(trace.sides[0].size());
    const base::Duration length = peer::Peer::hands_on_of(session.a.terms.length);
    if (length > base::Duration{0}) {
        trace.overlap = std::min(1.0, base::to_seconds((samples - bridged) * session.tick) /
                                          base::to_seconds(length));
    }
    return trace;
}

} // namespace hapnet::lab::records
