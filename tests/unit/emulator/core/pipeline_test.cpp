// SPDX-FileCopyrightText: 2026 The Hapnet authors
// SPDX-License-Identifier: MIT
#include "emulator/core/pipeline.hpp"

#include <chrono>
#include <gtest/gtest.h>

namespace hapnet::emulator {

namespace {

using namespace std::chrono_literals;
using namespace base::literals; // NOLINT(google-build-using-namespace): literals only

constexpr base::Seed seed{42};

Fate first_fate(const Conditions& conditions, std::size_t bytes = 100)
{
    return Pipeline{conditions, seed, Direction::up}.on_packet({0, bytes, 0ns});
}

} // namespace

TEST(Pipeline, ForwardsAtOnceWhenNothingIsAskedOfIt) { EXPECT_EQ(first_fate({}), Fate{}); }

TEST(Pipeline, AddsJitterToDelay)
{
    const Conditions conditions{.delay = constant(100ms), .jitter = constant(60ms)};
    EXPECT_EQ(first_fate(conditions), Fate{.delay = 160ms});
}

TEST(Pipeline, CountsANegativeTotalAsZero)
{
    EXPECT_EQ(first_fate({.delay = constant(1ms), .jitter = constant(-2ms)}), Fate{});
}

TEST(Pipeline, TakesTheFirstDropAsFinal)
{
    EXPECT_EQ(first_fate({.loss = {RandomLoss{100_percent}, Burst{1, 1, {}}}}),
              Fate{.drop = DropCause::random_loss});
    EXPECT_EQ(first_fate({.loss = {Burst{1, 1, {}}, RandomLoss{100_percent}}}),
              Fate{.drop = DropCause::burst_loss});
}

TEST(Pipeline, DropsWhatIsLargerThanTheMtuWithItsHeaders)
{
    const Conditions conditions{.mtu = {1500}};
    EXPECT_EQ(first_fate(conditions, 1472), Fate{});
    EXPECT_EQ(first_fate(conditions, 1473), Fate{.drop = DropCause::mtu});
}

TEST(Pipeline, OfAPathWithANameDrawsFromStreamsThatBeginWithIt)
{
    const Conditions conditions{.loss = {RandomLoss{50_percent}}};
    Pipeline pipeline{conditions, seed, Direction::up, "client/7"};
    LossProcess loss{RandomLoss{50_percent}, seed.stream("client/7/up/loss/random")};
    for (std::uint64_t number = 0; number < 100; ++number) {
        const Packet packet{number, 96, 1ms};
        EXPECT_EQ(pipeline.on_packet(packet).drop, loss.on_packet(packet));
    }
}

TEST(Pipeline, DrawsFromStreamsNamedByDirectionAndStage)
{
    const Conditions conditions{
        .loss = {RandomLoss{50_percent}}, .delay = constant(1s), .jitter = uniform(1s)};
    Pipeline pipeline{conditions, seed, Direction::down};
    LossProcess loss{RandomLoss{50_percent}, seed.stream("down/loss/random")};
    DelayProcess jitter{uniform(1s), seed.stream("down/jitter")};
    for (std::uint64_t number = 0; number < 100; ++number) {
        const Packet packet{number, 96, 1ms};
        const auto lost = loss.on_packet(packet);
        const Fate delivered{.delay = 1s + jitter.on_packet(packet)};
        EXPECT_EQ(pipeline.on_packet(packet), lost ? Fate{.drop = *lost} : delivered);
    }
}

TEST(Pipeline, KeepsThePlaceOfALawInItsDrawsWhenAnotherLawIsAddedBeforeIt)
{
    Pipeline alone{{.loss = {Burst{4, 100, {}}}}, seed, Direction::up};
    Pipeline both{{.loss = {RandomLoss{1_percent}, Burst{4, 100, {}}}}, seed, Direction::up};
    for (std::uint64_t number = 0; number < 1000; ++number) {
        const Fate fate = both.on_packet({number, 96, 1ms});
        const Fate expected = alone.on_packet({number, 96, 1ms});
        if (fate.drop != DropCause::random_loss) {
            EXPECT_EQ(fate, expected);
        }
    }
}

TEST(Pipeline, DrawsTwoLawsOfOneKindFromStreamsOfTheirOwn)
{
    const RandomLoss half{50_percent};
    Pipeline pipeline{{.loss = {half, half}}, seed, Direction::up};
    int lost = 0;
    for (std::uint64_t number = 0; number < 1000; ++number) {
        lost += pipeline.on_packet({number, 96, 1ms}).drop ? 1 : 0;
    }
    EXPECT_NEAR(lost, 750, 4 * 13.7); // binomial: sd sqrt(1000 * 0.75 * 0.25)
}

TEST(Pipeline, GoesOnWithTheSameDrawsAfterAChangeOfSomethingElse)
{
    const Conditions before{.loss = {RandomLoss{30_percent}}, .jitter = uniform(5ms)};
    Conditions after = before;
    after.delay = constant(1s);
    Pipeline changed{before, seed, Direction::up};
    Pipeline fresh{after, seed, Direction::up};
    for (std::uint64_t number = 0; number < 200; ++number) {
        if (number == 100) changed.change(after);
        const auto a = changed.on_packet({number, 96, 1ms});
        const auto b = fresh.on_packet({number, 96, 1ms});
        if (number >= 100) {
            EXPECT_EQ(a, b);
        }
    }
}

TEST(Pipeline, TakesUpAndGivesUpLawsOfLoss)
{
    Pipeline pipeline{{}, seed, Direction::up};
    EXPECT_EQ(pipeline.on_packet({0, 1, 0ns}), Fate{});
    pipeline.change({.loss = {RandomLoss{100_percent}}});
    EXPECT_EQ(pipeline.on_packet({1, 1, 0ns}), Fate{.drop = DropCause::random_loss});
    pipeline.change({});
    EXPECT_EQ(pipeline.on_packet({2, 1, 0ns}), Fate{});
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
