// SPDX-FileCopyrightText: 2026 The Hapnet authors
// SPDX-License-Identifier: MIT
// Whatever was lost, the copies agree once all hands are off and the network is good again.
#include "lab/experiment/claims.hpp"
#include "tests/support/seeds.hpp"
#include "tests/support/session/energy_play.hpp"

#include <gtest/gtest.h>
#include <vector>

namespace hapnet::test::silence_test {
namespace {

using namespace std::chrono_literals;

class Silence : public testing::TestWithParam<std::uint64_t> {
protected:
    static EnergyCase drawn(const char* name)
    {
        return drawn_energy_case(GetParam(), peer::algorithm_named(name).value(), 9s);
    }
    /// `of_many`: the wait for more than two peers.
    static double apart_mm(const EnergyCase& one, base::Duration of_many = 1s)
    {
        const base::Duration after = one.setting.players.size() == 2 ? 1s : of_many;
        const auto apart_m = lab::experiment::apart_after_silence(one.setting, after);
        EXPECT_TRUE(apart_m) << one.words;
        return apart_m ? 1e3 * *apart_m : -1.0;
    }
};

TEST_P(Silence, OfASecondBringsProxiesCopiesTogether)
{
    EXPECT_LE(apart_mm(drawn("remote-proxy")), 0.1) << GetParam();
}

// These algorithms wait as long as a message between two other peers may take.

TEST_P(Silence, OfASecondBringsTwoCopiesThatLagTogetherAndOfTwoMore)
{
    EXPECT_LE(apart_mm(drawn("lag"), 2s), 0.1) << GetParam();
}

INSTANTIATE_TEST_SUITE_P(Seed, Silence, testing::Range(std::uint64_t{0}, seeds(12)));

class RollbackSilence : public Silence {
protected:
    static EnergyCase drawn_of(std::uint64_t seed)
    {
        return drawn_energy_case(seed, peer::algorithm_named("rollback").value(), 9s);
    }

public:
    /// More than four peers take minutes.
    static std::vector<std::uint64_t> seeds_of_few(std::uint64_t begin, std::uint64_t end)
    {
        std::vector<std::uint64_t> wanted;
        for (std::uint64_t seed = begin; seed < end; ++seed) {
            if (drawn_of(seed).setting.players.size() <= (is_sanitized ? 2 : 4)) {
                wanted.push_back(seed);
            }
        }
        return wanted;
    }
};

TEST_P(RollbackSilence, OfASecondBringsTwoCopiesTogetherAndOfTwoMore)
{
    const EnergyCase one = drawn_of(GetParam());
    EXPECT_LE(apart_mm(one, 2s), 0.1) << one.words;
}

INSTANTIATE_TEST_SUITE_P(Seed, RollbackSilence,
                         testing::ValuesIn(RollbackSilence::seeds_of_few(0, seeds(2))));
INSTANTIATE_TEST_SUITE_P(All, RollbackSilence,
                         testing::ValuesIn(RollbackSilence::seeds_of_few(seeds(2), 6)));

} // namespace
} // namespace hapnet::test::silence_test
