// SPDX-FileCopyrightText: 2026 The Hapnet authors
// SPDX-License-Identifier: MIT
// Conditions drawn from a seed, and invariants that hold in every millisecond.
#include "tests/sim/peer/core/score.hpp"
#include "tests/support/seeds.hpp"

#include <gtest/gtest.h>
#include <spdlog/fmt/fmt.h>
#include <string>

namespace hapnet::sim {
namespace {

using namespace std::chrono_literals;
using namespace base::literals;

constexpr base::Duration length = 10s; // 7 s hands on

/// Delay 0 to 300 ms, jitter up to the delay, loss 0 to 90 %, sometimes bursts, copies and
/// datagrams out of their turn.
emulator::Conditions conditions_of(const base::RandomStream& draw, std::uint32_t way)
{
    emulator::Conditions c;
    const double delay = 0.3 * draw.uniform(0, way);
    c.delay.law = emulator::ConstantLaw{base::from_seconds(delay)};
    c.jitter.law = emulator::UniformLaw{{}, base::from_seconds(delay * draw.uniform(1, way))};
    c.order = static_cast<emulator::Order>(draw.below(3, 2, way));
    if (draw.below(3, 3, way) != 0) {
        const auto share = base::Probability::from_fraction(0.9 * draw.uniform(4, way)).value();
        c.loss.emplace_back(emulator::RandomLoss{share});
    }
    if (draw.below(3, 5, way) == 0) {
        const auto lost = static_cast<std::uint32_t>(draw.below(60, 6, way) + 1);
        c.loss.emplace_back(emulator::Burst{lost, 100, {}});
    }
    if (draw.below(4, 7, way) == 0) c.duplicate = {20_percent, 5ms};
    if (draw.below(4, 8, way) == 0) c.reorder = {10_percent, {.places = 3, .time = {}}};
    return c;
}

Setting setting_of(std::uint64_t seed)
{
    const auto draw = base::Seed{seed}.stream("conditions");
    Setting setting;
    constexpr std::array tasks{device::Task::p1, device::Task::t1, device::Task::t3};
    setting.task = tasks.at(draw.below(3, 10));
    setting.seed = base::Seed{seed};
    setting.length = length;
    setting.profile.path.up = conditions_of(draw, 0);
    setting.profile.path.down = conditions_of(draw, 1);
    const auto share_of = [&](base::Duration whole, std::uint32_t what, std::uint32_t of = 0) {
        return base::from_seconds(base::to_seconds(whole) * draw.uniform(what, of));
    };
    if (draw.below(2, 11) == 0) { // other conditions after a while
        setting.profile.timeline = {{.time = share_of(length / 2, 12),
                                     .ramp = {},
                                     .up = {.delay = emulator::constant(share_of(300ms, 13))},
                                     .down = {.loss = {{emulator::RandomLoss{40_percent}}}}}};
    }
    for (const std::uint32_t side : {0U, 1U}) {
        if (draw.below(2, 14, side) == 0) setting.players[side].phase = share_of(1ms, 15, side);
    }
    setting.players[1].clock_ahead = share_of(2000s, 16) - 1000s;
    return setting;
}

std::string words_for(const emulator::Conditions& c)
{
    return fmt::format("delay {} ns, jitter {} ns {}, {} laws of loss, {} copied, {} displaced",
                       std::get<emulator::ConstantLaw>(c.delay.law).value.count(),
                       std::get<emulator::UniformLaw>(c.jitter.law).half_width.count(),
                       to_text(c.order), c.loss.size(), c.duplicate.share.fraction(),
                       c.reorder.share.fraction());
}

std::string words_for(const Setting& s)
{
    const auto& changes = s.profile.timeline;
    return fmt::format("seed {}, {}; up: {}; down: {}; change at {} ns; phases {} and {} ns",
                       s.seed.value(), device::name_of(s.task), words_for(s.profile.path.up),
                       words_for(s.profile.path.down),
                       changes.empty() ? 0 : changes.front().time.count(),
                       s.players[0].phase.count(), s.players[1].phase.count());
}

void expect_invariants(const World& world)
{
    for (const std::size_t i : {0U, 1U}) {
        const auto& link = world.link(i, 1 - i).statistics();
        ASSERT_EQ(link.received + link.duplicated,
                  link.delivered + link.dropped_total() + link.in_flight);
        ASSERT_LE(link.in_flight, 2000U); // 0.6 s at most, of a message or two each millisecond
        if (!world.is_alive(i)) continue;
        const Player& side = world.side(i);
        ASSERT_TRUE(base::is_finite(side.told()));
        ASSERT_LE(base::norm(side.told()), 3.3 + 1e-12);
        ASSERT_TRUE(base::is_finite(side.last().force));
        ASSERT_TRUE(base::is_finite(side.peer().body().position));
        ASSERT_LE(std::abs(side.peer().body().position.x()), 0.2);
        const auto& counters = side.peer().counters();
        ASSERT_EQ(counters.malformed + counters.implausible + counters.unusable_hand, 0U);
    }
}

class Conditions : public testing::TestWithParam<std::uint64_t> {};

TEST_P(Conditions, OfEveryKindLeaveForcesFiniteLinksAccountedForAndCopiesEqualInTheEnd)
{
    const Setting setting = setting_of(GetParam());
    SCOPED_TRACE(words_for(setting));
    World world{setting};
    const auto step = [&world] {
        world.step();
        expect_invariants(world);
        return !testing::Test::HasFatalFailure();
    };
    // At 90 % loss in both directions the start takes about a second; 60 s is never reached.
    for (int i = 0; i < 60'000 && !world.side(0).peer().session(); ++i) ASSERT_TRUE(step());
    ASSERT_TRUE(world.side(0).peer().session());
    const base::TimePoint start = world.side(0).peer().session()->start;
    const base::Duration hands_on = world.side(0).peer().hands_on();
    while (world.now() < start + hands_on + 2s)
        ASSERT_TRUE(step()) << world.now().time_since_epoch().count();
    ASSERT_TRUE(world.side(1).peer().session());
    EXPECT_LE(discrepancy_x(world), 0.1e-3);
    while (world.now() < start + length + 500ms) ASSERT_TRUE(step());
    EXPECT_TRUE(world.side(0).peer().finished());
    EXPECT_TRUE(world.side(1).peer().finished());
}

INSTANTIATE_TEST_SUITE_P(Seed, Conditions, testing::Range(std::uint64_t{0}, test::seeds(60)));

class Deaths : public testing::TestWithParam<std::uint64_t> {};

TEST_P(Deaths, OfEitherSideAtAnyTimeEndInOneSessionWithEqualCopies)
{
    Setting setting = setting_of(GetParam());
    setting.length = 20s;
    SCOPED_TRACE(words_for(setting));
    const auto draw = setting.seed.stream("deaths");
    World world{setting};
    for (std::uint64_t death = 0; death < 3; ++death) {
        const std::size_t side = draw.below(2, death, 0);
        const base::Duration alive = base::from_seconds(3.0 * draw.uniform(death, 1));
        const base::Duration dead = base::from_seconds(draw.uniform(death, 2));
        for (const auto end = world.now() + alive; world.now() < end;) world.step();
        world.kill(side);
        for (const auto end = world.now() + dead; world.now() < end;) {
            world.step();
            expect_invariants(world);
        }
        world.revive(side);
    }
    const auto in_one_session = [&world] {
        const auto& a = world.side(0).peer().session();
        const auto& b = world.side(1).peer().session();
        return a && b && a->number == b->number;
    };
    world.run_for(10s);
    ASSERT_TRUE(in_one_session());
    const base::TimePoint start = world.side(0).peer().session()->start;
    while (world.now() < start + world.side(0).peer().hands_on() + 2s) world.step();
    expect_invariants(world);
    EXPECT_LE(discrepancy_x(world), 0.1e-3);
    EXPECT_GT(world.side(0).last().freshness + world.side(1).last().freshness, 0.0);
}

INSTANTIATE_TEST_SUITE_P(Seed, Deaths,
                         testing::Range(std::uint64_t{100}, std::uint64_t{100} + test::seeds(40)));

TEST(Conditions, WhereOneOf100MessagesArrivesStillEndWithEqualCopies)
{
    Setting setting = under(device::Task::t3, {});
    setting.length = 60s;
    setting.profile.path.up.loss = setting.profile.path.down.loss = {
        emulator::RandomLoss{base::Probability::from_fraction(0.99).value()}};
    World world{setting};
    for (int ms = 0; ms < 120'000 && !world.side(1).peer().session(); ++ms) {
        world.step();
        expect_invariants(world);
    }
    ASSERT_TRUE(world.side(1).peer().session());
    const base::TimePoint start = world.side(0).peer().session()->start;
    ASSERT_LT(world.now(), start + 50s) << "the other side heard of the start too late to play";
    while (world.now() < start + world.side(0).peer().hands_on() + 2s) world.step();
    expect_invariants(world);
    EXPECT_LE(discrepancy_x(world), 0.1e-3);
}

} // namespace
} // namespace hapnet::sim
