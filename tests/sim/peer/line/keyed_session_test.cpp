// SPDX-FileCopyrightText: 2026 The Hapnet authors
// SPDX-License-Identifier: MIT

// Whole sessions between sides that have keys, in virtual time.

#include "emulator/core/profile/text.hpp"
#include "lab/virtual_time/world.hpp"
#include "peer/line/status.hpp"

#include <algorithm>
#include <gtest/gtest.h>

namespace hapnet::peer::line {

namespace {

using namespace std::chrono_literals;

using lab::virtual_time::Setting;
using lab::virtual_time::VirtualWorld;

base::Result<std::string> no_files(const std::string& name) { return base::fail(name); }

Setting keyed_setting(std::string_view profile)
{
    Setting setting;
    setting.length = 10s;
    setting.profile = emulator::parse_profile(profile, "test", no_files).value();
    for (auto& player : setting.players) player.circle = base::Seed{7};
    return setting;
}

Status::Key key_of(const VirtualWorld& world, std::size_t side)
{
    return *status_of(world.side(side).line, world.now()).key;
}

bool has_event(const VirtualWorld& world, std::size_t side, Event event)
{
    return std::ranges::count(world.side(side).events, event) > 0;
}

} // namespace

TEST(KeyedSession, GoesThroughLossAndDelayLikeAPlainOne)
{
    VirtualWorld world{keyed_setting("[both]\ndelay = \"80ms\"\nloss = \"30%\"")};
    world.run_for(11800ms);
    for (const std::size_t side : {0U, 1U}) {
        EXPECT_TRUE(has_event(world, side, Event::started));
        EXPECT_TRUE(has_event(world, side, Event::ended));
        const Counters& counters = world.side(side).peer().counters();
        EXPECT_GT(counters.states, 6500U);
        EXPECT_EQ(counters.malformed + counters.other_session + counters.other_version, 0U);
        const Status::Key key = key_of(world, side);
        EXPECT_EQ(key.counts.handshakes, 1U);
        EXPECT_EQ(key.counts.forged + key.counts.unknown_key + key.misnamed, 0U);
    }
}

TEST(KeyedSession, PlaysWhatTheSameSeedPlaysWithoutAKey)
{
    Setting keyed = keyed_setting("");
    keyed.length = 6s;
    Setting plain = keyed;
    for (auto& player : plain.players) player.circle.reset();
    VirtualWorld with{keyed}, without{plain};
    with.run_for(8s);
    without.run_for(8s);
    for (const std::size_t side : {0U, 1U}) {
        EXPECT_LT(
            base::norm(with.side(side).peer().position() - without.side(side).peer().position()),
            1e-6);
        EXPECT_EQ(with.side(side).peer().counters().states,
                  without.side(side).peer().counters().states);
    }
}

TEST(KeyedSession, GoesOnWithAPeerThatWasStartedAgain)
{
    VirtualWorld world{keyed_setting("[both]\ndelay = \"20ms\"")};
    world.run_for(4s);
    world.kill(1);
    world.run_for(700ms);
    world.revive(1);
    world.run_for(3s);
    EXPECT_TRUE(has_event(world, 0, Event::restarted));
    EXPECT_TRUE(has_event(world, 1, Event::joined));
    EXPECT_EQ(key_of(world, 0).counts.handshakes, 2U);
    EXPECT_EQ(key_of(world, 0).counts.rekeys, 0U);
    EXPECT_GT(world.side(0).last().freshness, 0.0);
    EXPECT_GT(world.side(1).last().freshness, 0.0);
}

TEST(KeyedSession, GoesOnWithAPeerThatWasStartedAgainWithAnEarlierDate)
{
    for (const std::size_t restarted : {0U, 1U}) {
        Setting setting = keyed_setting("[both]\ndelay = \"20ms\"");
        setting.length = 30s;
        VirtualWorld world{setting};
        world.run_for(4s);
        world.kill(restarted);
        world.run_for(700ms);
        world.revive(restarted);
        // Its initiations look old; those of the other side make the key, which says hello under
        // it.
        world.side(restarted).date_ahead = -1h;
        // The lower id asks for 5 s before it listens.
        world.run_for(restarted == 0 ? 9s : 4s);
        EXPECT_TRUE(has_event(world, 1 - restarted, Event::restarted)) << restarted;
        EXPECT_GT(world.side(0).last().freshness, 0.0) << restarted;
        EXPECT_GT(world.side(1).last().freshness, 0.0) << restarted;
    }
}

TEST(KeyedSession, IsFoundAgainAfterBothSidesWereLookedForElsewhere)
{
    VirtualWorld world{keyed_setting("[both]\ndelay = \"20ms\"")};
    bool redirects = false;
    world.intercept([&](std::size_t to, std::span<const std::byte> bytes, base::TimePoint at) {
        const secure::Place elsewhere{std::byte{0xee}};
        const secure::Place from = redirects ? elsewhere : lab::virtual_time::place_of(1 - to);
        world.side(to).receive(bytes, from, at);
    });
    world.run_for(4s);
    redirects = true;
    world.run_for(100ms);
    redirects = false;
    world.run_for(3s);
    for (const std::size_t side : {0U, 1U}) {
        EXPECT_GT(world.side(side).last().freshness, 0.0) << side;
        EXPECT_FALSE(has_event(world, side, Event::restarted)) << side;
    }
}

TEST(KeyedSession, DoesNotNoticeThatItsKeyIsRenewed)
{
    Setting setting = keyed_setting("[both]\ndelay = \"40ms\"");
    setting.length = 125s;
    VirtualWorld world{setting};
    world.run_for(124s);
    for (const std::size_t side : {0U, 1U}) {
        EXPECT_EQ(key_of(world, side).counts.rekeys, 1U);
        EXPECT_FALSE(has_event(world, side, Event::lost));
        EXPECT_FALSE(has_event(world, side, Event::restarted));
        const Counters& counters = world.side(side).peer().counters();
        EXPECT_LE(counters.sent - counters.states, 150U);
    }
}

TEST(KeyedSession, OfDifferentCirclesNeverBegins)
{
    Setting setting = keyed_setting("");
    setting.players[1].circle = base::Seed{8};
    VirtualWorld world{setting};
    world.run_for(5s);
    for (const std::size_t side : {0U, 1U}) {
        EXPECT_TRUE(world.side(side).events.empty());
        EXPECT_EQ(world.side(side).peer().counters().hellos, 0U);
        EXPECT_EQ(world.side(side).line.news(), News::other_circle);
    }
}

TEST(KeyedSession, TakesDamageForLoss)
{
    VirtualWorld world{keyed_setting("[both]\ndelay = \"20ms\"\ncorrupt = \"20%\"")};
    world.run_for(13s);
    for (const std::size_t side : {0U, 1U}) {
        const Counters& counters = world.side(side).peer().counters();
        EXPECT_GT(counters.states, 6500U);
        EXPECT_EQ(counters.malformed + counters.implausible + counters.other_version, 0U);
        EXPECT_GT(key_of(world, side).counts.forged, 1000U);
    }
}

} // namespace hapnet::peer::line
