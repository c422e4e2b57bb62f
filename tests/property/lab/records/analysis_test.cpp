// SPDX-FileCopyrightText: 2026 The Hapnet authors
// SPDX-License-Identifier: MIT
#include "lab/records/analysis.hpp"

#include "lab/records/analysis_report.hpp"
#include "lab/records/csv.hpp"
#include "proto/record/fields.hpp"
#include "proto/wire/message.hpp"
#include "tests/property/proto/record/random_fields.hpp"

#include <algorithm>
#include <gtest/gtest.h>

namespace hapnet::lab::records {
namespace {

/// A record with arbitrary contents: times, forces and sequences are random bits. Only the session
/// is one that the other record has, too.
record::Record wild_record(int peer_id, const base::RandomStream& stream, std::uint64_t round)
{
    record::Record wild;
    wild.config = {{"peer_id", peer_id}, {"boot_id", ""}, {"tick_ns", 1'000'000}};
    record::SessionRow session;
    for_each_field(session, record::RandomFields{stream, round});
    session.session = 1;
    wild.sessions.push_back(session);
    wild.ticks_before_session.push_back(0);
    for (std::uint64_t i = 0; i < 20; ++i) {
        record::TickRow tick;
        for_each_field(tick, record::RandomFields{stream, (round << 8U) + 2 * i});
        wild.ticks.push_back(tick);
        record::MessageRow message;
        for_each_field(message, record::RandomFields{stream, (round << 8U) + 2 * i + 1});
        wire::State state;
        state.session = 1;
        state.sequence = static_cast<std::uint32_t>(1 + i % 7);
        state.sent = base::TimePoint{base::Duration{static_cast<std::int64_t>(message.tick >> 4U)}};
        const wire::Datagram datagram = wire::encode(state);
        message.bytes.assign(datagram.bytes().begin(), datagram.bytes().end());
        wild.messages.push_back(message);
    }
    return wild;
}

TEST(Analysis, OfAnyTwoReadableRecordsIsJsonWithoutNanAndCsvOfOneLineForARow)
{
    for (std::uint64_t round = 1; round <= 200; ++round) {
        const auto a = wild_record(1, base::Seed{4}.stream("a"), round);
        const auto b = wild_record(2, base::Seed{4}.stream("b"), round);
        const auto analysis = analyse(a, b);
        ASSERT_TRUE(analysis) << analysis.error().message;
        ASSERT_TRUE(nlohmann::json::accept(to_json(*analysis).dump())) << "round " << round;
        ASSERT_FALSE(to_table(*analysis).empty());
        const auto cells = std::ranges::count(tick_csv_header(), ',');
        for (const record::TickRow& row : a.ticks) {
            ASSERT_EQ(std::ranges::count(csv_line(row, csv_zero(a)), ','), cells);
        }
    }
}

} // namespace
} // namespace hapnet::lab::records
