// SPDX-FileCopyrightText: 2026 The Hapnet authors
// SPDX-License-Identifier: MIT

// Handshakes under a flood of forged handshake messages, by attackers who see every datagram and
// know both public keys.

#include "proto/secure/association.hpp"

#include "proto/secure/door.hpp"
#include "tests/unit/proto/secure/circle.hpp"

#include <array>
#include <gtest/gtest.h>
#include <string_view>
#include <vector>

namespace hapnet::secure::association_flood_test {

namespace {

using namespace circle;

/// The key of the first MAC, as docs/formats/sealed.md has it.
Hash mac1_key(const Secret& secret, std::uint8_t receiver)
{
    constexpr std::string_view words = "hapnet mac1: ";
    Text known;
    for (const char c : words) known.push_back(static_cast<std::byte>(c));
    known.insert(known.end(), secret.bytes().begin(), secret.bytes().end());
    return hash(known, public_key_of(secret_of(receiver)));
}

/// Sends forged initiations and responses to both sides of a world.
class Forger {
public:
    /// `shared` names the pre-shared key that he uses as the circle's.
    Forger(World& world, std::uint8_t shared, std::uint64_t seed)
        : world_{world},
          random_{base::Seed{seed}.stream("forger")},
          keys_{mac1_key(secret_of(shared), 1), mac1_key(secret_of(shared), 2)},
          jars_{CookieJar{keys_[0]}, CookieJar{keys_[1]}}
    {}

    /// Sends `count` of each kind to each side.
    void send(int count)
    {
        look();
        for (int i = 0; i < count; ++i) {
            for (const int to : {0, 1}) {
                forge_initiation(to);
                forge_response(to);
            }
        }
    }
    [[nodiscard]] std::uint64_t sent_to(int side) const { return sent_[index(side)]; }

private:
    static std::size_t index(int side) { return static_cast<std::size_t>(side); }
    static std::uint8_t id_of(int side) { return static_cast<std::uint8_t>(side + 1); }

    /// He takes the cookies from the answers to his initiations, and sees which handshakes wait.
    void look()
    {
        for (; looked_at_ < world_.seen().size(); ++looked_at_) {
            const Datagram& datagram = world_.seen()[looked_at_];
            const std::size_t from = index(1 - datagram.to);
            if (const auto initiation = read_initiation(datagram.bytes))
                waits_[from] = initiation->sender;
            if (const auto reply = read_cookie_reply(datagram.bytes))
                jars_[from].take(*reply, mac1_sent_[from], world_.now());
        }
    }

    Text noise(std::size_t size)
    {
        Text bytes(size);
        for (std::byte& each : bytes) each = static_cast<std::byte>(random_.below(256, drawn_++));
        return bytes;
    }

    void give(int to, HandshakeFrame& frame)
    {
        frame.set_macs(keys_[index(to)], jars_[index(to)].cookie(world_.now()));
        const Bytes bytes = frame.bytes();
        world_.give(to, Text{bytes.begin(), bytes.end()}, place_of(id_of(1 - to)));
        ++sent_[index(to)];
    }

    void forge_initiation(int to)
    {
        auto frame =
            HandshakeFrame::initiation(static_cast<KeyIndex>(random_.bits(drawn_++)),
                                       {id_of(1 - to), id_of(to)}, noise(initiation_noise_bytes));
        give(to, frame);
        mac1_sent_[index(to)] = Text{frame.mac1().begin(), frame.mac1().end()};
    }

    void forge_response(int to)
    {
        auto frame = HandshakeFrame::response(waits_[index(to)],
                                              static_cast<KeyIndex>(random_.bits(drawn_++)),
                                              noise(response_noise_bytes));
        give(to, frame);
    }

    World& world_;
    base::RandomStream random_;
    std::uint64_t drawn_ = 0;
    std::array<Hash, 2> keys_;
    std::array<CookieJar, 2> jars_;
    std::array<KeyIndex, 2> waits_{};
    std::array<Text, 2> mac1_sent_;
    std::array<std::uint64_t, 2> sent_{};
    std::size_t looked_at_ = 0;
};

/// `seed` is the seed of both sides' draws.
Setting one_of(std::uint8_t shared, std::uint8_t seed = 100)
{
    return {.id = 1, .run = 11, .shared = shared, .seed = seed};
}
Setting two_of(std::uint8_t shared, std::uint8_t seed = 100)
{
    return {.id = 2, .run = 22, .shared = shared, .seed = static_cast<std::uint8_t>(seed + 100)};
}

bool have_met(World& world) { return !world.a().received.empty() && !world.b().received.empty(); }

/// Plays until both have received a state of the other.
base::Duration time_to_meet(World& world)
{
    const base::TimePoint began = world.now();
    while (!have_met(world) && world.now() - began < 8s) world.run(1ms);
    return world.now() - began;
}

/// As above, with 1000 forged initiations and 1000 forged responses a second to each side: evenly,
/// or 20 of each in every twentieth millisecond.
base::Duration time_to_meet(World& world, Forger& forger, int in_a_burst)
{
    const base::TimePoint began = world.now();
    for (int ms = 0; !have_met(world) && world.now() - began < 8s; ++ms) {
        if (ms % in_a_burst == 0) forger.send(in_a_burst);
        world.run(1ms);
    }
    return world.now() - began;
}

constexpr std::uint8_t none = 0, the_circles = 9;

} // namespace

TEST(AssociationFlood, OfForgedHandshakesByAnObserverDelaysNothingAndIsCounted)
{
    for (const std::uint8_t shared : {none, the_circles}) {
        World alone{one_of(shared), two_of(shared)};
        const base::Duration undisturbed = time_to_meet(alone);
        ASSERT_LT(undisturbed, 60ms);
        for (const int in_a_burst : {1, 20}) {
            World world{one_of(shared), two_of(shared)};
            Forger observer{world, none, 1};
            EXPECT_EQ(time_to_meet(world, observer, in_a_burst), undisturbed);
            EXPECT_EQ(world.a().association->counts().other_circle, observer.sent_to(0));
            EXPECT_EQ(world.b().association->counts().other_circle, observer.sent_to(1));
        }
    }
}

TEST(AssociationFlood, OfForgedHandshakesByAMemberOfTheCircleDelaysThemByASecondAtMost)
{
    for (std::uint8_t seed = 0; seed < 50; ++seed) {
        for (const int in_a_burst : {1, 20}) {
            World world{one_of(the_circles, seed), two_of(the_circles, seed)};
            Forger member{world, the_circles, seed};
            EXPECT_LT(time_to_meet(world, member, in_a_burst), 1s) << +seed << ' ' << in_a_burst;
        }
    }
}

TEST(AssociationFlood, OfForgedHandshakesIsInTheCountersWhole)
{
    World world{one_of(the_circles), two_of(the_circles)};
    Forger member{world, the_circles, 1};
    std::ignore = time_to_meet(world, member, 1);
    for (int ms = 0; ms < 500; ++ms) { // and with a key in use
        member.send(1);
        world.run(1ms);
    }
    world.run(20ms); // so that waiting ones are read
    for (const int side : {0, 1}) {
        const auto& counts = (side == 0 ? world.a() : world.b()).association->counts();
        EXPECT_GE(counts.refused + counts.unread + counts.cookies, member.sent_to(side)) << side;
        EXPECT_GT(counts.refused, 100U) << side;
        EXPECT_EQ(counts.handshakes, 1U) << side;
    }
}

TEST(AssociationFlood, OfForgedHandshakesLosesNoMessageWhenTheKeyIsRenewed)
{
    World world{one_of(the_circles), two_of(the_circles)};
    world.run(109s);
    const std::uint64_t not_sealed = world.a().association->counts().not_sealed;
    Forger member{world, the_circles, 1};
    for (int ms = 0; ms < 3000; ++ms) {
        member.send(1);
        world.run(1ms);
    }
    EXPECT_EQ(world.a().association->counts().not_sealed, not_sealed);
    for (Side* side : {&world.a(), &world.b()}) {
        EXPECT_EQ(side->association->counts().rekeys, 1U);
        EXPECT_EQ(side->received.back() - side->received.front() + 1, side->received.size());
        EXPECT_GT(side->received.size(), 111'000U);
    }
}

} // namespace hapnet::secure::association_flood_test
