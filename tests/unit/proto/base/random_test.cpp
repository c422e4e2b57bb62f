// SPDX-FileCopyrightText: 2026 The Hapnet authors
// SPDX-License-Identifier: MIT
#include "proto/base/random.hpp"

#include <array>
#include <gtest/gtest.h>

namespace hapnet::base {
namespace {

using Words4 = std::array<std::uint32_t, 4>;

/// Philox-4x32-10, written again from the paper (Salmon et al., SC 2011), so that a stream is
/// checked against the algorithm and not against the library that it uses.
Words4 philox(Words4 counter, std::uint64_t key)
{
    auto key0 = static_cast<std::uint32_t>(key);
    auto key1 = static_cast<std::uint32_t>(key >> 32);
    for (int round = 0; round < 10; ++round) {
        const std::uint64_t product0 = std::uint64_t{0xD2511F53} * counter[0];
        const std::uint64_t product1 = std::uint64_t{0xCD9E8D57} * counter[2];
        counter = {static_cast<std::uint32_t>(product1 >> 32) ^ counter[1] ^ key0,
                   static_cast<std::uint32_t>(product1),
                   static_cast<std::uint32_t>(product0 >> 32) ^ counter[3] ^ key1,
                   static_cast<std::uint32_t>(product0)};
        key0 += 0x9E3779B9;
        key1 += 0xBB67AE85;
    }
    return counter;
}

std::uint64_t pair(std::uint32_t low, std::uint32_t high)
{
    return std::uint64_t{high} << 32 | low;
}

TEST(Random, TheAlgorithmGivesTheKnownAnswersOfItsAuthors) // Random123 kat_vectors
{
    EXPECT_EQ(philox({0, 0, 0, 0}, 0), (Words4{0x6627e8d5, 0xe169c58d, 0xbc57ac4c, 0x9b00dbd8}));
    EXPECT_EQ(philox({~0U, ~0U, ~0U, ~0U}, ~std::uint64_t{0}),
              (Words4{0x408f276d, 0x41c83b0e, 0xa20bc7c6, 0x6d5451fd}));
    EXPECT_EQ(philox({0x243f6a88, 0x85a308d3, 0x13198a2e, 0x03707344}, 0x299f31d0'a4093822),
              (Words4{0xd16cfe09, 0x94fdcceb, 0x5001e420, 0x24126ea1}));
}

TEST(Random, AStreamIsTheAlgorithmKeyedBySeedAndName)
{
    constexpr std::uint64_t seed = 42;
    constexpr std::uint64_t hash_of_a = 0xaf63dc4c8601ec8c; // FNV-1a of "a", as published
    const Words4 stream_key = philox(
        {static_cast<std::uint32_t>(hash_of_a), static_cast<std::uint32_t>(hash_of_a >> 32), 0, 1},
        seed);
    const Words4 block = philox({5, 1, 7, stream_key[2]}, pair(stream_key[0], stream_key[1]));
    EXPECT_EQ(Seed{seed}.stream("a").bits(pair(5, 1), 7), pair(block[0], block[1]));
}

TEST(Random, ADrawDependsOnSeedNameIndexAndDrawAndOnNothingElse)
{
    const RandomStream stream = Seed{42}.stream("up/loss");
    const auto first = stream.bits(7);
    std::ignore = stream.bits(8);
    EXPECT_EQ(stream.bits(7), first);
    EXPECT_EQ(Seed{42}.stream("up/loss").bits(7), first);
    EXPECT_NE(Seed{43}.stream("up/loss").bits(7), first);
    EXPECT_NE(Seed{42}.stream("down/loss").bits(7), first);
    EXPECT_NE(stream.bits(8), first);
    EXPECT_NE(stream.bits(7, 1), first);
}

TEST(Random, EveryBitOfSeedAndIndexCounts)
{
    const RandomStream stream = Seed{0}.stream("x");
    for (int bit = 0; bit < 64; ++bit) {
        const auto one = std::uint64_t{1} << bit;
        EXPECT_NE(stream.bits(one), stream.bits(0)) << bit;
        EXPECT_NE(Seed{one}.stream("x").bits(0), stream.bits(0)) << bit;
    }
}

TEST(Random, UniformIsTheHighBitsOfTheDraw)
{
    const RandomStream stream = Seed{1}.stream("x");
    for (std::uint64_t i = 0; i < 1000; ++i) {
        EXPECT_EQ(stream.uniform(i),
                  static_cast<double>(stream.bits(i) >> 11) / 9007199254740992.0);
        EXPECT_LT(stream.uniform(i), 1.0);
    }
}

TEST(Random, BelowOneIsAlwaysZeroAndBelowNothingIsZeroToo)
{
    const RandomStream stream = Seed{1}.stream("x");
    for (std::uint64_t i = 0; i < 100; ++i) {
        EXPECT_EQ(stream.below(1, i), 0U);
        EXPECT_EQ(stream.below(0, i), 0U);
        EXPECT_LT(stream.below(0xffffffff, i), 0xffffffffU);
    }
}

} // namespace
} // namespace hapnet::base
