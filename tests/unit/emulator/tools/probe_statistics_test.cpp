// SPDX-FileCopyrightText: 2026 The Hapnet authors
// SPDX-License-Identifier: MIT
#include "emulator/tools/probe_statistics.hpp"

#include <chrono>
#include <gtest/gtest.h>
#include <vector>

namespace hapnet::emulator::tools {
namespace {

using namespace std::chrono_literals;

constexpr base::TimePoint began{100s};
constexpr std::uint64_t here = 5; // this boot

/// A question a second and a program that answers after 1 ms, with a clock that is `offset` ahead.
class Asking {
public:
    explicit Asking(base::Duration offset = 0ms, std::uint64_t boot = here)
        : offset_{offset}, boot_{boot}
    {}

    void ask(std::size_t count)
    {
        for (std::size_t i = 0; i < count; ++i) {
            questions_.push_back(
                statistics.next_question(began + std::chrono::seconds{questions_.size()}));
        }
    }

    /// The answer to a question, by these delays.
    std::optional<ProbeReply> answer(std::size_t sequence, base::Duration there,
                                     base::Duration back, std::uint64_t heard)
    {
        ProbeMessage message = questions_.at(sequence);
        message.is_answer = true;
        message.received = message.sent + there + offset_;
        message.answered = message.received + 1ms;
        message.heard = heard;
        message.boot = boot_;
        return statistics.on_answer(message, message.sent + there + 1ms + back);
    }

    ProbeStatistics statistics{77, here};

private:
    base::Duration offset_;
    std::uint64_t boot_;
    std::vector<ProbeMessage> questions_;
};

TEST(ProbeStatistics, TellEachWayByItselfWhereTheClocksAreOne)
{
    Asking asking;
    asking.ask(4);
    for (std::size_t i = 0; i < 4; ++i) {
        const auto reply = asking.answer(i, 80ms + i * 1ms, 20ms, i + 1);
        ASSERT_TRUE(reply);
        EXPECT_EQ(reply->round_trip, 100ms + i * 1ms); // without the answering program's 1 ms
        EXPECT_EQ(reply->there, 80ms + i * 1ms);
        EXPECT_EQ(reply->back, 20ms);
    }
    const auto summary = asking.statistics.summary();
    EXPECT_TRUE(summary.clocks_are_one);
    ASSERT_TRUE(summary.there.delay && summary.back.delay && summary.there.ipdv);
    EXPECT_EQ(summary.there.delay->min, 80ms);
    EXPECT_EQ(summary.there.delay->p50, 81ms);
    EXPECT_EQ(summary.there.delay->p99, 83ms);
    EXPECT_EQ(summary.there.delay->mean, 81ms + 500us);
    EXPECT_EQ(summary.there.ipdv->max, 1ms);
    EXPECT_EQ(summary.back.ipdv->max, 0ms);
    EXPECT_TRUE(asking.statistics.all_answered());
}

TEST(ProbeStatistics, KnowOnlyRoundTripsAndVariationsOfTwoClocks)
{
    Asking asking{3h, /*boot*/ 6};
    asking.ask(2);
    EXPECT_EQ(asking.answer(0, 80ms, 20ms, 1)->round_trip, 100ms);
    EXPECT_EQ(asking.answer(1, 85ms, 20ms, 2)->round_trip, 105ms);
    const auto summary = asking.statistics.summary();
    EXPECT_FALSE(summary.clocks_are_one);
    EXPECT_FALSE(summary.there.delay);
    EXPECT_EQ(summary.round_trip.delay->max, 105ms);
    EXPECT_EQ(summary.there.ipdv->p50, 5ms);
    EXPECT_EQ(summary.back.ipdv->p50, 0ms);
    EXPECT_EQ(asking.statistics.csv(),
              "sequence,sent_s,round_trip_ms,there_ms,back_ms,answers\n"
              "0,0.000000000,100.000000,,,1\n1,1.000000000,105.000000,,,1\n");
}

TEST(ProbeStatistics, DoNotTakeClocksForOneThatContradictEachOther)
{
    Asking asking{-3h};
    asking.ask(1);
    EXPECT_EQ(asking.answer(0, 80ms, 20ms, 1)->round_trip, 100ms);
    EXPECT_FALSE(asking.statistics.clocks_are_one());
}

TEST(ProbeStatistics, TellOnWhichWayQuestionsWereLost)
{
    Asking asking;
    asking.ask(10);
    asking.answer(0, 10ms, 10ms, 1);
    asking.answer(3, 10ms, 10ms, 3); // one of 1 and 2 arrived
    asking.answer(6, 10ms, 10ms, 6); // 4 and 5 were heard, their answers are lost
    const auto summary = asking.statistics.summary();
    EXPECT_EQ(summary.sent, 10U);
    EXPECT_EQ(summary.answered, 3U);
    EXPECT_EQ(summary.there.lost, 1U);
    EXPECT_EQ(summary.back.lost, 3U);
    EXPECT_EQ(summary.unknown, 3U);   // 7, 8 and 9
    EXPECT_FALSE(summary.there.ipdv); // no two in a row
}

TEST(ProbeStatistics, CountCopiesAndWhatCameOutOfOrder)
{
    Asking asking;
    asking.ask(3);
    EXPECT_FALSE(asking.answer(2, 10ms, 10ms, 1)->is_copy);
    EXPECT_FALSE(asking.answer(0, 10ms, 10ms, 2)->is_copy);
    EXPECT_TRUE(asking.answer(0, 10ms, 15ms, 2)->is_copy);
    const auto summary = asking.statistics.summary();
    EXPECT_EQ(summary.reordered, 1U);
    EXPECT_EQ(summary.copies, 1U);
    EXPECT_EQ(summary.answered, 2U);
    EXPECT_EQ(summary.round_trip.delay->max, 20ms); // a copy does not count
}

TEST(ProbeStatistics, LeaveOutWhatAnswersNoneOfTheirQuestions)
{
    Asking asking;
    asking.ask(1);
    ProbeMessage message{.is_answer = true, .session = 77, .sequence = 0, .sent = began};
    message.boot = here;
    for (auto change :
         {+[](ProbeMessage& m) { m.is_answer = false; }, +[](ProbeMessage& m) { m.session = 78; },
          +[](ProbeMessage& m) { m.sequence = 1; }, +[](ProbeMessage& m) { m.sent += 1ns; }}) {
        ProbeMessage changed = message;
        change(changed);
        EXPECT_FALSE(asking.statistics.on_answer(changed, began + 1s));
    }
    EXPECT_FALSE(asking.statistics.all_answered());
    EXPECT_EQ(asking.statistics.summary().unknown, 1U);
}

} // namespace
} // namespace hapnet::emulator::tools
