// SPDX-FileCopyrightText: 2026 The Hapnet authors
// SPDX-License-Identifier: MIT
#include "emulator/core/link.hpp"
#include "emulator/core/pipeline.hpp"
#include "emulator/core/regime_chain.hpp"

#include <array>
#include <chrono>
#include <gtest/gtest.h>
#include <vector>

namespace hapnet::emulator::regimes_test {
namespace {

using namespace std::chrono_literals;
using namespace base::literals; // NOLINT(google-build-using-namespace): literals only

constexpr base::Seed seed{42};

Packet packet(std::uint64_t number) { return {number, 100, std::chrono::milliseconds{number}}; }

/// 200 ms good, 100 ms bad, with these conditions.
Regimes changing(Patch good = {}, Patch bad = {})
{
    return {{Regime{"good", 200ms, {}, std::move(good)}, Regime{"bad", 100ms, {}, std::move(bad)}}};
}

Conditions busy()
{
    return {.loss = {RandomLoss{5_percent}, GilbertElliott{2_percent, 20_percent}},
            .corrupt = {3_percent, 2},
            .duplicate = {4_percent, 1ms},
            .delay = constant(20ms),
            .jitter = {NormalLaw{0ms, 3ms}, 50ms},
            .reorder = {1_percent, {3, {}}}};
}

RegimeChain chain_of(const Regimes& regimes, const char* stream = "up/regime")
{
    return {regimes, seed.stream(stream)};
}

TEST(Regimes, ShiftNoOtherStageWhenTheyAreSwitchedOn)
{
    Conditions with = busy();
    with.regimes = changing({}, {.delay = constant(80ms)});
    Pipeline plain{busy(), seed, Direction::up};
    Pipeline changing_one{with, seed, Direction::up};
    std::size_t bad = 0;
    for (std::uint64_t n = 0; n < 20'000; ++n) {
        Fate expected = plain.on_packet(packet(n));
        const Fate fate = changing_one.on_packet(packet(n));
        ASSERT_GT(fate.regime, 0);
        expected.regime = fate.regime;
        if (fate.regime == 2) {
            ++bad;
            if (!fate.drop) expected.delay += 60ms;
        }
        ASSERT_EQ(fate, expected) << n;
    }
    EXPECT_NEAR(static_cast<double>(bad) / 20'000.0, 1.0 / 3.0, 0.1);
}

TEST(Regimes, FollowTheirOwnStream)
{
    Pipeline pipeline{{.regimes = changing()}, seed, Direction::up};
    auto chain = chain_of(changing());
    for (std::uint64_t n = 0; n < 5000; ++n) {
        ASSERT_EQ(pipeline.on_packet(packet(n)).regime, chain.at(packet(n).at) + 1);
    }
}

TEST(Regimes, DrawFromStagesThatSeeEveryDatagram)
{
    const Variation jitter{GammaLaw{30ms, 10ms}, 100ms};
    const GilbertElliott bursts{5_percent, 20_percent};
    Pipeline pipeline{
        {.regimes = changing({}, {.loss = {{bursts}}, .jitter = jitter})}, seed, Direction::down};
    DelayProcess delays{jitter, seed.stream("down/regime/bad/jitter")};
    LossProcess losses{bursts, seed.stream("down/regime/bad/loss/gilbert-elliott")};
    std::size_t checked = 0;
    for (std::uint64_t n = 0; n < 5000; ++n) {
        const auto lost = losses.on_packet(packet(n));
        const auto delay = delays.on_packet(packet(n));
        const Fate fate = pipeline.on_packet(packet(n));
        if (fate.regime != 2) {
            ASSERT_EQ(fate, Fate{.regime = 1});
            continue;
        }
        ++checked;
        ASSERT_EQ(fate.drop, lost);
        ASSERT_EQ(fate.states[0], losses.state());
        if (!lost) {
            ASSERT_EQ(fate.delay, delay);
        }
    }
    EXPECT_GT(checked, 500U);
}

TEST(Regimes, MaySetWhatNoDirectionSets)
{
    Pipeline pipeline{{.regimes = changing({.corrupt = Corruption{100_percent, 3}},
                                           {.loss = {{RandomLoss{100_percent}}},
                                            .duplicate = Duplication{100_percent, 1ms}})},
                      seed,
                      Direction::up};
    for (std::uint64_t n = 0; n < 2000; ++n) {
        const Fate fate = pipeline.on_packet(packet(n));
        EXPECT_EQ(fate.drop.has_value(), fate.regime == 2);
        EXPECT_EQ(fate.flips.count, fate.regime == 1 ? 3 : 0);
    }
}

TEST(Regimes, AreTheSameBothWaysIfTogether)
{
    Regimes regimes = changing();
    const auto shares_alike = [&](bool are_together) {
        regimes.are_together = are_together;
        Pipeline up{{.regimes = regimes}, seed, Direction::up, "client.3"};
        Pipeline down{{.regimes = regimes}, seed, Direction::down, "client.3"};
        std::size_t alike = 0;
        for (std::uint64_t n = 0; n < 5000; ++n) {
            alike += up.on_packet(packet(n)).regime == down.on_packet(packet(n)).regime ? 1U : 0U;
        }
        return alike;
    };
    EXPECT_EQ(shares_alike(true), 5000U);
    EXPECT_LT(shares_alike(false), 4000U);
    EXPECT_EQ(Pipeline({.regimes = regimes}, seed, Direction::up, "client.3").chain()->end(),
              chain_of(regimes, "client/3/up/regime").end());
}

TEST(Regimes, GoOnWhenTheConditionsInThemChange)
{
    Conditions conditions{.regimes =
                              changing({.delay = constant(20ms)}, {.delay = constant(60ms)})};
    Pipeline changed{conditions, seed, Direction::up};
    Pipeline untouched = changed;
    for (std::uint64_t n = 0; n < 3000; ++n) {
        if (n == 1000) {
            conditions.regimes = changing({.delay = constant(20ms)}, {.delay = constant(90ms)});
            changed.change(conditions);
        }
        const Fate was = untouched.on_packet(packet(n));
        const Fate is = changed.on_packet(packet(n));
        ASSERT_EQ(is.regime, was.regime);
        ASSERT_EQ(is.delay, n >= 1000 && is.regime == 2 ? 90ms : was.delay);
    }
    changed.change({});
    EXPECT_EQ(changed.on_packet(packet(3000)), Fate{});
}

/// The departures of simultaneous datagrams from a line whose rate follows the regimes, by bits.
std::vector<base::TimePoint> departures_of(const Regimes& regimes, std::size_t count, double bits,
                                           double fast, double slow)
{
    auto chain = chain_of(regimes);
    std::vector<base::TimePoint> left;
    double now = 0.0; // ns
    for (std::size_t i = 0; i < count; ++i) {
        double rest = bits;
        for (;;) {
            const double rate = chain.current() == 0 ? fast : slow; // bits a ns
            const double until_end = base::to_nanoseconds(chain.end()) - now;
            if (rest <= until_end * rate) {
                now += rest / rate;
                break;
            }
            rest -= until_end * rate;
            now += until_end;
            std::ignore = chain.at(chain.end());
        }
        left.push_back(base::TimePoint{base::Duration{static_cast<std::int64_t>(now)}});
    }
    return left;
}

TEST(Regimes, LetAQueueSurviveAChangeOfRate)
{
    const auto rate = [](std::uint64_t bits) {
        return Rate{.bits_per_second = bits, .overhead_bytes = 0, .queue_bytes_max = 1 << 20};
    };
    const Regimes regimes = changing({.rate = rate(8'000'000)}, {.rate = rate(80'000)});
    constexpr std::size_t count = 1000;
    Link link{{.regimes = regimes}, {.seed = seed, .limits = {.datagrams_max = 2 * count}}};
    const std::array<std::byte, 500> bytes{};
    for (std::size_t i = 0; i < count; ++i) {
        EXPECT_FALSE(link.on_packet(bytes, base::TimePoint{}).drop);
    }
    const auto expected = departures_of(regimes, count, 4000.0, 8e-3, 8e-5);
    std::size_t next = 0;
    while (const auto deadline = link.next_deadline()) {
        while (const auto datagram = link.poll(*deadline)) {
            ASSERT_LT(next, count);
            EXPECT_LE(std::chrono::abs(datagram->due - expected[next]), 2us) << next;
            EXPECT_LE(datagram->due, *deadline);
            link.on_sent(*datagram, *deadline);
            ++next;
        }
    }
    EXPECT_EQ(next, count);
    EXPECT_GT(expected.back() - expected.front(), 600ms);
}

TEST(Regimes, MaySetARateInOneOfThemOnly)
{
    const Regimes regimes = changing({}, {.rate = Rate{.bits_per_second = 8'000}});
    Link link{{.regimes = regimes}, {.seed = seed}};
    auto chain = chain_of(regimes);
    const std::array<std::byte, 72> bytes{};
    base::TimePoint now{};
    std::size_t at_once = 0;
    for (std::size_t i = 0; i < 2000; ++i, now += 1ms) {
        while (const auto datagram = link.poll(now)) link.on_sent(*datagram, now);
        const bool is_bad = chain.at(now.time_since_epoch()) == 1;
        const auto admission = link.on_packet(bytes, now);
        if (is_bad) {
            EXPECT_FALSE(admission.departure);
        }
        if (admission.departure) {
            ++at_once;
            link.on_sent(*admission.departure, now);
        }
    }
    EXPECT_GT(at_once, 500U);
}

TEST(Regimes, HaveAnOrderOfTheirOwn)
{
    const Variation wide = uniform(20ms);
    const auto reordered = [&](Order good, Order bad) {
        Link link{{.delay = constant(50ms),
                   .jitter = wide,
                   .regimes = changing({.order = good}, {.order = bad})},
                  {.seed = seed}};
        const std::array<std::byte, 72> bytes{};
        base::TimePoint now{};
        for (std::size_t i = 0; i < 2000; ++i, now += 1ms) {
            while (const auto datagram = link.poll(now)) link.on_sent(*datagram, now);
            std::ignore = link.on_packet(bytes, now);
        }
        return link.statistics().reordered;
    };
    const auto none = reordered(Order::keep, Order::keep);
    const auto some = reordered(Order::keep, Order::free);
    const auto all = reordered(Order::free, Order::free);
    EXPECT_EQ(none, 0U);
    EXPECT_GT(some, 100U);
    EXPECT_GT(all, some + 100U);
}

} // namespace
} // namespace hapnet::emulator::regimes_test
