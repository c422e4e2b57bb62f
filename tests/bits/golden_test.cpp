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
    constexpr std::array<std::uint64_t, 12> expected{
        14321848946707154373U, 18436822420730799107U, 13724333412465408846U, 4749924312877079099U,
        13975102021259834571U, 13724333412465408846U, 1784756505501281087U,  7500231364481280554U,
        2927053599196101393U,  6220399393403758261U,  14126382730977383505U, 8530369016186227628U};
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
