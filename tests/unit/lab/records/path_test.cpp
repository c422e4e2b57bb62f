// SPDX-FileCopyrightText: 2026 The Hapnet authors
// SPDX-License-Identifier: MIT
#include "lab/records/path.hpp"

#include "tests/unit/lab/records/recording.hpp"

#include <initializer_list>

namespace hapnet::lab::records {
namespace {

/// B's record of these sequences in this order, each 10 ms after it was sent.
Path after_arrivals(std::initializer_list<std::uint32_t> sequences)
{
    Recording a{1};
    Recording b{2};
    a.session(1s);
    b.session(1s);
    for (const std::uint32_t sequence : sequences) {
        b.message(sequence, start + sequence * 1ms, start + sequence * 1ms + 10ms);
    }
    return analysis_of(a, b).a_to_b;
}

/// B's record of messages with these delays.
Path after_delays(std::initializer_list<base::Duration> delays)
{
    Recording a{1};
    Recording b{2};
    a.session(1s);
    b.session(1s);
    std::uint32_t sequence = 0;
    for (const base::Duration delay : delays) {
        const auto sent = start + ++sequence * 1ms;
        b.message(sequence, sent, sent + delay);
    }
    return analysis_of(a, b).a_to_b;
}

TEST(Path, LosesWhatIsMissingUpToTheHighestSequenceReceived)
{
    const Path path = after_arrivals({1, 2, 4, 5, 8});
    EXPECT_EQ(path.arrived.received, 5U);
    EXPECT_EQ(path.loss, 3.0 / 8.0);
    EXPECT_EQ(path.lost(), 3U);
    EXPECT_EQ(path.in_flight, 0U) << "the record of A has no ticks";
}

TEST(Path, CountsTheSecondCopyAsADuplicateAndNothingElse)
{
    const Path path = after_arrivals({1, 2, 2, 3, 1});
    EXPECT_EQ(path.arrived.received, 3U);
    EXPECT_EQ(path.arrived.duplicates, 2U);
    EXPECT_EQ(path.arrived.reordered, 0U);
    EXPECT_EQ(path.loss, 0.0);
}

// RFC 4737: three packets arrive after packets with higher numbers.
TEST(Path, CountsAsReorderedWhatComesAfterAHigherSequence)
{
    const Path path = after_arrivals({1, 2, 3, 7, 8, 9, 10, 4, 5, 6, 11});
    EXPECT_EQ(path.arrived.reordered, 3U);
    EXPECT_EQ(path.loss, 0.0);
}

TEST(Path, HasNeitherLossNorDelayWhenNothingCame)
{
    const Path path = after_arrivals({});
    EXPECT_EQ(path.arrived.received, 0U);
    EXPECT_FALSE(path.loss);
    EXPECT_FALSE(path.delay);
    EXPECT_FALSE(path.jitter);
}

TEST(Path, DelayRunsFromTheSendersStampToTheKernelsStamp)
{
    const Path path = after_delays({10ms, 30ms, 20ms});
    EXPECT_EQ(path.delay, (base::Quantiles{20ms, 30ms, 30ms, 30ms, 30ms}));
}

TEST(Path, JitterIsTheDifferenceOfTheDelaysOfMessagesReceivedOneAfterAnother)
{
    const Path path = after_delays({10ms, 13ms, 11ms, 12ms});
    EXPECT_EQ(path.jitter, (base::Quantiles{2ms, 3ms, 3ms, 3ms, 3ms}));
}

TEST(Path, JitterNeedsTwoMessages) { EXPECT_FALSE(after_delays({10ms}).jitter); }

TEST(Path, DelaysBothWaysAreRightWhenTheClocksAreApart)
{
    Recording a{1, "boot of A"};
    Recording b{2, "boot of B"};
    a.session({.start = start, .length = 1s, .remote_offset = 7s, .session = 1});
    b.session({.start = start + 7s, .length = 1s, .remote_offset = -7s, .session = 1});
    b.message(1, start, start + 7s + 160ms);
    a.message(1, start + 7s, start + 80ms);
    const Analysis analysis = analysis_of(a, b);
    EXPECT_EQ(analysis.a_to_b.delay.value().max, 160ms);
    EXPECT_EQ(analysis.b_to_a.delay.value().max, 80ms);
}

TEST(Path, SkipsMessagesOfAnotherSessionAndWhatIsNoMessage)
{
    Recording a{1};
    Recording b{2};
    a.session(1s);
    b.session({.start = start, .length = 1s, .session = 8});
    b.message(900, start, start);
    b.session(1s).message(1, start, start + 1ms);
    b.content().messages.push_back({.bytes = std::vector<std::byte>(70)});
    const Path path = analysis_of(a, b).a_to_b;
    EXPECT_EQ(path.arrived.received, 1U);
    EXPECT_EQ(path.loss, 0.0);
}

/// Sends in every `every`-th tick.
auto sending(std::uint32_t every)
{
    return [every, tick = 0U](record::TickRow& row, base::Duration) mutable {
        if (tick++ % every == 0) row.sent_sequence = 1 + (tick - 1) / every;
    };
}

TEST(Path, KnowsFromTheSenderHowManyAndHowFastItSent)
{
    Recording a{1};
    Recording b{2};
    a.session(1s).ticks(0s, 1s, Phase::running, sending(4));
    b.session(1s).ticks(0s, 1s);
    const Analysis analysis = analysis_of(a, b);
    EXPECT_EQ(analysis.a_to_b.arrived.sent, 250U);
    EXPECT_EQ(analysis.a_to_b.packets_per_s, 250.0);
    EXPECT_EQ(analysis.b_to_a.arrived.sent, 0U);
    EXPECT_FALSE(analysis.b_to_a.packets_per_s);
}

TEST(Path, AccountsForEveryMessageAsReceivedLostOrInFlightAtTheEnd)
{
    Recording a{1};
    Recording b{2};
    a.session(1s).ticks(0s, 1s, Phase::running, sending(4));
    b.session(1s).ticks(0s, 1s);
    for (const std::uint32_t sequence : {1U, 2U, 2U, 5U, 4U, 200U})
        b.message(sequence, start + sequence * 4ms, start + sequence * 4ms + 50ms);
    const Path path = analysis_of(a, b).a_to_b;
    EXPECT_EQ(path.arrived.sent, 250U);
    EXPECT_EQ(path.arrived.received, 5U);
    EXPECT_EQ(path.lost(), 195U);
    EXPECT_EQ(path.in_flight, 50U);
    EXPECT_EQ(analysis_of(a, b).b_to_a.in_flight, 0U);
}

TEST(Path, WasSentWhatCameEvenIfTheSendersRecordEndsEarly)
{
    EXPECT_EQ(after_arrivals({1, 5}).arrived.sent, 5U);
}

} // namespace
} // namespace hapnet::lab::records
