// SPDX-FileCopyrightText: 2026 The Hapnet authors
// SPDX-License-Identifier: MIT
// A link under settings, arrivals and refusals that all come from a seed.
#include "emulator/core/conditions.hpp"
#include "emulator/core/link.hpp"
#include "tests/support/seeds.hpp"

#include <algorithm>
#include <array>
#include <chrono>
#include <cstddef>
#include <cstdint>
#include <gtest/gtest.h>
#include <vector>

namespace hapnet::emulator::link_test {

namespace {

using namespace std::chrono_literals;

constexpr base::TimePoint start{1h};

void expect_identity(const Statistics& s)
{
    ASSERT_EQ(s.received + s.duplicated, s.delivered + s.dropped_total() + s.in_flight);
}

/// The settings of one run, drawn from its seed.
struct Scenario {
    explicit Scenario(std::uint64_t value) : seed{value}, chance{seed.stream("scenario")} {}

    [[nodiscard]] base::Probability share(std::uint64_t index) const
    {
        return base::Probability::from_fraction(chance.uniform(index) * chance.uniform(index, 1))
            .value();
    }

    [[nodiscard]] bool often(std::uint64_t index) const { return chance.below(2, index) == 0; }

    [[nodiscard]] base::Duration up_to(base::Duration most, std::uint64_t index) const
    {
        return base::Duration{static_cast<base::Duration::rep>(chance.uniform(index) *
                                                               static_cast<double>(most.count()))};
    }

    [[nodiscard]] Conditions conditions() const
    {
        Conditions drawn;
        if (often(0)) drawn.loss.emplace_back(RandomLoss{share(1)});
        if (often(2)) {
            const auto of = static_cast<std::uint32_t>(1 + chance.below(50, 3));
            const auto lost = static_cast<std::uint32_t>(1 + chance.below(of, 4));
            drawn.loss.emplace_back(Burst{lost, of, {}});
        }
        drawn.delay = constant(up_to(50ms, 5));
        drawn.jitter = uniform(up_to(60ms, 6));
        drawn.order = static_cast<Order>(chance.below(3, 7));
        if (often(8)) drawn.duplicate = {share(9), up_to(5ms, 10)};
        if (often(11)) drawn.corrupt = {share(12), 3};
        if (often(13)) drawn.mtu = {28 + chance.below(300, 14)};
        if (often(15)) drawn.rate = {10'000 + chance.below(3'000'000, 16), 28, 2000};
        if (chance.below(4, 17) == 0) {
            drawn.reorder = {share(18), {static_cast<std::uint32_t>(chance.below(4, 19)), {}}};
        } else if (chance.below(4, 17) == 1) {
            drawn.reorder = {share(18), {0, up_to(9ms, 20)}};
        }
        return drawn;
    }

    [[nodiscard]] QueueLimits limits() const
    {
        return {.datagrams_max = static_cast<std::size_t>(1 + chance.below(60, 21))};
    }

    base::Seed seed;
    base::RandomStream chance;
};

void check_departure(const Datagram& departure, const Conditions& conditions, base::TimePoint now)
{
    ASSERT_GE(now, departure.due);
    ASSERT_GE(departure.due, departure.arrival);
    const auto delay = std::get<ConstantLaw>(conditions.delay.law).value;
    const auto width = std::get<UniformLaw>(conditions.jitter.law).half_width;
    if (conditions.order != Order::sorted) {
        ASSERT_GE(departure.due, departure.arrival + delay - width);
    }
    if (conditions.order == Order::free && conditions.rate == Rate{} && !departure.is_copy &&
        conditions.reorder == Reordering{}) {
        ASSERT_LE(departure.due, departure.arrival + std::max(delay + width, 0ns));
    }
}

/// Runs one scenario and checks every invariant at every step. Halfway the conditions change to
/// those of another scenario.
void run_scenario(const Scenario& scenario, const Scenario& other)
{
    Conditions conditions = scenario.conditions();
    const bool changes = scenario.often(90);
    const base::RandomStream& chance = scenario.chance;
    Link link{conditions, {scenario.seed, Direction::up, start, scenario.limits()}};
    const std::array<std::byte, 300> bytes{};
    auto now = start;
    for (std::uint64_t step = 100; step < 600; ++step) {
        now += base::Duration{static_cast<std::int64_t>(chance.below(2'000'000, step, 0))};
        if (changes && step == 300) link.change(other.conditions(), now);
        const auto size = static_cast<std::size_t>(chance.below(300, step, 1));
        const auto leave = [&](const Datagram& departure) {
            if (!changes) check_departure(departure, conditions, now);
            if (chance.below(10, departure.number, 2) == 0) {
                link.on_failed(departure, DropCause::send_buffer_full);
            } else {
                link.on_sent(departure, now);
            }
            expect_identity(link.statistics());
        };
        const auto admission = link.on_packet(std::span{bytes}.first(size), now);
        expect_identity(link.statistics());
        if (admission.departure) leave(*admission.departure);
        while (const auto departure = link.poll(now)) leave(*departure);
        ASSERT_FALSE(base::is_due(link.next_deadline(), now));
    }
    ASSERT_EQ(link.statistics().received, 500U);
    if (conditions.order != Order::free && conditions.reorder == Reordering{} && !changes) {
        ASSERT_EQ(link.statistics().reordered, 0U);
    }
    while (const auto departure = link.poll(now + 1h)) link.on_sent(*departure, now + 1h);
    ASSERT_EQ(link.statistics().in_flight, 0U);
    ASSERT_FALSE(link.next_deadline());
}

} // namespace

TEST(Link, AccountsForEveryDatagramAndLetsNoneLeaveEarlyWhateverTheSettings)
{
    for (std::uint64_t seed = 0; seed < test::seeds(400); ++seed) {
        SCOPED_TRACE(seed);
        ASSERT_NO_FATAL_FAILURE(run_scenario(Scenario{seed}, Scenario{seed + 1000}));
    }
}

TEST(Link, GivesTheNthDatagramTheSameFateWhateverTheArrivalsAre)
{
    const auto forty = base::Probability::from_fraction(0.4).value();
    const Conditions conditions{.loss = {RandomLoss{forty}},
                                .delay = constant(10ms),
                                .jitter = uniform(10ms),
                                .order = Order::free};
    const Link::Setup setup{base::Seed{11}, Direction::up, start, {}};
    Link steady{conditions, setup};
    Link bursty{conditions, setup};
    for (int i = 0; i < 2000; ++i) {
        EXPECT_EQ(steady.on_packet({}, start + i * 1ms).fate,
                  bursty.on_packet({}, start + i / 50 * 1s).fate);
    }
}

} // namespace hapnet::emulator::link_test
