// SPDX-FileCopyrightText: 2026 The Hapnet authors
// SPDX-License-Identifier: MIT
#include "emulator/tools/verify/losses.hpp"

#include <gtest/gtest.h>

namespace hapnet::emulator::tools {
namespace {

TEST(TestUnrelated, CannotTellWithoutADatagram)
{
    EXPECT_EQ(test_unrelated(PairTally{}, 0.0, 1e-6).outcome, Outcome::unable);
}

TEST(TestUnrelated, FindsDirectionsThatLoseTheSame)
{
    PairTally alike;
    PairTally apart;
    for (int i = 0; i < 4000; ++i) {
        alike.add(i % 4 == 0, i % 4 == 0);
        apart.add(i % 4 == 0, i / 4 % 4 == 0);
    }
    EXPECT_EQ(test_unrelated(alike, 0.0, 1e-6).outcome, Outcome::failed);
    EXPECT_EQ(test_unrelated(apart, 0.0, 1e-6).outcome, Outcome::passed);
}

} // namespace
} // namespace hapnet::emulator::tools
