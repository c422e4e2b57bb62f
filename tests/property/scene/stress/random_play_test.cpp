// SPDX-FileCopyrightText: 2026 The Hapnet authors
// SPDX-License-Identifier: MIT
//
// Random scenes under the laws of SceneLaws. Millions of them: scripts/soak.sh scene.
#include "tests/support/scene/scene_laws.hpp"
#include "tests/support/seeds.hpp"

#include <gtest/gtest.h>
#include <optional>

namespace hapnet::test {
namespace {

TEST(RandomPlay, KeepsEveryLawAndItsFutureAfterASnapshot)
{
    for (std::uint64_t seed = 0; seed < seeds(300); ++seed) {
        const PlayOutcome outcome = judge(random_play(seed), seed);
        EXPECT_FALSE(outcome.complaint) << "seed " << seed << ": " << *outcome.complaint;
    }
}

TEST(RandomPlay, OfRoundBodiesKeepsEveryLaw)
{
    for (std::uint64_t seed = round_plays_from; seed < round_plays_from + seeds(300); ++seed) {
        const PlayOutcome outcome = judge(random_play(seed), seed);
        EXPECT_FALSE(outcome.complaint) << "seed " << seed << ": " << *outcome.complaint;
    }
}

TEST(RandomPlay, KeepsThemWithEveryElementOfAScene)
{
    for (std::uint64_t seed = elements_from; seed < elements_from + seeds(300); ++seed) {
        const PlayOutcome outcome = judge(random_play(seed), seed);
        EXPECT_FALSE(outcome.complaint) << "seed " << seed << ": " << *outcome.complaint;
    }
}

TEST(RandomPlay, OfBodiesOfSeveralPartsKeepsEveryLaw)
{
    for (std::uint64_t seed = 0; seed < seeds(300); ++seed) {
        const PlayOutcome outcome = judge(random_play(seed, {.compounds = true}), seed);
        EXPECT_FALSE(outcome.complaint) << "seed " << seed << ": " << *outcome.complaint;
    }
}

TEST(RandomPlay, IsTheSameEveryTime)
{
    for (std::uint64_t seed = 1000; seed < 1030; ++seed) {
        EXPECT_EQ(judge(random_play(seed), seed).hash, judge(random_play(seed), seed).hash) << seed;
    }
}

/// A seed that once broke a law, and the fault.
struct Scar {
    std::uint64_t seed;
    const char* name;
};

class Scars : public testing::TestWithParam<Scar> {};

TEST_P(Scars, StayHealed)
{
    const std::uint64_t seed = GetParam().seed;
    const PlayOutcome outcome = judge(random_play(seed), seed);
    EXPECT_FALSE(outcome.complaint) << "seed " << seed << ": " << *outcome.complaint;
}

INSTANTIATE_TEST_SUITE_P(
    RandomPlayOfElements, Scars,
    testing::Values(
        Scar{elements_from + 958, "DrivenAgainstALockedBody"},
        Scar{elements_from + 657, "DrivenInAHeap"}, Scar{elements_from + 1028, "DrivenAmongSlow"},
        Scar{elements_from + 1273, "ThrownOffARoughHand"},
        Scar{elements_from + 1821, "ThrownOffAStiffRoughHand"},
        Scar{elements_from + 4001, "DrivenFarAlongItsLocks"},
        Scar{elements_from + 4137, "HurriedByAStiffFieldIntoTheFloor"},
        Scar{elements_from + 20869, "PressedTogetherByAField"},
        Scar{3000000003259, "TwistedWhileItTurnsBackInABounce"},
        Scar{3000000011760, "SqueezedOutAsIfByScissors"},
        Scar{3000000032474, "SqueezedOutAmongLocked"},
        Scar{3000000026946, "ThrownByOneThatIsPutElsewhere"},
        Scar{3000000052886, "DrivenFarBesideOthers"}, Scar{3000000035222, "SqueezedOutAmongOthers"},
        Scar{3200000041501, "SqueezedOutSlowly"}, Scar{3200000056236, "SqueezedOutByOneThatTurns"},
        Scar{3200000071674, "SqueezedOutAtOnce"}, Scar{3300000017772, "ThrownAndSqueezedAtOnce"}),
    [](const auto& each) { return std::string{each.param.name}; });

INSTANTIATE_TEST_SUITE_P(
    RandomPlay, Scars,
    testing::Values(
        Scar{1548, "PutOutOfAPlaneAlongALockedAxis"},
        Scar{1812, "PutElsewhereIntoAPlaneAlongALockedAxis"},
        Scar{276, "StoppedByFrictionAcrossALock"}, Scar{1158, "DraggedAcrossALock"},
        Scar{583, "PushedByADamperBeyondTheGreatestForce"},
        Scar{1012, "PushedBeyondTheGreatestForceAtTheFirstTouch"},
        Scar{277, "SettledBeyondTheGreatestForce"}, Scar{237, "PushedByAFaceFromBeside"},
        Scar{1648, "SqueezedWhileItTurns"}, Scar{1585, "RubbedByItsOwnFastTurn"},
        Scar{18, "RubbedByATurnThatIsNot"}, Scar{713, "WobblingFasterThanItsTick"},
        Scar{3639, "WedgedByAHair"}, Scar{3790, "SqueezedByTwelve"},
        Scar{914, "BouncingWithFriction"}, Scar{1381, "BouncingOffThreeAtOnce"},
        Scar{457, "HeldInAHeap"}, Scar{62533, "PushedWhileItTurnsFast"},
        Scar{1550, "ThrownOutOfItsWay"}, Scar{41482, "ThrownByAStiffHandWithMegajoules"},
        Scar{24864, "ThrownByAStiffHandOnAnEdge"}, Scar{17641, "ThrownByAStiffHandAtACorner"},
        Scar{49519, "ThrownByAStiffHandFromRest"},
        Scar{7011627, "ThrownByAStiffHandFromAlmostRest"}, Scar{8525, "ThrownByALimitedHand"},
        Scar{44577, "PushedByALimitedHand"}, Scar{9343, "ThrownAmongOthersByAStiffHand"},
        Scar{12314, "ThrownByAStiffDamper"}, Scar{7016494, "ThrownOffByAStiffDamper"},
        Scar{7024713, "ThrownAmongOthersByAStiffDamper"}, Scar{17487, "ThrownOutOfAHeap"},
        Scar{27970, "PushedOutOfAHeap"}, Scar{7020330, "ThrownByAStiffGrip"},
        Scar{7023619, "PulledOutByAStiffGrip"}, Scar{7002827, "ThrownAmongOthersByAStiffGrip"},
        Scar{7048930, "GrippedByStiffHands"}, Scar{43789, "GrippedAgainstDrag"},
        Scar{7017750, "PushedByAStiffHandAgainstDrag"}, Scar{7000755, "GrippedAgainstStrongDrag"},
        Scar{292, "BrakedWithALockedTurn"}, Scar{3766, "BrakedWhileItTurnsFarInATick"},
        Scar{1818, "HitAgainInTheFirstTick"}, Scar{8316, "HitAgainInTheSameTick"},
        Scar{9050, "HitAgainAndAgain"}, Scar{7021082, "SolvedWithAPivotOfRounding"},
        Scar{7025984, "SolvedWithAPivotOfRoundingAgain"}, Scar{41774, "WedgedOnOneAxis"},
        Scar{57029, "ThrownByAnEndlessImpulse"}, Scar{7014407, "GivenMomentumByNobody"},
        Scar{7088142, "GivenMomentumByNobodyAgain"}, Scar{7072176, "GoneFartherThanItsSpeed"},
        Scar{55074, "PushedByTwoEventsOfAHand"}, Scar{7032638, "PushedAThousandfold"},
        Scar{7008905, "PushedAslantWhileStuck"}, Scar{7039109, "PushedAslantWhileStuckAgain"},
        Scar{934, "HeldAtHighSpeed"}, Scar{1509, "PressedOffCentreAtHighSpeed"},
        Scar{7427, "BouncingLightly"}, Scar{8575, "BouncingOffTwoInOneTick"},
        Scar{30580, "StoppedByDrag"}, Scar{7008381, "BouncingInACrowd"},
        Scar{7023885, "SlidingInACrowd"}, Scar{7056537, "BouncingWhileItSlides"},
        Scar{58103, "PushedByFourFromRest"}, Scar{87789, "HardlyTouched"},
        Scar{153192, "SqueezedByStiffHands"}, Scar{532650, "SqueezedByStifferHands"},
        Scar{231289, "WokenBesideASmallerOne"}, Scar{540562, "HeldAmongOthers"},
        Scar{753380, "PushedWhileItSpinsFar"}, Scar{30011485, "GrippedWhileItSpins"},
        Scar{124570, "HitInItsFlight"}, Scar{167424, "HitInItsFall"},
        Scar{205825, "HitOneOfTwoInItsFall"}, Scar{582020, "HitInALongTick"},
        Scar{693524, "HitBesideStiffHands"}, Scar{261314, "HitAmongMany"},
        Scar{309198, "HitAmongManyInItsFall"}, Scar{352579, "HitAloneInItsFall"},
        Scar{634054, "HitAmongSome"}, Scar{799157, "HitAloneInALongTick"},
        Scar{842282, "HitAmongSomeInItsFall"}, Scar{100198959, "HitHardlyInItsFall"},
        Scar{845635, "HeldFarOff"}, Scar{100114597, "HeldAndPushedInALongTick"},
        Scar{200086098, "HeldFasterThanBefore"}, Scar{240166, "TurnedTooFastAtFirst"},
        Scar{100122549, "TurnedTooFastAmongMany"}, Scar{100158455, "TurnedTooFastByStiffHands"},
        Scar{200079695, "TurnedTooFastBesideAnother"}, Scar{142923, "SqueezedByHandsThatCancel"},
        Scar{200079611, "HeldByThreeThatCancel"}, Scar{200074436, "StuckOnAPointThatPulls"},
        Scar{300053771, "ThrownFartherThanItsSpeed"}, Scar{400077289, "ThrownBetweenTwoHeavyOnes"},
        Scar{400077724, "PushedByAHandThatHoldsAnother"},
        Scar{400080091, "PushedAtHighSpeedByAHandThatHoldsAnother"},
        Scar{600121857, "PushedByAHandThatHoldsOneFarAway"},
        Scar{600155233, "PushedHardByAHandThatHoldsOneFarAway"},
        Scar{800003605, "BroughtToRestByAStiffHand"}, Scar{800098062, "NotHitItselfButANeighbour"},
        Scar{7015132, "GrippedLightlyWhileItSpins"}, Scar{7029090, "GrippedHardWhileItSpins"},
        Scar{7032676, "GrippedInLongTicksWhileItSpins"},
        Scar{1000001991, "PushedThroughItsLockedCentre"},
        Scar{8000069958, "PushedAtTheEndOfARowThatSleeps"},
        Scar{21000031384, "PushedAboutAnAxisAcrossTheOnlyOneItTurnsAbout"},
        Scar{51000251007, "SpinningOnTheFloorToWhichItIsPressed"},
        Scar{51000502515, "SwungByAGripWithMegajoules"},
        Scar{500065121, "SlowedWithAGripThatGivesLessThen"},
        Scar{420000741081, "MixedOfStepsThatAreNearlyTheSame"}),
    [](const auto& each) { return each.param.name; });

/// Islands that lost motion because last tick's forces drove them: where drag took a part of
/// friction's, where a hand or a grip relied on them, in a wedge at rest, on light bodies.
class StaleForces : public testing::TestWithParam<std::uint64_t> {};

TEST_P(StaleForces, GiveWayWithoutAGuard)
{
    const std::uint64_t seed = GetParam();
    const PlayOutcome outcome = judge(random_play(seed), seed);
    EXPECT_FALSE(outcome.complaint) << *outcome.complaint;
    EXPECT_EQ(outcome.interventions.guards(), 0U);
}

INSTANTIATE_TEST_SUITE_P(Drag, StaleForces,
                         testing::Values(900000698, 900001820, 900002197, 900002527, 900003178,
                                         900003571, 900004101));
INSTANTIATE_TEST_SUITE_P(Hands, StaleForces,
                         testing::Values(900000025, 900000547, 900000573, 900004634));
INSTANTIATE_TEST_SUITE_P(AtRest, StaleForces,
                         testing::Values(900000555, 900003450, 900003458, 900005403, 900005432));
INSTANTIATE_TEST_SUITE_P(Heaps, StaleForces,
                         testing::Values(900000082, 900000732, 900001103, 900001212, 900001646,
                                         900002266, 900002621, 900004474, 900005361));

/// A bounce was not reduced by the drag of its tick, in a corner of two planes and off a body.
TEST(RandomPlay, OfBouncesAgainstDragNeedsNoGuard)
{
    for (const std::uint64_t seed : {500400499U, 500432776U}) {
        const PlayOutcome outcome = judge(random_play(seed), seed);
        EXPECT_FALSE(outcome.complaint) << "seed " << seed << ": " << *outcome.complaint;
        EXPECT_EQ(outcome.interventions.guards(), 0U) << "seed " << seed;
    }
}

/// Fast bodies that are packed, or spin beside each other, and used up the tick's searches.
class Crowds : public testing::TestWithParam<std::uint64_t> {};

TEST_P(Crowds, GoTheirWayWithoutAGuard)
{
    const std::uint64_t seed = GetParam();
    const PlayOutcome outcome = judge(random_play(seed), seed);
    EXPECT_FALSE(outcome.complaint) << *outcome.complaint;
    EXPECT_EQ(outcome.interventions.paths_cut, 0U);
    EXPECT_EQ(outcome.interventions.budgets_spent, 0U);
    EXPECT_GT(outcome.interventions.clusters_stuck, 0U);
}

INSTANTIATE_TEST_SUITE_P(RandomPlay, Crowds,
                         testing::Values(8585, 4586, 2963, 548, 9302, 5376, 821, 4181, 1339, 3418));

} // namespace
} // namespace hapnet::test
