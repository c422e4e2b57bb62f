// SPDX-FileCopyrightText: 2026 The Hapnet authors
// SPDX-License-Identifier: MIT
// The paper's algorithm with its named defaults, bit by bit. Two peers have hands on straight
// lines, and a path that delays, reorders, duplicates and loses. Only the peers' core and the scene
// can change the bits.
#include "tests/sim/peer/core/letters.hpp"

#include <bit>

namespace hapnet::peer {
namespace {

class Bits {
public:
    void add(const glm::dvec3& v)
    {
        for (const double part : {v.x, v.y, v.z}) {
            hash_ = (hash_ ^ std::bit_cast<std::uint64_t>(part)) * 0x100000001b3U;
            hash_ ^= hash_ >> 32;
        }
    }
    [[nodiscard]] std::uint64_t value() const { return hash_; }

private:
    std::uint64_t hash_ = 0xcbf29ce484222325U;
};

/// Approaches, pushes, turns back and leaves, repeatedly; the period is in ticks.
Hand hand_at(double side, int tick, int period)
{
    const int phase = tick % period;
    const bool comes = phase < period / 2;
    const double way = 0.06 * (comes ? phase : period - phase) / period; // up to 30 mm
    const double speed = (comes ? 1.0 : -1.0) * 0.06 * 1000.0 / period;
    return {.hip = {{side * (0.045 - way), 0.002, 0.001}}, .velocity = {{-side * speed, 0.0, 0.0}}};
}

TEST(BaseAlgorithm, HasTheBitsThatItHadBeforeItHadOptions)
{
    std::array<std::unique_ptr<Peer>, 2> peers{std::make_unique<Peer>(settings_of(0)),
                                               std::make_unique<Peer>(settings_of(1))};
    Letters letters{{}};
    Bits bits;
    base::TimePoint now{1h};
    int touched_by_both = 0;
    for (int tick = 0; tick < 18'000; ++tick) {
        now += 1ms;
        letters.deliver(peers, now);
        std::array<bool, 2> touching{};
        for (const std::size_t side : {0U, 1U}) {
            Peer& peer = *peers.at(side);
            const Tick done =
                peer.tick(now, side == 0 ? hand_at(-1.0, tick, 700) : hand_at(1.0, tick, 1900));
            touching.at(side) = done.touched.touching;
            while (const auto datagram = peer.poll()) letters.send(1 - side, *datagram, now);
            bits.add(peer.body().position.value);
            bits.add(peer.body().velocity.value);
            bits.add(done.force.value);
            bits.add(done.remote_force.value);
        }
        if (touching[0] && touching[1]) ++touched_by_both;
    }
    EXPECT_GT(touched_by_both, 1000);
    EXPECT_EQ(bits.value(), 14789214864424001721U);
}

} // namespace
} // namespace hapnet::peer
