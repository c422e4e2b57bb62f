// SPDX-FileCopyrightText: 2026 The Hapnet authors
// SPDX-License-Identifier: MIT
// Whatever the other side sends, this hand must not be harmed.
#include "device/governor.hpp"
#include "proto/base/random.hpp"
#include "tests/property/proto/wire/random_message.hpp"
#include "tests/unit/peer/core/pair.hpp"

namespace hapnet::peer {
namespace {

/// A datagram of the kinds that an enemy, or a broken network, might send in this tick.
std::vector<std::byte> nonsense(const base::RandomStream& stream, std::uint64_t round,
                                const wire::State& genuine)
{
    wire::Message message = wire::RandomMessage{stream, round}.message();
    const auto kind = stream.below(4, round, 1000);
    if (kind != 0) { // a well-formed state of this session, with wild contents
        wire::State state = genuine;
        state.sequence += 1000 + static_cast<std::uint32_t>(round);
        state.touching = stream.below(2, round, 1001) == 0;
        state.holding = false;
        const auto wild = [&](std::uint32_t draw, double most) {
            return most * (2.0 * stream.uniform(round, draw) - 1.0);
        };
        state.contact_force = {{wild(1002, 1e30), wild(1003, 1e30), wild(1004, 1e3)}};
        wire::BodyState& body = state.bodies.add(wire::BodyState{});
        body.position = {{wild(1005, 0.1), wild(1006, 0.1), wild(1007, 12.0)}};
        body.velocity = {{wild(1008, 1000.0), wild(1009, 1.0), wild(1010, 1000.0)}};
        message = state;
    }
    const auto datagram = wire::encode(message);
    std::vector<std::byte> bytes{datagram.bytes().begin(), datagram.bytes().end()};
    if (kind == 1) {
        const auto at = stream.below(static_cast<std::uint32_t>(bytes.size()), round, 1011);
        bytes[at] = static_cast<std::byte>(stream.bits(round, 1012) & 0xffU);
    }
    return bytes;
}

TEST(HostileRemote, NeverMakesAForceThatIsNotFiniteOrExceedsThePeak)
{
    for (std::uint64_t seed = 0; seed < 20; ++seed) {
        const auto stream = base::Seed{seed}.stream("hostile");
        Pair pair;
        pair.run_until_started();
        device::Governor governor{{}};
        device::Sample sample;
        const wire::State genuine = pair.state_sent_by(1).value();
        double felt = 0.0;
        for (std::uint64_t round = 0; round < 2000; ++round) {
            const auto bytes = nonsense(stream, round, genuine);
            pair.peers[0]->on_datagram(bytes, pair.now);
            pair.hands[0] = pushing(0.003 * stream.uniform(round / 100, 2000));
            pair.hands[0].gripping = stream.below(4, round / 100, 2001) == 0;
            pair.step();
            ++sample.sequence;
            const base::Force force =
                governor.govern({pair.ticks[0].force, pair.ticks[0].permitted}, sample, pair.now)
                    .force();
            ASSERT_TRUE(base::is_finite(pair.ticks[0].force)) << seed << " " << round;
            ASSERT_LE(base::norm(force), 3.3 + 1e-12) << seed << " " << round;
            ASSERT_TRUE(base::is_finite(pair.peers[0]->body().position));
            ASSERT_LE(base::norm(pair.ticks[0].remote_force), 3.3 + 1e-12);
            felt = std::max(felt, base::norm(force));
        }
        EXPECT_GT(felt, 0.0) << seed;
        EXPECT_GT(pair.peers[0]->counters().implausible, 10U) << seed;
        EXPECT_GT(pair.peers[0]->counters().malformed, 10U) << seed;
        EXPECT_FALSE(pair.peers[0]->refusal()) << seed;
    }
}

TEST(HostileRemote, DoesNotStopAPeerThatIsStillWaiting)
{
    // All but hellos and goodbyes with a refusal, which are meant to end the session.
    for (std::uint64_t seed = 0; seed < 20; ++seed) {
        const auto stream = base::Seed{seed}.stream("waiting");
        Peer peer{settings_of(0)};
        base::TimePoint now{1h};
        for (std::uint64_t round = 0; round < 2000; ++round) {
            now += 1ms;
            const wire::Message message = wire::RandomMessage{stream, round}.message();
            if (!std::holds_alternative<wire::State>(message)) continue;
            peer.on_datagram(wire::encode(message).bytes(), now);
            const Tick tick = peer.tick(now, pushing(0.002));
            ASSERT_EQ(tick.phase, Phase::waiting);
            ASSERT_EQ(tick.force, base::Force{});
            while (peer.poll()) {}
        }
        EXPECT_GT(peer.counters().other_session, 300U);
    }
}

} // namespace
} // namespace hapnet::peer
