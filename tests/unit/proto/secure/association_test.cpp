// SPDX-FileCopyrightText: 2026 The Hapnet authors
// SPDX-License-Identifier: MIT
#include "proto/secure/association.hpp"

#include "proto/base/bytes.hpp"
#include "tests/unit/proto/secure/circle.hpp"

#include <array>
#include <gtest/gtest.h>
#include <set>
#include <vector>

namespace hapnet::secure {

namespace {

using namespace circle;

constexpr Setting one{.id = 1, .run = 11, .seed = 100};
constexpr Setting two{.id = 2, .run = 22, .seed = 200};

/// The bytes of the datagrams to one side that have this type.
std::vector<Text> of_type(World& world, int to, FrameType type)
{
    std::vector<Text> found;
    for (const Datagram& each : world.seen())
        if (each.to == to && frame_type_of(each.bytes) == type) found.push_back(each.bytes);
    return found;
}

/// Initiations to each side that never arrived, the newest last.
std::array<std::vector<Text>, 2> withheld_initiations(const Setting& a, const Setting& b,
                                                      base::Duration time = 30s)
{
    World world{a, b, {.loss = 1.0}};
    world.run(time);
    std::array<std::vector<Text>, 2> found;
    for (const int to : {0, 1}) {
        for (const Text& each : of_type(world, to, FrameType::initiation)) {
            auto& kept = found.at(static_cast<std::size_t>(to));
            if (kept.empty() || kept.back() != each) kept.push_back(each);
        }
    }
    return found;
}

/// The same peer in another run, whose date is an hour behind.
Side restarted(Setting setting, std::uint32_t run)
{
    setting.run = run;
    setting.seed = static_cast<std::uint8_t>(run);
    Side side = World::side(setting);
    side.unix_offset_ns = -3600'000'000'000;
    return side;
}

bool is_growing(const std::vector<std::uint32_t>& numbers)
{
    return std::ranges::adjacent_find(numbers, std::greater_equal{}) == numbers.end();
}

} // namespace

TEST(Association, OfTwoPeersExchangesMessagesAfterTwentyMilliseconds)
{
    World world{one, two};
    world.run(1s);
    EXPECT_GT(world.a().received.size(), 900U);
    EXPECT_GT(world.b().received.size(), 900U);
    EXPECT_TRUE(is_growing(world.a().received));
    EXPECT_EQ(world.a().session, session_of(11, 22));
    EXPECT_EQ(world.b().session, session_of(11, 22));
    for (Side* side : {&world.a(), &world.b()}) {
        const auto& counts = side->association->counts();
        EXPECT_EQ(counts.handshakes, 1U);
        EXPECT_EQ(counts.forged + counts.replayed + counts.unknown_key + counts.refused +
                      counts.other_circle + counts.roamed + counts.rekeys,
                  0U);
    }
}

TEST(Association, NeedsThePreSharedKeyAndTheRightPeer)
{
    Setting other_shared = two;
    other_shared.shared = 8;
    Setting other_peer = two;
    other_peer.other_key_of = 77; // has another peer's key for 1
    for (const Setting& wrong : {other_shared, other_peer}) {
        World world{one, wrong};
        world.run(8s);
        EXPECT_EQ(world.a().hellos + world.b().hellos, 0U);
        EXPECT_EQ(world.a().association->counts().handshakes, 0U);
        EXPECT_EQ(world.b().association->counts().handshakes, 0U);
    }
}

TEST(Association, RenewsItsKeyWithoutLosingAMessage)
{
    World world{one, two};
    world.run(1s);
    const std::uint64_t before = world.a().association->counts().not_sealed;
    world.run(120s);
    EXPECT_EQ(world.a().association->counts().not_sealed, before);
    for (Side* side : {&world.a(), &world.b()}) {
        EXPECT_EQ(side->association->counts().rekeys, 1U);
        EXPECT_TRUE(is_growing(side->received));
        EXPECT_GE(side->received.size(), 120'900U);
        EXPECT_EQ(side->received.back() - side->received.front() + 1, side->received.size());
    }
}

TEST(Association, MeetsThroughMostLoss)
{
    for (const double loss : {0.5, 0.93, 0.97}) {
        World world{one, two, {.loss = loss, .delay = 40ms, .jitter = 30ms, .duplicates = 0.1}};
        world.run(60s);
        EXPECT_GT(world.a().received.size(), 500U) << loss;
        EXPECT_GT(world.b().received.size(), 500U) << loss;
    }
}

TEST(Association, HealsWithinASecondOfAnOutage)
{
    for (const base::Duration outage :
         {base::Duration{1500ms}, base::Duration{20s}, base::Duration{3700s}}) {
        World world{one, two};
        world.run(1s);
        world.network().loss = 1.0;
        if (outage > Association::key_lasts) world.skip(outage); // both were asleep
        world.run(outage > Association::key_lasts ? base::Duration{2s} : outage);
        world.network().loss = 0.0;
        const std::size_t before = world.b().received.size();
        world.run(1s);
        EXPECT_GT(world.b().received.size(), before + 300) << outage.count();
    }
}

TEST(Association, MeetsAPeerThatWasRestartedAndTellsTheRunsApart)
{
    World world{one, two};
    world.run(2s);
    Setting again = two;
    again.run = 33;
    again.seed = 201;
    world.b() = World::side(again);
    world.run(3s);
    EXPECT_EQ(world.a().session, session_of(11, 33));
    EXPECT_GT(world.a().received.size(), 1500U);
    EXPECT_GT(world.b().received.size(), 1500U);
    EXPECT_EQ(world.a().association->counts().handshakes, 2U);
    EXPECT_EQ(world.a().association->counts().rekeys, 0U);
}

TEST(Association, MeetsAPeerWhoseDateWentBack)
{
    for (const int which : {0, 1}) {
        World world{one, two};
        world.run(2s);
        Setting again = which == 0 ? one : two;
        again.run = 33;
        again.seed = 201;
        Side& side = which == 0 ? world.a() : world.b();
        side = World::side(again);
        side.unix_offset_ns = -3600'000'000'000;
        world.run(12s);
        EXPECT_GT(world.a().received.size(), 4000U) << which;
        EXPECT_GT(world.b().received.size(), 4000U) << which;
    }
}

TEST(Association, MeetsThoughBothDatesWentBackAndInitiationsOfFormerRunsCame)
{
    const auto withheld = withheld_initiations(one, two);
    World world{one, two};
    world.a() = restarted(one, 33);
    world.b() = restarted(two, 44);
    for (int to : {0, 1}) {
        const auto& initiations = withheld.at(static_cast<std::size_t>(to));
        ASSERT_GT(initiations.size(), 2U);
        world.give(to, initiations.back(), place_of(66));
    }
    world.run(12s);
    EXPECT_GT(world.a().received.size(), 4000U);
    EXPECT_GT(world.b().received.size(), 4000U);
}

TEST(Association, MeetsWhileInitiationsOfFormerRunsKeepComing)
{
    const auto withheld = withheld_initiations(one, two);
    World world{one, two};
    world.a() = restarted(one, 33);
    world.b() = restarted(two, 44);
    for (int i = 0; i < 20'000; i += 10) {
        for (const int to : {0, 1})
            world.give(to, withheld.at(static_cast<std::size_t>(to)).back(), place_of(66));
        world.run(10ms);
    }
    EXPECT_GT(world.a().received.size(), 8000U);
    EXPECT_GT(world.b().received.size(), 8000U);
}

TEST(Association, MeetsAtOnceAmongInitiationsOfFormerRunsWhenItsDateIsRight)
{
    std::vector<Text> withheld; // of several runs, the newest first
    for (std::uint8_t run = 12; run-- > 0;) {
        Setting former = one;
        former.run = 100U + run;
        former.seed = run;
        const auto found = withheld_initiations(former, two);
        withheld.insert(withheld.end(), found[1].rbegin(), found[1].rend());
    }
    World world{one, two, {.delay = 150ms}};
    world.skip(3600s);
    for (int i = 0; i < 2000; i += 10) {
        world.give(1, withheld[static_cast<std::size_t>(i / 10) % withheld.size()], place_of(66));
        world.run(10ms);
    }
    EXPECT_GT(world.a().received.size(), 1000U);
    EXPECT_GT(world.b().received.size(), 1000U);
    EXPECT_EQ(world.b().association->counts().handshakes, 1U);
}

TEST(Association, MeetsWithinSecondsThoughInitiationsOfMoreRunsThanItRemembersComeInTurn)
{
    std::array<std::vector<Text>, 2> withheld;
    for (std::uint8_t run = 0; run < InitiationDates::runs_max + 2; ++run) {
        Setting former_one = one, former_two = two;
        former_one.run = 100U + run;
        former_one.seed = run;
        former_two.run = 200U + run;
        former_two.seed = static_cast<std::uint8_t>(100 + run);
        const auto found = withheld_initiations(former_one, former_two, 6s);
        for (const std::size_t to : {0U, 1U}) withheld.at(to).push_back(found.at(to).front());
    }
    for (const bool dates_are_right : {true, false}) {
        World world{one, two};
        world.a() = restarted(one, 33);
        world.b() = restarted(two, 44);
        if (dates_are_right) world.skip(7200s);
        for (std::size_t i = 0; i < 12; ++i) {
            for (const std::size_t to : {0U, 1U})
                world.give(static_cast<int>(to), withheld.at(to).at(i), place_of(66));
            world.run(1s);
        }
        EXPECT_GT(world.a().received.size(), 500U) << dates_are_right;
        EXPECT_GT(world.b().received.size(), 500U) << dates_are_right;
    }
}

TEST(Association, AnswersAnInitiationOfAFormerRunOnceHoweverOftenItComes)
{
    const auto withheld = withheld_initiations(one, two);
    World world{one, two};
    world.a().association.reset();
    for (int i = 0; i < 30'000; i += 50) {
        const Text& newest = withheld[1].back();
        const Text& older = withheld[1].front();
        world.give(1, i / 50 % 2 == 0 ? newest : older, place_of(66));
        world.run(50ms);
    }
    const auto responses = of_type(world, 0, FrameType::response);
    const std::set<Text> different{responses.begin(), responses.end()};
    EXPECT_EQ(different.size(), 1U);
}

TEST(Association, TakesNothingTwice)
{
    World world{one, two};
    world.run(2s);
    const auto everything = world.seen();
    const std::size_t received = world.b().received.size();
    const std::uint64_t hellos = world.b().hellos, roamed = world.b().association->counts().roamed;
    for (const Datagram& each : everything)
        if (each.to == 1) world.give(1, each.bytes, each.from);
    EXPECT_EQ(world.b().received.size(), received + 5); // the datagrams that were on their way
    EXPECT_EQ(world.b().hellos, hellos);
    EXPECT_EQ(world.b().association->counts().roamed, roamed);
    EXPECT_GT(world.b().association->counts().replayed, 1900U);
    world.run(1s);
    EXPECT_EQ(world.b().association->counts().handshakes, 1U);
    EXPECT_GT(world.b().received.size(), received + 900);
}

TEST(Association, TakesNothingOfAnEarlierRun)
{
    World earlier{one, two};
    earlier.run(2s);
    Setting later_one = one, later_two = two;
    later_one.run = 44;
    later_one.seed = 101;
    later_two.run = 55;
    later_two.seed = 202;
    World world{later_one, later_two};
    world.a().unix_offset_ns = world.b().unix_offset_ns = 10'000'000'000;
    world.run(1s);
    const std::size_t received = world.b().received.size();
    for (const Datagram& each : earlier.seen())
        if (each.to == 1) world.give(1, each.bytes, each.from);
    EXPECT_EQ(world.b().received.size(), received);
    world.run(1s);
    EXPECT_GT(world.b().received.size(), received + 900);
    EXPECT_EQ(world.b().association->counts().handshakes, 1U);
    EXPECT_GT(world.b().association->counts().unknown_key, 1900U);
}

TEST(Association, DropsWhatAFormerRunStillHadOnItsWayOnceThePresentOneIsHeard)
{
    World world{one, two};
    world.run(2s);
    const std::size_t delivered = world.seen().size();
    world.network().loss = 1.0;
    world.run(100ms);
    std::vector<Datagram> late;
    for (std::size_t i = delivered; i < world.seen().size(); ++i)
        if (world.seen()[i].to == 0) late.push_back(world.seen()[i]);
    ASSERT_GT(late.size(), 90U);
    world.network().loss = 0.0;
    Setting again = two;
    again.run = 33;
    again.seed = 201;
    world.b() = World::side(again);
    world.run(3s);
    ASSERT_EQ(world.a().session, session_of(11, 33));
    const std::size_t received = world.a().received.size();
    const std::uint64_t unknown = world.a().association->counts().unknown_key;
    for (const Datagram& each : late) world.give(0, each.bytes, each.from);
    EXPECT_EQ(world.a().received.size(), received);
    EXPECT_EQ(world.a().association->counts().unknown_key, unknown + late.size());
}

TEST(Association, GivesACapturedAndWithheldInitiationOneAnswerAndKeepsItsKey)
{
    World world{one, two};
    world.run(1s);
    // Side 1 hears nothing, so it sends an initiation, which is captured and never arrives.
    world.network().loss = 1.0;
    world.run(1500ms);
    world.network().loss = 0.0;
    const Text captured = of_type(world, 1, FrameType::initiation).back();
    world.run(2s);
    const std::size_t answers = of_type(world, 0, FrameType::response).size();
    const std::size_t received = world.b().received.size();
    world.give(1, captured, place_of(66));
    world.run(2s);
    EXPECT_LE(of_type(world, 0, FrameType::response).size(), answers + 3);
    EXPECT_GT(world.b().received.size(), received + 1900); // under its earlier key
    EXPECT_EQ(world.b().association->place(), place_of(1));
}

TEST(Association, DropsForgedStatesAtOnceAndIsNotMoved)
{
    World world{one, two};
    world.run(1s);
    const Text genuine = of_type(world, 1, FrameType::state).back();
    const std::size_t received = world.b().received.size();
    for (std::size_t i = 20; i < genuine.size(); ++i) {
        Text forged = genuine;
        base::ByteWriter{std::span{forged}.subspan(8)}.u32(1'000'000);
        forged[i] ^= std::byte{4};
        world.give(1, forged, place_of(66));
    }
    EXPECT_EQ(world.b().association->counts().forged, genuine.size() - 20);
    EXPECT_EQ(world.b().received.size(), received);
    EXPECT_EQ(world.b().association->place(), place_of(1));
    world.run(1s);
    EXPECT_GT(world.b().received.size(), received + 900);
}

TEST(Association, TakesNoPlainMessage)
{
    World world{one, two};
    world.run(1s);
    const std::uint64_t hellos = world.b().hellos;
    world.give(1, hello(), place_of(1));
    world.give(1, state(session_of(11, 22), 5000), place_of(1));
    Text bye = hello();
    bye[3] = std::byte{3};
    bye.resize(9);
    world.give(1, bye, place_of(1));
    EXPECT_EQ(world.b().association->counts().unsealed, 3U);
    EXPECT_EQ(world.b().hellos, hellos);
}

TEST(Association, FollowsAPeerThatComesFromElsewhereUnlessItMayNot)
{
    for (const bool may_roam : {true, false}) {
        Setting stays = two;
        stays.may_roam = may_roam;
        World world{one, stays};
        world.run(1s);
        world.a().place = place_of(50);
        world.run(1s);
        EXPECT_EQ(world.b().association->place(), place_of(may_roam ? 50 : 1));
        EXPECT_EQ(world.b().association->counts().roamed, may_roam ? 1U : 0U);
        EXPECT_EQ(world.a().received.back() > 1500, may_roam);
    }
}

TEST(Association, FollowsAPeerThatIsStartedAgainElsewhere)
{
    for (const bool may_roam : {true, false}) {
        Setting stays = two;
        stays.may_roam = may_roam;
        World world{one, stays};
        world.run(2s);
        Setting again = one;
        again.run = 33;
        again.seed = 201;
        world.a() = World::side(again);
        world.a().place = place_of(50);
        world.run(8s);
        EXPECT_EQ(world.b().association->place(), place_of(may_roam ? 50 : 1));
        EXPECT_EQ(world.a().received.size() > 1000, may_roam);
    }
}

TEST(Association, KeepsOneOfTwoProgramsWithTheSameKeyForFiveSeconds)
{
    World world{one, two};
    world.run(2s);
    Setting second = one;
    second.run = 33;
    second.seed = 201;
    const auto rival = association(second);
    const std::size_t before = of_type(world, 0, FrameType::response).size();
    std::size_t answers = 0;
    for (int i = 0; i < 6000; ++i) {
        rival->tick({world.now(), world.now().time_since_epoch().count() + 1'000'000});
        while (const auto out = rival->poll()) {
            world.give(1, Text{out->frame.bytes().begin(), out->frame.bytes().end()}, place_of(66));
        }
        world.run(1ms);
        if (i == 2500) answers = of_type(world, 0, FrameType::response).size();
    }
    EXPECT_EQ(answers, before);
    EXPECT_GT(of_type(world, 0, FrameType::response).size(), answers);
    EXPECT_GT(world.b().received.size(), 7500U); // the rival never confirms its key
}

TEST(Association, ConfirmsAKeyThatItBeganAlsoWhenItHasNothingToSay)
{
    World world{one, two};
    world.a().talks = false; // the initiator
    world.run(200ms);
    EXPECT_GT(world.a().hellos, 0U);
    const auto hellos_of_a = of_type(world, 1, FrameType::hello);
    ASSERT_FALSE(hellos_of_a.empty());
    EXPECT_EQ(hellos_of_a.front().size(), empty_bytes + control_overhead);
    EXPECT_LT(hellos_of_a.size(), 3U); // until it received something
    EXPECT_EQ(world.b().hellos, 0U);   // they do not count as messages
}

TEST(Association, IsFoundByAPeerWhosePlaceNobodySaid)
{
    Setting waits = one;
    waits.knows_place = false;
    World world{waits, two};
    world.run(1s);
    EXPECT_GT(world.a().received.size(), 900U);
    EXPECT_GT(world.b().received.size(), 900U);
}

TEST(Association, AsksForACookieWhenManyInitiationsComeAndStillMeetsTheOther)
{
    World world{one, two};
    world.run(1s);
    // An attacker holds many genuine initiations that never arrived, and sends them from elsewhere.
    std::vector<Text> captured;
    for (std::uint8_t i = 0; i < 60; ++i) {
        Setting setting = one;
        setting.seed = static_cast<std::uint8_t>(i + 2);
        const auto source = association(setting);
        base::TimePoint now;
        std::optional<Association::Outgoing> out;
        for (int tick = 0; tick < 10 && !(out = source->poll()); ++tick)
            source->tick({now += 1ms, -1'000'000'000});
        ASSERT_TRUE(out);
        captured.emplace_back(out->frame.bytes().begin(), out->frame.bytes().end());
    }
    for (const Text& each : captured) {
        world.give(1, each, place_of(66));
        world.run(2ms);
    }
    EXPECT_GT(world.b().association->counts().cookies, 20U);
    EXPECT_EQ(world.b().association->counts().handshakes, 1U);
    // The other side, restarted during the attack, gets in with a cookie of its own.
    Setting again = one;
    again.run = 33;
    again.seed = 222;
    world.a() = World::side(again);
    const std::uint64_t cookies = world.b().association->counts().cookies;
    for (std::size_t i = 0; i < 160; ++i) {
        world.give(1, captured[i % captured.size()], place_of(66));
        world.run(10ms);
    }
    EXPECT_GT(world.b().association->counts().cookies, cookies);
    EXPECT_EQ(world.b().session, session_of(33, 22));
}

TEST(Association, AnswersAnInitiationWithAtMostThreeResponses)
{
    World world{one, two};
    world.b().talks = false; // and what the initiator sends afterwards is lost
    world.run(20ms);
    const Text initiation = of_type(world, 1, FrameType::initiation).front();
    World other{one, two};
    other.network().loss = 1.0;
    other.give(1, initiation, place_of(66));
    other.run(900ms);
    EXPECT_EQ(of_type(other, 0, FrameType::response).size(), 3U);
}

TEST(Association, SaysNothingToWhoDoesNotKnowThePreSharedKey)
{
    World world{one, two};
    Setting stranger = one;
    stranger.shared = 8;
    const auto source = association(stranger);
    std::optional<Association::Outgoing> out;
    for (int tick = 0; tick < 10 && !(out = source->poll()); ++tick)
        source->tick({base::TimePoint{tick * 1ms}, 5});
    ASSERT_TRUE(out);
    world.a().association.reset();
    world.give(1, Text{out->frame.bytes().begin(), out->frame.bytes().end()}, place_of(66));
    world.run(500ms);
    EXPECT_TRUE(of_type(world, 0, FrameType::response).empty());
    EXPECT_TRUE(of_type(world, 0, FrameType::cookie).empty());
    EXPECT_EQ(world.b().association->counts().other_circle, 1U);
}

} // namespace hapnet::secure
