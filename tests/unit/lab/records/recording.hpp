// SPDX-FileCopyrightText: 2026 The Hapnet authors
// SPDX-License-Identifier: MIT
#pragma once

#include "lab/records/analysis.hpp"
#include "proto/record/reader.hpp"
#include "proto/wire/message.hpp"

#include <algorithm>
#include <chrono>
#include <cstdint>
#include <gtest/gtest.h>
#include <string>
#include <vector>

namespace hapnet::lab::records {

using namespace std::chrono_literals;
using record::Phase;

inline constexpr base::TimePoint epoch{};
/// T0 of every session below, on A's clock.
inline constexpr base::TimePoint start = epoch + 5s;

/// A record as a peer would leave it behind, written by hand.
class Recording {
public:
    explicit Recording(int peer_id, std::string boot_id = "one boot")
    {
        content_.config = {{"peer_id", peer_id}, {"boot_id", boot_id}, {"tick_ns", 1'000'000}};
    }

    Recording& session(const record::SessionRow& row)
    {
        session_ = row.session;
        content_.sessions.push_back(row);
        content_.ticks_before_session.push_back(content_.ticks.size());
        return *this;
    }
    Recording& session(base::Duration length)
    {
        return session({.start = start, .length = length, .session = 1});
    }

    /// Ticks every millisecond in [from, to); `fill` gets each row and its time since `start`.
    Recording& ticks(base::Duration from, base::Duration to, Phase phase, auto&& fill)
    {
        for (auto time = from; time < to; time += 1ms) {
            record::TickRow row;
            row.due = start + time;
            row.phase = phase;
            fill(row, time);
            content_.ticks.push_back(row);
        }
        return *this;
    }
    Recording& ticks(base::Duration from, base::Duration to, Phase phase = Phase::running)
    {
        return ticks(from, to, phase, [](record::TickRow&, base::Duration) {});
    }

    /// Adds rows of these bodies after each existing tick, and numbers the ticks. `fill` gets each
    /// row and the time of its tick since `start`.
    Recording& bodies(const std::vector<std::uint16_t>& numbers, auto&& fill)
    {
        for (std::size_t i = 0; i < content_.ticks.size(); ++i) {
            content_.ticks[i].tick = i;
            for (const std::uint16_t number : numbers) {
                record::BodyRow row{.tick = i, .body = number};
                fill(row, content_.ticks[i].due - start);
                content_.bodies.push_back(row);
            }
        }
        return *this;
    }

    /// A state message of the newest session.
    Recording& message(std::uint32_t sequence, base::TimePoint sent, base::TimePoint received)
    {
        wire::State state;
        state.session = session_;
        state.sequence = sequence;
        state.sent = sent;
        const wire::Datagram datagram = wire::encode(state);
        record::MessageRow row;
        row.received_at = received;
        row.bytes.assign(datagram.bytes().begin(), datagram.bytes().end());
        content_.messages.push_back(row);
        return *this;
    }

    [[nodiscard]] record::Record& content() { return content_; }

private:
    record::Record content_;
    std::uint32_t session_ = 0;
};

[[nodiscard]] inline Analysis analysis_of(Recording& a, Recording& b)
{
    auto analysis = analyse(a.content(), b.content());
    EXPECT_TRUE(analysis) << analysis.error().message;
    return analysis ? *analysis : Analysis{};
}

/// Puts the cube at x metres.
[[nodiscard]] inline auto cube_at(double x)
{
    return [x](record::TickRow& row, base::Duration) { row.cube = {{x, 0.0, 0.0}}; };
}

} // namespace hapnet::lab::records
