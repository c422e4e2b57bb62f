// SPDX-FileCopyrightText: 2026 The Hapnet authors
// SPDX-License-Identifier: MIT
#include "lab/records/path_stretches.hpp"

#include "tests/unit/lab/records/recording.hpp"

#include <cmath>
#include <functional>

namespace hapnet::lab::records {
namespace {

/// Two records of a session in which A sends message k k ms after the start.
struct TwoRecords {
    explicit TwoRecords(base::Duration length)
    {
        a.session(length);
        b.session(length);
    }

    PathsOverTime over_time()
    {
        const auto session = common_session(a.content(), b.content());
        EXPECT_TRUE(session);
        return session ? paths_over_time(*session) : PathsOverTime{};
    }

    /// B gets messages 1 to `count`, except the lost ones, after their delays.
    void send(std::uint32_t count, const std::function<bool(std::uint32_t)>& is_lost,
              const std::function<base::Duration(std::uint32_t)>& delay)
    {
        for (std::uint32_t k = 1; k <= count; ++k) {
            const auto sent = start + k * 1ms;
            if (!is_lost(k)) b.message(k, sent, sent + delay(k));
        }
    }

    Recording a{1};
    Recording b{2};
};

bool none(std::uint32_t) { return false; }

TEST(PathStretches, AreAsLongAsHoldsAHundredOfThemAndFiftyMessagesEach)
{
    const auto stretch_of = [](base::Duration length, std::uint32_t count) {
        TwoRecords records{length};
        records.send(count, none, [](std::uint32_t) { return 10ms; });
        return records.over_time().stretch_s;
    };
    EXPECT_EQ(stretch_of(5s, 5000), 0.1) << "a hundredth is 0.05 s";
    EXPECT_EQ(stretch_of(30s, 30'000), 0.5) << "a hundredth is 0.3 s";
    EXPECT_EQ(stretch_of(100s, 100'000), 1.0);
    EXPECT_EQ(stretch_of(10s, 100), 5.0) << "50 messages of 10 a second";
    EXPECT_EQ(stretch_of(10s, 0), 0.1);
}

TEST(PathStretches, HaveTheDelaysOfTheMessagesThatWereSentInThem)
{
    TwoRecords records{1s};
    // In the i-th tenth of a second the delays are 10 i + 1 to 10 i + 5 ms, equally often.
    records.send(999, none, [](std::uint32_t k) { return (k / 100) * 10ms + (1 + k % 5) * 1ms; });
    const PathsOverTime paths = records.over_time();
    ASSERT_EQ(paths.a_to_b.stretches.size(), 10U);
    for (std::size_t i = 0; i < 10; ++i) {
        const PathStretch& stretch = paths.a_to_b.stretches[i];
        const auto tenth = static_cast<double>(i);
        EXPECT_DOUBLE_EQ(stretch.from_s, 0.1 * tenth);
        EXPECT_DOUBLE_EQ(stretch.to_s, 0.1 * (tenth + 1.0));
        EXPECT_EQ(stretch.sent, i == 0 ? 99U : 100U);
        EXPECT_EQ(stretch.loss(), 0.0);
        ASSERT_TRUE(stretch.delay_ms);
        EXPECT_DOUBLE_EQ(stretch.delay_ms->low, 10.0 * tenth + 1.0);
        EXPECT_DOUBLE_EQ(stretch.delay_ms->median, 10.0 * tenth + 3.0);
        EXPECT_DOUBLE_EQ(stretch.delay_ms->high, 10.0 * tenth + 5.0);
    }
    EXPECT_EQ(paths.a_to_b.delays_ms.size(), 999U);
    EXPECT_TRUE(paths.b_to_a.stretches.empty());
}

TEST(PathStretches, CountALostMessageWhereItWasSent)
{
    TwoRecords records{1s};
    // Every fourth message from 200 ms on, and all of 400 to 599 ms.
    const auto is_lost = [](std::uint32_t k) {
        return (k >= 200 && k % 4 == 0) || (k >= 400 && k < 600);
    };
    records.send(999, is_lost, [](std::uint32_t) { return 7ms; });
    const auto stretches = records.over_time().a_to_b.stretches;
    ASSERT_EQ(stretches.size(), 10U);
    const std::vector<double> expected{0, 0, 0.25, 0.25, 1, 1, 0.25, 0.25, 0.25, 0.25};
    for (std::size_t i = 0; i < 10; ++i) {
        EXPECT_EQ(stretches[i].sent, i == 0 ? 99U : 100U) << i;
        ASSERT_TRUE(stretches[i].loss()) << i;
        EXPECT_DOUBLE_EQ(*stretches[i].loss(), expected[i]) << i;
        EXPECT_EQ(stretches[i].delay_ms.has_value(), expected[i] < 1.0) << i;
    }
}

TEST(PathStretches, LoseAsManyAsTheWholePath)
{
    TwoRecords records{2s};
    const auto is_lost = [](std::uint32_t k) { return k * k % 7 < 3; };
    records.send(1999, is_lost, [](std::uint32_t) { return 7ms; });
    std::uint64_t sent = 0, received = 0;
    for (const PathStretch& one : records.over_time().a_to_b.stretches) {
        sent += one.sent;
        received += one.received;
    }
    const Path path = analysis_of(records.a, records.b).a_to_b;
    EXPECT_EQ(sent, path.arrived.sent);
    EXPECT_EQ(received, path.arrived.received);
}

TEST(PathStretches, KnowFromTheSenderWhenTheFirstMessageWasSentThoughItWasLost)
{
    TwoRecords records{1s};
    const auto numbered = [](record::TickRow& row, base::Duration time) {
        row.sent_sequence = static_cast<std::uint32_t>(time / 1ms);
    };
    records.a.ticks(0s, 1s, Phase::running, numbered);
    records.send(
        999, [](std::uint32_t k) { return k < 250; }, [](std::uint32_t) { return 7ms; });
    const auto stretches = records.over_time().a_to_b.stretches;
    ASSERT_EQ(stretches.size(), 10U);
    EXPECT_EQ(stretches[0].loss(), 1.0);
    EXPECT_EQ(stretches[1].sent, 100U);
    EXPECT_EQ(stretches[1].loss(), 1.0);
    EXPECT_EQ(stretches[2].loss(), 0.5);
    EXPECT_EQ(stretches[3].loss(), 0.0);
}

TEST(PathStretches, LeaveOutWhatWasSentBeforeTheStart)
{
    TwoRecords records{1s};
    records.b.message(1, start - 5ms, start + 2ms).message(2, start + 5ms, start + 12ms);
    const PathsOverTime paths = records.over_time();
    ASSERT_EQ(paths.a_to_b.stretches.size(), 1U);
    EXPECT_EQ(paths.a_to_b.stretches[0].sent, 1U);
    EXPECT_EQ(paths.a_to_b.delays_ms, std::vector<double>{7.0});
}

TEST(PathStretches, CountACopyOnceAndAReorderedMessageWhereItWasSent)
{
    TwoRecords records{1s};
    records.b.message(1, start + 1ms, start + 20ms).message(3, start + 3ms, start + 22ms);
    records.b.message(3, start + 3ms, start + 23ms).message(2, start + 2ms, start + 40ms);
    const PathsOverTime paths = records.over_time();
    ASSERT_EQ(paths.a_to_b.stretches.size(), 1U);
    EXPECT_EQ(paths.a_to_b.stretches[0].sent, 3U);
    EXPECT_EQ(paths.a_to_b.stretches[0].received, 3U);
    EXPECT_DOUBLE_EQ(paths.a_to_b.stretches[0].delay_ms->high, 38.0);
}

TEST(PathStretches, AreOnTheClockOfAInBothDirections)
{
    Recording a{1, "boot of A"};
    Recording b{2, "boot of B"};
    a.session({.start = start, .length = 1s, .remote_offset = 7s, .session = 1});
    b.session({.start = start + 7s, .length = 1s, .remote_offset = -7s, .session = 1});
    b.message(1, start + 250ms, start + 7s + 410ms);
    a.message(1, start + 7s + 350ms, start + 430ms);
    const auto session = common_session(a.content(), b.content());
    ASSERT_TRUE(session);
    const PathsOverTime paths = paths_over_time(*session);
    ASSERT_EQ(paths.a_to_b.stretches.size(), 3U);
    EXPECT_DOUBLE_EQ(paths.a_to_b.stretches[2].delay_ms->median, 160.0);
    ASSERT_EQ(paths.b_to_a.stretches.size(), 4U);
    EXPECT_DOUBLE_EQ(paths.b_to_a.stretches[3].delay_ms->median, 80.0);
}

TEST(PathStretches, AreFewWhateverARecordSays)
{
    TwoRecords records{100'000h};
    records.b.message(0xffff'ffffU, start + 50h, start + 51h);
    records.b.message(1, start - 1s, start);
    const PathsOverTime paths = records.over_time();
    EXPECT_LE(paths.a_to_b.stretches.size(), 100U);
    std::uint64_t sent = 0;
    for (const PathStretch& one : paths.a_to_b.stretches) sent += one.sent;
    EXPECT_LE(sent, 0xffff'ffffU);
    EXPECT_GE(sent, 0xffff'0000U) << "one second of 50 hours lies before the start";
}

} // namespace
} // namespace hapnet::lab::records
