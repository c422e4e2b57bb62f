// SPDX-FileCopyrightText: 2026 The Hapnet authors
// SPDX-License-Identifier: MIT
#include "emulator/core/pipeline.hpp"

#include "emulator/core/conditions.hpp"

#include <chrono>
#include <gtest/gtest.h>

namespace hapnet::emulator {

namespace {

using namespace std::chrono_literals;
using namespace base::literals; // NOLINT(google-build-using-namespace): literals only

const base::Seed seed{42};

} // namespace

TEST(Pipeline, ForwardsAtOnceWhenEmpty)
{
    EXPECT_EQ(Pipeline{}.on_packet(0), Verdict{Deliver{0ns}});
}

TEST(Pipeline, AddsDelays)
{
    const Pipeline pipeline{{ConstantDelay{100ms}, ConstantDelay{60ms}}};
    EXPECT_EQ(pipeline.on_packet(0), Verdict{Deliver{160ms}});
}

TEST(Pipeline, TakesTheFirstDropAsFinal)
{
    const Pipeline pipeline{{RandomLoss{100_percent, seed.stream("up/random-loss")},
                             BurstLoss{{1, 1}, seed.stream("up/burst-loss")}}};
    EXPECT_EQ(pipeline.on_packet(0), Verdict{Drop{DropCause::random_loss}});
}

TEST(Pipeline, CountsANegativeTotalAsZero)
{
    const UniformJitter jitter{1s, seed.stream("up/jitter")};
    const Pipeline pipeline{{jitter}};
    for (std::uint64_t number = 0; number < 100; ++number) {
        const auto drawn = std::get<Deliver>(jitter.on_packet(number)).after;
        const auto total = std::get<Deliver>(pipeline.on_packet(number)).after;
        EXPECT_EQ(total, drawn < 0ns ? 0ns : drawn);
    }
}

TEST(Pipeline, OfDefaultConditionsForwardsAtOnce)
{
    EXPECT_EQ(pipeline_of({}, seed, Direction::up).on_packet(5), Verdict{Deliver{0ns}});
}

TEST(Pipeline, LosesAtRandomBeforeInBurstsSoThatTheCauseIsTold)
{
    const Conditions conditions{.loss = 100_percent, .burst_loss = Burst{1, 1}};
    EXPECT_EQ(pipeline_of(conditions, seed, Direction::up).on_packet(0),
              Verdict{Drop{DropCause::random_loss}});
}

TEST(Pipeline, DrawsFromStreamsNamedByDirectionAndStage)
{
    const Conditions conditions{.loss = 50_percent, .delay = 1s, .jitter = 1s};
    const auto pipeline = pipeline_of(conditions, seed, Direction::down);
    const RandomLoss loss{50_percent, seed.stream("down/random-loss")};
    const UniformJitter jitter{1s, seed.stream("down/jitter")};
    for (std::uint64_t number = 0; number < 100; ++number) {
        const bool lost = std::holds_alternative<Drop>(loss.on_packet(number));
        const auto after = 1s + std::get<Deliver>(jitter.on_packet(number)).after;
        EXPECT_EQ(pipeline.on_packet(number),
                  lost ? Verdict{Drop{DropCause::random_loss}} : Verdict{Deliver{after}});
    }
}

TEST(RandomLoss, LosesNothingAtZeroAndEverythingAtOne)
{
    const RandomLoss never{0_percent, seed.stream("up/random-loss")};
    const RandomLoss always{100_percent, seed.stream("up/random-loss")};
    for (std::uint64_t number = 0; number < 10'000; ++number) {
        EXPECT_TRUE(std::holds_alternative<Deliver>(never.on_packet(number)));
        EXPECT_TRUE(std::holds_alternative<Drop>(always.on_packet(number)));
    }
}

TEST(BurstLoss, LosesEverythingWhenTheBurstFillsItsPeriod)
{
    const BurstLoss burst{{5, 5}, seed.stream("up/burst-loss")};
    for (std::uint64_t number = 0; number < 20; ++number) {
        EXPECT_EQ(burst.on_packet(number), Verdict{Drop{DropCause::burst_loss}});
    }
}

TEST(Conditions, ReadTheOrderByName)
{
    EXPECT_EQ(parse_order("keep"), Order::keep);
    EXPECT_EQ(parse_order("free"), Order::free);
    EXPECT_FALSE(parse_order("sorted"));
    EXPECT_FALSE(parse_order(""));
}

TEST(Conditions, ReadBurstsThatTheyPrint)
{
    EXPECT_EQ(parse_burst("40/100"), (Burst{40, 100}));
    EXPECT_EQ(parse_burst(to_text(Burst{40, 100})), (Burst{40, 100}));
    EXPECT_EQ(parse_burst("1/1"), (Burst{1, 1}));
    EXPECT_EQ(parse_burst("0"), std::nullopt);
}

TEST(Conditions, RefuseBurstsThatMakeNoSense)
{
    for (const char* text : {"", "/", "40", "40/", "/100", "0/100", "101/100", "40/0", "-1/100",
                             "40/100/3", "4e1/100", "40 /100", "99999999999/99999999999"}) {
        EXPECT_FALSE(parse_burst(text)) << text;
    }
}

TEST(DropCauses, AllHaveNamesOfTheirOwn)
{
    for (std::size_t i = 0; i < drop_causes.size(); ++i) {
        EXPECT_EQ(static_cast<std::size_t>(drop_causes[i]), i);
        for (std::size_t j = 0; j < i; ++j) {
            EXPECT_NE(to_text(drop_causes[i]), to_text(drop_causes[j]));
        }
    }
}

} // namespace hapnet::emulator
