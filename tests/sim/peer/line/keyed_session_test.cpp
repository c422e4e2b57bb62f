// SPDX-FileCopyrightText: 2026 The Hapnet authors
// SPDX-License-Identifier: MIT

// Whole sessions between sides that have keys, in virtual time.

#include "emulator/core/profile/text.hpp"
#include "lab/virtual_time/world.hpp"
#include "peer/line/status.hpp"
#include "tests/support/multiplications.hpp"

#include <algorithm>
#include <array>
#include <deque>
#include <gtest/gtest.h>
#include <vector>

namespace hapnet::peer::line {

namespace {

using namespace std::chrono_literals;

using Bytes = std::vector<std::byte>;
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
    return *status_of(world.side(side).lines[0], world.now()).key;
}

bool has_event(const VirtualWorld& world, std::size_t side, Event event)
{
    return std::ranges::count(world.side(side).events, event) > 0;
}

/// Two players with keys, 3 ms apart; all datagrams of side 0; and how often each side has
/// multiplied on the curve since the last step began.
class Wire {
public:
    explicit Wire(const Setting& setting)
        : players_{lab::virtual_time::VirtualPlayer{setting, {0, 11}},
                   lab::virtual_time::VirtualPlayer{setting, {1, 22}}}
    {}

    lab::virtual_time::VirtualPlayer& side(std::size_t index) { return players_.at(index); }
    [[nodiscard]] base::TimePoint now() const { return now_; }
    [[nodiscard]] const std::vector<Bytes>& seen() const { return seen_; }

    [[nodiscard]] std::uint64_t multiplied(std::size_t side) const { return multiplied_.at(side); }

    void give(std::size_t side, std::span<const std::byte> bytes)
    {
        const std::uint64_t before = test::multiplications();
        players_.at(side).receive(0, bytes, now_);
        multiplied_.at(side) += test::multiplications() - before;
    }

    void step()
    {
        now_ += 1ms;
        multiplied_ = {};
        for (const std::size_t side : {0U, 1U}) {
            auto& inbox = inboxes_.at(side);
            while (!inbox.empty() && inbox.front().due <= now_) {
                give(side, inbox.front().bytes);
                inbox.pop_front();
            }
        }
        for (const std::size_t side : {0U, 1U}) {
            const std::uint64_t before = test::multiplications();
            players_.at(side).step(now_);
            multiplied_.at(side) += test::multiplications() - before;
            players_.at(side).send_all([&](std::size_t, std::span<const std::byte> bytes,
                                           const auto&) {
                inboxes_.at(1 - side).push_back({Bytes{bytes.begin(), bytes.end()}, now_ + 3ms});
                if (side == 0) seen_.emplace_back(bytes.begin(), bytes.end());
            });
        }
    }

private:
    struct OnTheWay {
        Bytes bytes;
        base::TimePoint due;
    };

    std::array<lab::virtual_time::VirtualPlayer, 2> players_;
    std::array<std::deque<OnTheWay>, 2> inboxes_;
    std::array<std::uint64_t, 2> multiplied_{};
    std::vector<Bytes> seen_;
    base::TimePoint now_{1000s};
};

/// Genuine initiations to the other side, from `runs` earlier runs.
std::vector<Bytes> initiations_of(const Setting& setting, std::size_t side, std::uint32_t runs)
{
    std::vector<Bytes> captured;
    for (std::uint32_t run = 1000; run < 1000 + runs; ++run) {
        lab::virtual_time::VirtualPlayer player{setting, {side, run}};
        player.date_ahead = -1h;
        base::TimePoint now{900s};
        const std::size_t before = captured.size();
        while (captured.size() == before) {
            player.step(now += 1ms);
            player.send_all([&](std::size_t, std::span<const std::byte> bytes, const auto&) {
                captured.emplace_back(bytes.begin(), bytes.end());
            });
        }
    }
    return captured;
}

/// The datagrams of an attacker to side 1 in a tick. The attacker sees all that side 1 hears and
/// has no key. He sends plain messages in the name of the other side that push, buzz and throw, end
/// and start sessions, and changed or repeated sealed ones.
void attack(Wire& world, int tick)
{
    constexpr std::size_t victim = 1;
    const std::vector<Bytes>& heard = world.seen();
    auto& player = world.side(victim);
    const auto give = [&](std::span<const std::byte> bytes) { world.give(victim, bytes); };
    wire::State state;
    state.session = player.peer().session() ? player.peer().session()->number : 1;
    state.sequence = static_cast<std::uint32_t>(tick + 500);
    state.sent = world.now();
    state.touching = true;
    const double sign = tick / 7 % 2 == 0 ? 1.0 : -1.0;
    for (const double force_n : {3.3, 3.3 * sign, 3.4e38}) {
        state.contact_force = {{force_n, 0.0, 0.0}};
        state.bodies.clear();
        wire::BodyState body;
        body.position = {{0.05 * sign, 0.0, 0.0}};
        state.bodies.add(body);
        give(wire::encode(state).bytes());
    }
    give(wire::encode(wire::Bye{state.session, wire::ByeReason::finished}).bytes());
    wire::Hello hello;
    hello.nonce = static_cast<std::uint32_t>(tick + 1);
    hello.peer_id = static_cast<std::uint16_t>(2 - victim);
    hello.tick_rate_hz = 1000;
    hello.start = world.now();
    hello.task = wire::TaskName::from_text("P1").value();
    give(wire::encode(hello).bytes());
    constexpr std::size_t on_their_way = 5; // at most: genuine, and not heard yet
    if (heard.size() <= on_their_way) return;
    Bytes forged = heard.back();
    forged[static_cast<std::size_t>(tick) % forged.size()] ^= std::byte{0x10};
    give(forged);
    give(heard[static_cast<std::size_t>(tick) % (heard.size() - on_their_way)]); // a repetition
}

} // namespace

TEST(KeyedSession, IsNotMovedABitByAFloodOfForgedMessages)
{
    Setting setting = keyed_setting("");
    setting.length = 8s;
    Wire attacked{setting}, left_alone{setting};
    for (int tick = 0; tick < 9'000; ++tick) {
        attacked.step();
        left_alone.step();
        if (tick > 300) attack(attacked, tick);
        for (const std::size_t side : {0U, 1U}) {
            ASSERT_EQ(attacked.side(side).told(), left_alone.side(side).told()) << tick;
            ASSERT_EQ(attacked.side(side).peer().position(),
                      left_alone.side(side).peer().position())
                << tick;
        }
    }
    EXPECT_EQ(attacked.side(1).events, left_alone.side(1).events);
    EXPECT_EQ(std::ranges::count(attacked.side(1).events, Event::hands_off), 1);
    const Status::Key key = *status_of(attacked.side(1).lines[0], attacked.now()).key;
    EXPECT_GT(key.counts.unsealed, 40'000U);
    EXPECT_GT(key.counts.forged + key.counts.unknown_key, 5'000U);
    EXPECT_GT(key.counts.replayed, 5'000U);
}

TEST(KeyedSession, EndsTheForceWhenGenuineMessagesComeLate)
{
    // From 3 s on everything is held back for 2 s. Then it arrives, genuine but 2 s old.
    VirtualWorld world{keyed_setting("[[at]]\ntime = \"3s\"\nboth.delay = \"2s\"")};
    double pressed_n = 0.0;
    while (world.now() < VirtualWorld::start + 3s) {
        world.step();
        pressed_n = std::max(pressed_n, base::norm(world.side(0).told()));
    }
    EXPECT_GT(pressed_n, 0.1);
    world.run_for(400ms);
    for (int tick = 0; tick < 1500; ++tick) {
        world.step();
        for (const std::size_t side : {0U, 1U})
            ASSERT_EQ(base::norm(world.side(side).told()), 0.0) << tick;
    }
    world.run_for(1s);
    EXPECT_GT(world.side(0).last().freshness, 0.0);
}

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
        // Its initiations look old. Those of the other side make the key, under which it says
        // hello.
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
    world.intercept([&](const VirtualWorld::Arrival& arrival) {
        const secure::Place elsewhere{std::byte{0xee}};
        const auto place = redirects ? elsewhere : lab::virtual_time::place_of(arrival.from);
        world.side(arrival.to).receive(0, place, arrival.datagram, arrival.at);
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
    for (const bool is_bad : {false, true}) {
        Setting setting =
            keyed_setting(is_bad ? "[both]\ndelay = \"40ms\"\njitter = \"15ms\"\norder = \"free\"\n"
                                   "loss = \"30%\""
                                 : "[both]\ndelay = \"40ms\"");
        setting.length = 125s;
        VirtualWorld world{setting};
        world.run_for(124s);
        for (const std::size_t side : {0U, 1U}) {
            const Status::Key key = key_of(world, side);
            EXPECT_EQ(key.counts.rekeys, 1U);
            EXPECT_EQ(key.counts.unknown_key + key.counts.forged, 0U);
            EXPECT_FALSE(has_event(world, side, Event::lost));
            EXPECT_FALSE(has_event(world, side, Event::restarted));
            const Counters& counters = world.side(side).peer().counters();
            EXPECT_EQ(counters.other_session + counters.malformed, 0U);
            if (!is_bad) {
                EXPECT_LE(counters.sent - counters.states, 150U);
            }
        }
    }
}

TEST(KeyedSession, MultipliesEightTimesAHandshakeAndOnceATickAtMost)
{
    Setting setting = keyed_setting("");
    setting.length = 125s; // one renewal of the key
    Wire world{setting};
    std::uint64_t multiplied = 0;
    for (int tick = 0; tick < 124'000; ++tick) {
        world.step();
        for (const std::size_t side : {0U, 1U}) {
            ASSERT_LE(world.multiplied(side), 1U) << tick;
            multiplied += world.multiplied(side);
        }
    }
    EXPECT_EQ(multiplied, 2U * 8U + 2U); // two for what the higher id began at the same time
}

TEST(KeyedSession, MultipliesOnceATickAtMostUnderAFloodOfInitiations)
{
    Setting setting = keyed_setting("");
    setting.length = 125s;
    Wire world{setting};
    const std::array captured{initiations_of(setting, 1, 200), initiations_of(setting, 0, 200)};
    std::uint64_t multiplied = 0;
    for (int tick = 0; tick < 124'000; ++tick) {
        world.step();
        // At the beginning, and around the renewal of the key at 110 s; by turns as fast as they
        // are let in, and so fast that a cookie is asked for.
        const int every = tick / 1000 % 2 == 0 ? 60 : 1;
        const bool is_flooded = tick < 5'000 || tick >= 100'000;
        for (const std::size_t side : {0U, 1U}) {
            if (!is_flooded) continue;
            const auto& own = captured.at(side);
            if (tick % every == 0) world.give(side, own.at(static_cast<std::size_t>(tick) % 200));
            Bytes forged = own.front(); // its MAC does not fit
            forged[static_cast<std::size_t>(tick) % forged.size()] ^= std::byte{1};
            world.give(side, forged);
            ASSERT_LE(world.multiplied(side), 1U) << tick;
            multiplied += world.multiplied(side);
        }
    }
    EXPECT_GT(multiplied, 500U);
    for (const std::size_t side : {0U, 1U}) {
        const Status::Key key = *status_of(world.side(side).lines.front(), world.now()).key;
        EXPECT_EQ(key.counts.rekeys, 1U) << side;
        EXPECT_GT(key.counts.cookies, 5'000U) << side;
        EXPECT_GT(key.counts.replayed, 250U) << side; // opened, and found to be old
        EXPECT_FALSE(std::ranges::count(world.side(side).events, Event::lost)) << side;
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
        EXPECT_EQ(world.side(side).lines[0].news(), News::other_circle);
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
