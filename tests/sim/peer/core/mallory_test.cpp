// SPDX-FileCopyrightText: 2026 The Hapnet authors
// SPDX-License-Identifier: MIT
// Sessions under an attacker who owns the path, on networks as bad as they come.
#include "tests/support/session/attacked_session.hpp"

#include <gtest/gtest.h>

namespace hapnet::test {
namespace {

class Mallory : public testing::TestWithParam<std::uint64_t> {};

TEST_P(Mallory, BringsNoForceBeyondItsLimitsAndIsForgottenOnceHeHasLeft)
{
    const AttackedSession session = play_attacked(GetParam());
    EXPECT_FALSE(session.complaint)
        << *session.complaint << "\nrepeat it: build/release/bin/soak_session " << GetParam()
        << " 1";
    EXPECT_GT(session.datagrams, 0U);
}

INSTANTIATE_TEST_SUITE_P(Seed, Mallory, testing::Range(std::uint64_t{0}, std::uint64_t{50}));

} // namespace
} // namespace hapnet::test
