// SPDX-FileCopyrightText: 2026 The Hapnet authors
// SPDX-License-Identifier: MIT
#include "peer/core/shared_body.hpp"

#include <gtest/gtest.h>
#include <utility>

namespace hapnet::peer {
namespace {

std::string refusal_of(const scene::Description& scene)
{
    const auto body = shared_body(scene);
    return body ? "" : body.error().message;
}

TEST(SharedBody, IsTheMovableOneWhereverItStandsInTheScene)
{
    scene::Description scene = scene::paper_scene();
    EXPECT_EQ(shared_body(scene), 0U);
    std::swap(scene.bodies[0], scene.bodies[1]);
    EXPECT_EQ(shared_body(scene), 1U);
}

TEST(SharedBody, IsRefusedWhenThereAreMoreOrNone)
{
    scene::Description scene = scene::paper_scene();
    scene.bodies.resize(4, scene.bodies[0]);
    EXPECT_EQ(refusal_of(scene), "a session needs exactly one movable body; this scene has 3");
    for (auto& body : scene.bodies) body.movable = false;
    EXPECT_EQ(refusal_of(scene), "a session needs exactly one movable body; this scene has none");
    EXPECT_NE(refusal_of(scene::Description{}), "");
}

TEST(SharedBody, IsRefusedWhenItCanTurn)
{
    for (const auto turning : {scene::Turning::free, scene::Turning::about_y}) {
        scene::Description scene = scene::paper_scene();
        scene.bodies[0].turning = turning;
        EXPECT_NE(refusal_of(scene).find("turning = \"locked\""), std::string::npos);
    }
}

TEST(SharedBody, IsRefusedWithBodiesOfSeveralParts)
{
    scene::Description scene = scene::paper_scene();
    scene.bodies[1].parts.emplace_back();
    EXPECT_NE(refusal_of(scene).find("several parts"), std::string::npos);
}

TEST(SharedBody, IsRefusedAmongBodiesThatMoveByThemselves)
{
    scene::Description scene = scene::paper_scene();
    scene.bodies[1].kinematic = true;
    EXPECT_NE(refusal_of(scene).find("kinematic"), std::string::npos);
}

TEST(SharedBody, IsRefusedWhereBodiesOrHandsFeelUnlikeTheOthers)
{
    scene::Description scene = scene::paper_scene();
    scene.bodies[1].feel.stiffness_n_per_m = 100.0;
    EXPECT_NE(refusal_of(scene).find("stiffness"), std::string::npos);
    scene = scene::paper_scene();
    scene.own_hands.resize(1);
    EXPECT_NE(refusal_of(scene).find("stiffness"), std::string::npos);
}

TEST(SharedBody, IsRefusedInAFieldOfForce)
{
    scene::Description scene = scene::paper_scene();
    scene.fields.resize(1);
    EXPECT_NE(refusal_of(scene).find("fields"), std::string::npos);
}

TEST(SharedBody, NeedsAHandAndANumberThatAMessageCanTell)
{
    scene::Description scene = scene::paper_scene();
    scene.hands.count = 0;
    EXPECT_NE(refusal_of(scene).find("hand"), std::string::npos);
    scene.hands.count = 1;
    EXPECT_EQ(refusal_of(scene), "");
    scene.bodies.insert(scene.bodies.begin(), 65'535, scene.bodies[1]);
    EXPECT_EQ(shared_body(scene), 65'535U);
    scene.bodies.insert(scene.bodies.begin(), scene.bodies[0]);
    EXPECT_NE(refusal_of(scene).find("65536"), std::string::npos);
}

TEST(SharedBody, KeepsItsOrientationWhenItIsPlaced)
{
    scene::Description scene = scene::paper_scene();
    scene.bodies[0].orientation = {0.8, 0.0, 0.6, 0.0};
    auto world = scene::World::freeze(scene).value();
    world.place(0, {{0.01, 0.0, 0.0}}, {{0.1, 0.0, 0.0}});
    EXPECT_EQ(world.body(0).position, (base::Position{{0.01, 0.0, 0.0}}));
    EXPECT_EQ(world.body(0).velocity, (base::Velocity{{0.1, 0.0, 0.0}}));
    EXPECT_EQ(world.body(0).orientation, (glm::dquat{0.8, 0.0, 0.6, 0.0}));
}

} // namespace
} // namespace hapnet::peer
