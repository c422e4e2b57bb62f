// SPDX-FileCopyrightText: 2026 The Hapnet authors
// SPDX-License-Identifier: MIT
// The energy bounds in docs/design/algorithms.md of base-tdpa, wave, couple, lag and rollback, over
// random networks, hands and numbers of peers.
#include "peer/core/peer.hpp"
#include "tests/support/seeds.hpp"
#include "tests/support/session/energy_play.hpp"

#include <algorithm>
#include <gtest/gtest.h>
#include <vector>

namespace hapnet::test::coupling_energy_test {
namespace {

using namespace std::chrono_literals;

constexpr base::Duration length = 12s;
constexpr double in_a_copy_j = 0.015; // in its contacts and its cube's motion

/// Replaces hands that are looser than those for which contacts are softened.
EnergyCase with_assumed_grips(EnergyCase one)
{
    for (auto& player : one.setting.players) {
        double& damping = player.person.hand.damping_ns_per_m;
        damping = std::max(damping, peer::Settings{}.grip_damping_ns_per_m);
    }
    return one;
}

class CouplingEnergy : public testing::TestWithParam<std::uint64_t> {
protected:
    static EnergyCase drawn(const char* name)
    {
        return drawn_energy_case(GetParam(), peer::algorithm_named(name).value(), length);
    }
    static void expect_above(const char* name, double lent_j_of_each_two, bool counts_withdrawn)
    {
        expect_above(name, drawn(name), lent_j_of_each_two, counts_withdrawn);
    }
    static void expect_above(const char* name, const EnergyCase& one, double lent_j_of_each_two,
                             bool counts_withdrawn)
    {
        const EnergyPlayed played = play_for_energy(one);
        const auto peers = static_cast<double>(one.setting.players.size());
        const double bound_j = peers * in_a_copy_j + peers * (peers - 1.0) * lent_j_of_each_two +
                               (counts_withdrawn ? played.withdrawn_j : 0.0);
        EXPECT_TRUE(played.is_finite) << one.words;
        EXPECT_GT(played.work_j, 0.0) << one.words;
        EXPECT_GT(played.least_j, -bound_j) << name << ", " << one.words;
        RecordProperty(std::string{name} + "_case", one.words);
        RecordProperty(std::string{name} + "_least_mj", std::to_string(1e3 * played.least_j));
        RecordProperty(std::string{name} + "_bound_mj", std::to_string(-1e3 * bound_j));
    }
};

TEST_P(CouplingEnergy, OfCopiesOnSpringsStaysAboveTheirTanks)
{
    expect_above("couple", peer::CoupleOptions{}.tank_j, false);
}

TEST_P(CouplingEnergy, OfCopiesOnWavesStaysAboveWhatTheyStore) { expect_above("wave", 0.0, false); }

TEST_P(CouplingEnergy, OfSupervisedCopiesStaysAboveWhatTheyStoreAndWasNotHeard)
{
    expect_above("base-tdpa", 0.0, true);
}

INSTANTIATE_TEST_SUITE_P(Seed, CouplingEnergy, testing::Range(std::uint64_t{0}, seeds(12)));
INSTANTIATE_TEST_SUITE_P(All, CouplingEnergy, testing::Range(seeds(12), std::uint64_t{32}));

// No bound is proved for these two algorithms. The values are those observed.

std::vector<std::uint64_t> seeds_of(const char* name, std::uint64_t begin, std::uint64_t end,
                                    bool (*is_wanted)(const EnergyCase&))
{
    std::vector<std::uint64_t> wanted;
    for (std::uint64_t seed = begin; seed < end; ++seed) {
        const auto algorithm = peer::algorithm_named(name).value();
        if (is_wanted(drawn_energy_case(seed, algorithm, length))) wanted.push_back(seed);
    }
    return wanted;
}

/// More than three peers take minutes.
bool has_few(const EnergyCase& one) { return one.setting.players.size() <= (is_sanitized ? 2 : 3); }

class RollbackEnergy : public CouplingEnergy {};

TEST_P(RollbackEnergy, StaysAboveWhatCopiesStoreAndWasNotHeard)
{
    expect_above("rollback", drawn("rollback"), 0.0, true);
}

INSTANTIATE_TEST_SUITE_P(Seed, RollbackEnergy,
                         testing::ValuesIn(seeds_of("rollback", 0, seeds(4), has_few)));
INSTANTIATE_TEST_SUITE_P(All, RollbackEnergy,
                         testing::ValuesIn(seeds_of("rollback", seeds(4), 8, has_few)));

/// Taps, in which lag draws energy, have a test of their own below.
bool has_no_taps(const EnergyCase& one) { return one.setting.task != device::Task::t6; }

class LagEnergy : public CouplingEnergy {};

TEST_P(LagEnergy, StaysAboveWhatCopiesStoreAndWasNotHeardForGripsAsTheyAreAssumedButInTaps)
{
    expect_above("lag", with_assumed_grips(drawn("lag")), 0.0, true);
}

INSTANTIATE_TEST_SUITE_P(Seed, LagEnergy,
                         testing::ValuesIn(seeds_of("lag", 0, seeds(12), has_no_taps)));
INSTANTIATE_TEST_SUITE_P(All, LagEnergy,
                         testing::ValuesIn(seeds_of("lag", seeds(12), 32, has_no_taps)));

TEST(CouplingEnergy, OfTapsThatLagFallsBelowWhatTheyStoreAndWasNotHeard)
{
    const EnergyCase one =
        with_assumed_grips(drawn_energy_case(0, peer::algorithm_named("lag").value(), length));
    ASSERT_EQ(one.setting.task, device::Task::t6);
    const EnergyPlayed played = play_for_energy(one);
    const auto peers = static_cast<double>(one.setting.players.size());
    EXPECT_LT(played.least_j, -peers * in_a_copy_j - played.withdrawn_j) << one.words;
}

TEST(CouplingEnergy, OfBaseFallsBelowWhatTheyKeep)
{
    const EnergyCase one = drawn_energy_case(10, peer::algorithm_named("base").value(), length);
    const auto peers = static_cast<double>(one.setting.players.size());
    EXPECT_LT(play_for_energy(one).least_j, -peers * in_a_copy_j) << one.words;
}

TEST(CouplingEnergy, IsTheSameToTheBitWhenMessagesComeTwiceAndLate)
{
    for (const char* name : {"couple", "wave", "base-tdpa"}) {
        for (const std::uint64_t seed : {1U, 6U}) {
            const EnergyCase one = drawn_energy_case(seed, peer::algorithm_named(name).value(), 8s);
            EXPECT_EQ(play_for_energy(one).hash,
                      play_for_energy(one, Delivery::twice_and_late).hash)
                << name << ", " << one.words;
        }
    }
}

} // namespace
} // namespace hapnet::test::coupling_energy_test
