// SPDX-FileCopyrightText: 2026 The Hapnet authors
// SPDX-License-Identifier: MIT
#include "peer/monitor/held_rows.hpp"

#include "proto/record/codec.hpp"

#include <chrono>
#include <cstring>
#include <gtest/gtest.h>
#include <string>
#include <vector>

namespace hapnet::peer::monitor {
namespace {

using namespace std::chrono_literals;

const base::TimePoint begin{100s};

record::TickRow tick(int ms)
{
    record::TickRow row;
    row.tick = static_cast<std::uint64_t>(ms);
    row.due = begin + ms * 1ms;
    return row;
}

record::SessionRow terms(std::uint32_t session, std::uint16_t other)
{
    record::SessionRow row;
    row.start = begin;
    row.length = 30s;
    row.session = session;
    row.other = other;
    row.noted_at = begin;
    return row;
}

std::vector<record::Row> rows_of(const std::string& text)
{
    const record::Layout layout;
    std::vector<record::Row> rows;
    for (std::size_t at = 0; at < text.size();) {
        const auto bytes = layout.bytes_of(static_cast<std::byte>(text[at]));
        record::RowBytes row(bytes.value());
        std::memcpy(row.data(), text.data() + at, row.size());
        rows.push_back(record::decode(row, layout).value());
        at += row.size();
    }
    return rows;
}

TEST(HeldRows, GivesTheRowsSinceATimeAfterWhatHadBeenAgreedBefore)
{
    HeldRows held{10s, {}};
    for (int ms = 0; ms < 5000; ++ms) {
        if (ms == 500) held.add(terms(7, 2));
        if (ms == 600) held.add(terms(7, 3));
        if (ms == 3000) held.add(terms(8, 2));
        if (ms == 4500) held.add(terms(9, 2));
        held.add(tick(ms));
    }
    const auto rows = rows_of(held.since(begin + 4000ms));
    ASSERT_EQ(rows.size(), 2U + 1000U + 1U);
    EXPECT_EQ(std::get<record::SessionRow>(rows[0]).session, 8U) << "the newest of that time";
    EXPECT_EQ(std::get<record::SessionRow>(rows[1]).other, 3U);
    EXPECT_EQ(std::get<record::TickRow>(rows[2]).tick, 4000U);
    EXPECT_EQ(std::get<record::TickRow>(rows.back()).tick, 4999U);
}

TEST(HeldRows, ForgetsTicksBeyondItsSpan)
{
    HeldRows held{1s, {}};
    for (int ms = 0; ms <= 3000; ++ms) held.add(tick(ms));
    const auto rows = rows_of(held.since(begin));
    ASSERT_EQ(rows.size(), 1001U);
    EXPECT_EQ(std::get<record::TickRow>(rows.front()).tick, 2000U);
}

} // namespace
} // namespace hapnet::peer::monitor
