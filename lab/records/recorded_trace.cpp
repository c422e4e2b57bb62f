// SPDX-FileCopyrightText: 2026 The Hapnet authors
// SPDX-License-Identifier: MIT
#include "lab/records/recorded_trace.hpp"

#include "lab/records/bodies.hpp"
#include "peer/core/peer.hpp"

#include <algorithm>
#include <cstddef>
#include <utility>
#include <vector>

namespace hapnet::lab::records {

namespace {

// Rows further apart than this have time without data between them, not a straight line.
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

/// The rows of a side while it was running, on A's clock, asked in the order of time.
class RunningRows {
public:
    /// `clock`: of these rows as B's against A's; none where they are A's.
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
        std::vector<virtual_time::Pose> further; // bodies after the first
        bool is_bridged = false;                 // there is no row near it
    };
    /// At a time from begin() to end(), not before the last one asked for.
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

    std::vector<Poses> poses_; // of each body
    std::span<const record::TickRow> rows_;
    Clock clock_;
    std::size_t at_ = 0;
};

base::Duration hands_on(base::Duration length)
{
    return length - std::min(peer::Peer::hands_off_length, length / 2);
}

} // namespace

virtual_time::Trace trace_of(const Session& session)
{
    virtual_time::Trace trace{.tick = session.tick};
    if (const auto task = device::task_named(session.task)) trace.task = *task;
    const bool a_is_left = session.a.peer_id < session.b.peer_id;
    RunningRows a{session.a, Clock{}, session.bodies};
    RunningRows b{session.b, session.clock, session.bodies};
    if (a.empty() || b.empty()) return trace;

    const base::TimePoint begin = std::max(a.begin(), b.begin());
    const base::TimePoint end = std::min(a.end(), b.end());
    base::Duration::rep bridged = 0;
    trace.further_bodies = session.bodies.size() - 1;
    trace.further.resize(2);
    for (base::TimePoint time = begin; time <= end; time += session.tick) {
        const auto of_a = a.at(time);
        const auto of_b = b.at(time);
        for (const auto& [side, reading] :
             {std::pair{a_is_left ? 0U : 1U, &of_a}, std::pair{a_is_left ? 1U : 0U, &of_b}}) {
            trace.sides[side].push_back(reading->sample);
            auto& further = trace.further[side];
            further.insert(further.end(), reading->further.begin(), reading->further.end());
        }
        if (of_a.is_bridged || of_b.is_bridged) ++bridged;
    }
    const base::TimePoint start =
        a_is_left ? session.a.terms.start : session.clock.to_a(session.b.terms.start);
    trace.begin = begin - start;
    const auto samples = static_cast<base::Duration::rep>(trace.sides[0].size());
    const base::Duration length = hands_on(session.a.terms.length);
    if (length > base::Duration{0}) {
        trace.overlap = std::min(1.0, base::to_seconds((samples - bridged) * session.tick) /
                                          base::to_seconds(length));
    }
    return trace;
}

} // namespace hapnet::lab::records
