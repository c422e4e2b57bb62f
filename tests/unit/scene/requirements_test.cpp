// SPDX-FileCopyrightText: 2026 The Hapnet authors
// SPDX-License-Identifier: MIT
#include "scene/requirements.hpp"

#include <gtest/gtest.h>

namespace hapnet::scene {
namespace {

StepperKind profile_of(const Description& description, bool sleeping = true)
{
    return cheapest_stepper(required_features(requirements_of(description, sleeping)));
}

FeatureSet needed_by(const Description& description)
{
    return required_features(requirements_of(description, true));
}

Description lone_body()
{
    Description description;
    description.bodies.resize(1);
    description.hands.count = 0;
    return description;
}

TEST(StepperKind, ThePapersSceneSlidesAndNeedsNothingElse)
{
    const FeatureSet needed = needed_by(paper_scene());
    EXPECT_EQ(needed, (FeatureSet{Feature::contact, Feature::hands, Feature::drag}));
    EXPECT_EQ(profile_of(paper_scene()), StepperKind::sliding);
}

TEST(StepperKind, AFeatureMoreSelectsTheNextProfile)
{
    Description scene = paper_scene();
    scene.bodies[0].material.friction = 0.3;
    EXPECT_EQ(profile_of(scene), StepperKind::sliding); // on a smooth platform
    scene.planes[0].material.friction = 0.3;
    EXPECT_EQ(profile_of(scene), StepperKind::sliding_coulomb);
    scene.bodies[0].turning = Turning::free;
    EXPECT_EQ(profile_of(scene), StepperKind::lone);
    scene.bodies.push_back(scene.bodies[0]);
    EXPECT_EQ(profile_of(scene), StepperKind::few);
    scene.bodies.resize(65, scene.bodies[0]);
    EXPECT_EQ(profile_of(scene), StepperKind::many);
}

TEST(StepperKind, ABodyWithNothingAroundItFlies)
{
    EXPECT_EQ(profile_of(lone_body()), StepperKind::flight);
    Description with_hand = lone_body();
    with_hand.hands.count = 1;
    EXPECT_EQ(profile_of(with_hand), StepperKind::lone);
}

TEST(StepperKind, ABoxAskewDoesNotSlideParallelToTheOthers)
{
    Description scene = paper_scene();
    scene.bodies[1].orientation = {0.8, 0.0, 0.6, 0.0};
    EXPECT_TRUE(needed_by(scene).has(Feature::skew));
    EXPECT_EQ(profile_of(scene), StepperKind::lone);
}

TEST(StepperKind, SleepIsNeededOnlyWhereBodiesMeetAndItIsNotSwitchedOff)
{
    Description scene = paper_scene();
    EXPECT_FALSE(needed_by(scene).has(Feature::sleep));
    scene.bodies[1].movable = true;
    EXPECT_TRUE(needed_by(scene).has(Feature::sleep));
    EXPECT_FALSE(required_features(requirements_of(scene, false)).has(Feature::sleep));
}

TEST(StepperKind, EveryNeedHasAReasonAndComesInTheOrderOfTheFeatures)
{
    for (const Description& scene : {paper_scene(), lone_body(), Description{}}) {
        const Requirements needs = requirements_of(scene, true);
        for (std::size_t i = 0; i < features; ++i) {
            EXPECT_EQ(static_cast<std::size_t>(needs[i].feature), i);
            EXPECT_FALSE(needs[i].because.empty());
        }
    }
}

TEST(StepperKind, TheLastProfileCanDoEverything)
{
    FeatureSet everything;
    for (std::size_t i = 0; i < features; ++i) everything.add(static_cast<Feature>(i));
    EXPECT_EQ(cheapest_stepper(everything), StepperKind::many);
}

} // namespace
} // namespace hapnet::scene
