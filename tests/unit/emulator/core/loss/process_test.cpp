// SPDX-FileCopyrightText: 2026 The Hapnet authors
// SPDX-License-Identifier: MIT
#include "emulator/core/loss/process.hpp"

#include "emulator/core/loss/trace.hpp"
#include "tests/unit/emulator/core/loss/judging.hpp"

#include <algorithm>
#include <chrono>
#include <gtest/gtest.h>
#include <memory>
#include <vector>

namespace hapnet::emulator {

namespace {

using namespace std::chrono_literals;
using namespace base::literals; // NOLINT(google-build-using-namespace): literals only
using test::losses;
using test::packet;

std::vector<LossLaw> one_of_each()
{
    const auto trace = std::make_shared<const LossTrace>(parse_loss_trace("0110 0010").value());
    return {RandomLoss{30_percent},
            BlockLoss{93, 100},
            PeriodicLoss{7, 3},
            Burst{4, 17},
            TimedBurst{20ms, 100ms},
            TimedBurst{5U, 50ms},
            Gilbert{10_percent, 5.0},
            GilbertElliott{1_percent, 10_percent, 2_percent, 80_percent},
            TimedGilbertElliott{100ms, 20ms, 0_percent, 100_percent},
            FourState{5_percent, 20.0, 80_percent, 1_percent},
            ListedLoss{{2, 3, 5, 7, 5000}},
            PatternLoss{{true, false, false}},
            TraceLoss{"losses.txt", trace},
            Outage{{{10ms, 20ms}, {3s, 4s}}}};
}

base::RandomStream stream() { return base::Seed{42}.stream("up/loss"); }

} // namespace

TEST(LossProcess, NamesEveryLawAsInProfiles)
{
    std::string names;
    for (const LossLaw& law : one_of_each()) names += std::string{name_of(law)} + " ";
    EXPECT_EQ(names, "random k-of-n every burst timed-burst timed-burst gilbert gilbert-elliott "
                     "timed-gilbert-elliott four-state list pattern trace outage ");
}

TEST(LossProcess, SaysWhichLawTookADatagram)
{
    const std::vector<DropCause> causes{
        DropCause::random_loss,     DropCause::block_loss,      DropCause::periodic_loss,
        DropCause::burst_loss,      DropCause::burst_loss,      DropCause::burst_loss,
        DropCause::gilbert_elliott, DropCause::gilbert_elliott, DropCause::gilbert_elliott,
        DropCause::four_state,      DropCause::listed_loss,     DropCause::pattern_loss,
        DropCause::trace_loss,      DropCause::outage};
    const auto laws = one_of_each();
    for (std::size_t i = 0; i < laws.size(); ++i) {
        LossProcess process{laws[i], stream()};
        std::optional<DropCause> cause;
        for (std::uint64_t n = 0; !cause && n < 1000; ++n)
            cause = process.on_packet(packet(n)).cause;
        EXPECT_EQ(cause, causes[i]) << name_of(laws[i]);
    }
}

TEST(LossProcess, JudgesEquallyForTheSameStream)
{
    for (const LossLaw& law : one_of_each()) {
        EXPECT_EQ(losses(law, 3000), losses(law, 3000)) << name_of(law);
    }
}

TEST(LossProcess, ChangedToItsOwnLawAtAnyTimeJudgesAsIfNothingHadHappened)
{
    for (const LossLaw& law : one_of_each()) {
        LossProcess still{law, stream()};
        LossProcess changed{law, stream()};
        for (std::uint64_t n = 0; n < 6000; ++n) {
            ASSERT_EQ(still.on_packet(packet(n)), changed.on_packet(packet(n)))
                << name_of(law) << " " << n;
            changed.change(law);
        }
    }
}

TEST(LossProcess, ChangedToAnotherKindJudgesLikeANewOne)
{
    const LossLaw law = Gilbert{10_percent, 5.0};
    LossProcess changed{RandomLoss{50_percent}, stream()};
    changed.change(law);
    LossProcess fresh{law, stream()};
    EXPECT_EQ(losses(changed, 0, 1000), losses(fresh, 0, 1000));
}

TEST(LossProcess, KeepsTheStateOfAChainThroughAChangeOfItsNumbers)
{
    // Bad and never to leave it: a chain that began anew could be good.
    for (std::uint64_t seed = 0; seed < 20; ++seed) {
        LossProcess process{GilbertElliott{100_percent, 0_percent, 0_percent, 100_percent},
                            base::Seed{seed}.stream("up/loss")};
        EXPECT_EQ(losses(process, 0, 10), "1111111111");
        process.change(GilbertElliott{1_percent, 0_percent, 0_percent, 100_percent});
        EXPECT_EQ(losses(process, 10, 10), "1111111111");
    }
}

TEST(RandomLoss, OfMoreTakesWhatItTookBeforeAndMore)
{
    const auto few = losses(RandomLoss{10_percent}, 5000);
    const auto many = losses(RandomLoss{60_percent}, 5000);
    for (std::size_t i = 0; i < few.size(); ++i) EXPECT_TRUE(many[i] == '1' || few[i] == '0');
}

TEST(BlockLoss, LosesExactlyItsNumberOfEveryBlock)
{
    for (const BlockLoss law : {BlockLoss{93, 100}, BlockLoss{1, 7}, BlockLoss{5, 5}}) {
        const auto text = losses(law, std::uint64_t{50} * law.of);
        for (auto begin = text.begin(); begin != text.end(); begin += law.of) {
            EXPECT_EQ(std::count(begin, begin + law.of, '1'), law.lost);
        }
    }
}

TEST(BlockLoss, FinishesTheBlockThatItHasBegunByTheNewNumber)
{
    LossProcess process{BlockLoss{10, 10}, stream()};
    EXPECT_EQ(losses(process, 0, 4), "1111");
    process.change(BlockLoss{4, 10});
    EXPECT_EQ(losses(process, 4, 6), "000000");
    const auto next = losses(process, 10, 10);
    EXPECT_EQ(std::count(next.begin(), next.end(), '1'), 4);
}

TEST(PeriodicLoss, TakesTheNumbersOfItsPhase)
{
    EXPECT_EQ(losses(PeriodicLoss{4, 0}, 10), "1000100010");
    EXPECT_EQ(losses(PeriodicLoss{4, 3}, 10), "0001000100");
}

TEST(Burst, BeginsAtItsPhaseInEveryPeriod)
{
    EXPECT_EQ(losses(Burst{2, 5, 0}, 12), "110001100011");
    EXPECT_EQ(losses(Burst{2, 5, 4}, 12), "100011000110");
}

TEST(TimedBurst, OfATimeTakesWhatArrivesInIt)
{
    EXPECT_EQ(losses(TimedBurst{2ms, 5ms, 0ms}, 12), "110001100011");
    EXPECT_EQ(losses(TimedBurst{2ms, 5ms, 4ms}, 12), "100011000110");
    EXPECT_EQ(losses(TimedBurst{2ms + 1ns, 5ms, 0ms}, 12), "111001110011");
}

TEST(TimedBurst, OfACountTakesTheFirstOfEveryPeriodHoweverSlowTheyCome)
{
    EXPECT_EQ(losses(TimedBurst{2U, 5ms, 0ms}, 12), "110001100011");
    EXPECT_EQ(losses(TimedBurst{2U, 5ms, 3ms}, 12), "000110001100");
    LossProcess process{TimedBurst{2U, 5ms, 0ms}, stream()};
    std::string text;
    for (std::uint64_t n = 0; n < 6; ++n) {
        text += process.on_packet(packet(n, 6ms)).cause ? '1' : '0';
    }
    EXPECT_EQ(text, "111111");
}

TEST(Gilbert, IsTheGilbertElliottChainWithItsShareAndMeanBurst)
{
    // P = 10 %, L = 5: r = 1/5, p = 0.1 / (0.9 * 5).
    const auto p = base::Probability::from_fraction(0.1 / (0.9 * 5.0)).value();
    LossProcess gilbert{Gilbert{10_percent, 5.0}, stream()};
    LossProcess elliott{GilbertElliott{p, 20_percent, 0_percent, 100_percent}, stream()};
    EXPECT_EQ(losses(gilbert, 0, 5000), losses(elliott, 0, 5000));
}

TEST(TimedGilbertElliott, StaysAsItIsForDatagramsOfTheSameMoment)
{
    const TimedGilbertElliott law{1ms, 1ms, 0_percent, 100_percent};
    LossProcess process{law, stream()};
    auto first = LossState::none; // of its moment
    for (std::uint64_t n = 0; n < 100; ++n) {
        const auto at = 1ms * static_cast<int>(n / 10);
        const auto state = process.on_packet({n, 96, at}).state;
        if (n % 10 == 0) first = state;
        EXPECT_EQ(state, first);
    }
}

TEST(FourState, IsLostInItsLostStatesAndNeverTwiceInAGap)
{
    LossProcess process{FourState{30_percent, 10.0, 60_percent, 20_percent}, stream()};
    LossState last = LossState::none;
    for (std::uint64_t n = 0; n < 5000; ++n) {
        const auto [cause, state] = process.on_packet(packet(n));
        EXPECT_EQ(cause.has_value(),
                  state == LossState::lost_in_burst || state == LossState::lost_in_gap);
        if (last == LossState::lost_in_gap) {
            EXPECT_EQ(state, LossState::received_in_gap);
        }
        last = state;
    }
}

TEST(ListedLoss, TakesItsNumbersAndNoOthers)
{
    EXPECT_EQ(losses(ListedLoss{{0, 3, 4, 9}}, 12), "100110000100");
    LossProcess late{ListedLoss{{0, 3, 4, 9}}, stream()};
    EXPECT_EQ(losses(late, 4, 6), "100001");
}

TEST(PatternLoss, RepeatsItsPattern)
{
    EXPECT_EQ(losses(PatternLoss{parse_pattern("0010").value()}, 10), "0010001000");
}

TEST(TraceLoss, BeginsAgainAtItsEnd)
{
    const auto trace = std::make_shared<const LossTrace>(parse_loss_trace("110").value());
    EXPECT_EQ(losses(TraceLoss{"", trace}, 8), "11011011");
}

TEST(TraceLoss, IsEqualWhenItsFileAndItsContentsAre)
{
    const auto made = [](const char* text) {
        return std::make_shared<const LossTrace>(parse_loss_trace(text).value());
    };
    EXPECT_EQ((TraceLoss{"a", made("110")}), (TraceLoss{"a", made("1 1\n0")}));
    EXPECT_NE((TraceLoss{"a", made("110")}), (TraceLoss{"a", made("111")}));
    EXPECT_NE((TraceLoss{"a", made("110")}), (TraceLoss{"b", made("110")}));
}

TEST(Outage, TakesWhatArrivesInItsWindowsAndNotAtTheirEnds)
{
    EXPECT_EQ(losses(Outage{{{1ms, 3ms}, {3ms, 4ms}, {6ms, 6ms + 1ns}}}, 8), "01110010");
}

} // namespace hapnet::emulator
