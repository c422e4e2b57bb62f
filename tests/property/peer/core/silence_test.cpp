// SPDX-FileCopyrightText: 2026 The Hapnet authors
// SPDX-License-Identifier: MIT
// Whatever was lost: once all hands are off and the network is good again, the copies are one.
#include "lab/experiment/claims.hpp"
#include "tests/support/seeds.hpp"
#include "tests/support/session/energy_play.hpp"

#include <gtest/gtest.h>

namespace hapnet::test::silence_test {
namespace {

using namespace std::chrono_literals;

class Silence : public testing::TestWithParam<std::uint64_t> {
protected:
    /// `of_many`: after so long, of more than two.
    static double apart_mm(const char* name, base::Duration of_many = 1s)
    {
        EnergyCase one = drawn_energy_case(GetParam(), peer::algorithm_named(name).value(), 9s);
        const base::Duration after = one.setting.players.size() == 2 ? 1s : of_many;
        const auto apart_m = lab::experiment::apart_after_silence({.setting = one.setting}, after);
        EXPECT_TRUE(apart_m) << one.words;
        return apart_m ? 1e3 * *apart_m : -1.0;
    }
};

TEST_P(Silence, OfASecondBringsProxiesCopiesTogether)
{
    EXPECT_LE(apart_mm("remote-proxy"), 0.1) << GetParam();
}

// These wait as long as a message between two others may be on its way.

TEST_P(Silence, OfASecondBringsTwoCopiesThatLagTogetherAndOfTwoMore)
{
    EXPECT_LE(apart_mm("lag", 2s), 0.1) << GetParam();
}

TEST_P(Silence, OfASecondBringsTwoCopiesThatRollBackTogetherAndOfTwoMore)
{
    EXPECT_LE(apart_mm("rollback", 2s), 0.1) << GetParam();
}

INSTANTIATE_TEST_SUITE_P(Seed, Silence, testing::Range(std::uint64_t{0}, seeds(12)));

} // namespace
} // namespace hapnet::test::silence_test
