// SPDX-FileCopyrightText: 2026 The Hapnet authors
// SPDX-License-Identifier: MIT
//
// The release preset is GCC's, the sanitizers' Clang's: both have to find these hashes.
#include "tests/bits/plays.hpp"

#include <gtest/gtest.h>

namespace hapnet::bits {
namespace {

constexpr std::uint64_t ticks = 2000;

TEST(Bits, OfEveryPlayAreWhatTheyWere)
{
    constexpr std::array<std::uint64_t, 14> expected{
        14321848946707154373U, 3076168221644795926U,  11627184925991624825U, 1178515063486952007U,
        13975102021259834571U, 11627184925991624825U, 14805463268951395154U, 7500231364481280554U,
        2927053599196101393U,  5844480766261163873U,  14630964471508297247U, 3917931420436053734U,
        10914011137890493923U, 8773640621103334314U};
    for (std::size_t i = 0; i < plays().size(); ++i) {
        EXPECT_EQ(hash_after(plays()[i], ticks), expected.at(i)) << plays()[i].scene;
    }
}

TEST(Bits, AreTheSameOverSnapshots)
{
    for (const Play& play : plays()) {
        EXPECT_EQ(hash_over_snapshots(play, ticks, 250), hash_after(play, ticks)) << play.scene;
    }
}

} // namespace
} // namespace hapnet::bits
