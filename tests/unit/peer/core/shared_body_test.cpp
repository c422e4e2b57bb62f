// SPDX-FileCopyrightText: 2026 The Hapnet authors
// SPDX-License-Identifier: MIT
#include "peer/core/shared_body.hpp"

#include "peer/core/sync/algorithm.hpp"
#include "scene/text/text.hpp"

#include <cmath>
#include <gtest/gtest.h>
#include <string>
#include <utility>
#include <vector>

namespace hapnet::peer {
namespace {

std::string refusal_of(const scene::Description& scene)
{
    const auto body = shared_bodies(scene);
    return body ? "" : body.error().message;
}

/// The paper's scene with `movable` movable bodies, which may all rotate.
scene::Description scene_of(std::size_t movable)
{
    scene::Description scene = scene::paper_scene();
    scene.bodies[0].turning = scene::Turning::free;
    scene.bodies.insert(scene.bodies.begin(), movable - 1, scene.bodies[0]);
    return scene;
}

TEST(SharedBody, IsTheMovableOneWhereverItStandsInTheScene)
{
    scene::Description scene = scene::paper_scene();
    EXPECT_EQ(shared_body(scene), 0U);
    std::swap(scene.bodies[0], scene.bodies[1]);
    EXPECT_EQ(shared_body(scene), 1U);
}

TEST(SharedBodies, AreAllThatAreMovableByTheirIds)
{
    scene::Description scene = scene_of(8);
    std::swap(scene.bodies[1], scene.bodies[8]); // a fixed one amid them
    const auto bodies = shared_bodies(scene);
    ASSERT_TRUE(bodies) << bodies.error().message;
    std::vector<scene::BodyId> ids;
    for (const SharedBody& body : *bodies) ids.push_back(body.id);
    EXPECT_EQ(ids, (std::vector<scene::BodyId>{0, 2, 3, 4, 5, 6, 7, 8}));
    EXPECT_TRUE(bodies->front().turns());
    EXPECT_NEAR(bodies->front().reach_m, 0.02 * std::sqrt(3.0), 1e-12);
    EXPECT_FALSE(is_one_without_turning(*bodies));
    EXPECT_TRUE(is_one_without_turning(shared_bodies(scene::paper_scene()).value()));
}

TEST(SharedBodies, AreOneToEight)
{
    scene::Description scene = scene_of(10);
    scene.bodies[8].name = "ninth";
    EXPECT_EQ(refusal_of(scene), "a session shares at most 8 movable bodies, and this scene has "
                                 "10: set fixed = true from body 'ninth' on");
    for (auto& body : scene.bodies) body.movable = false;
    EXPECT_EQ(refusal_of(scene), "a session needs a movable body; this scene has none");
    EXPECT_NE(refusal_of(scene::Description{}), "");
}

TEST(SharedBodies, MayBeOfAnyShapeInFieldsAndFeelLikeThemselves)
{
    scene::Description scene = scene_of(3);
    scene.bodies[0].shape = scene::Shape::sphere;
    scene.bodies[1].parts.emplace_back();
    scene.bodies[2].feel.stiffness_n_per_m = 100.0;
    scene.bodies[2].turning = scene::Turning::about_y;
    scene.hands.static_friction = 0.5;
    scene.fields.resize(1);
    EXPECT_EQ(refusal_of(scene), "");
}

TEST(SharedBodies, OfEveryBuiltInSceneCanBePlayed)
{
    for (const scene::BuiltInScene& built_in : scene::built_in_scenes()) {
        const auto scene = scene::parse_scene(built_in.text, std::string{built_in.name});
        ASSERT_TRUE(scene) << scene.error().message;
        EXPECT_EQ(refusal_of(*scene), "") << built_in.name;
    }
}

TEST(SharedBodies, DoNotMoveByThemselves)
{
    scene::Description scene = scene_of(2);
    scene.bodies[2].name = "belt";
    scene.bodies[2].kinematic = true;
    EXPECT_NE(refusal_of(scene).find("body 'belt' moves by itself"), std::string::npos);
    EXPECT_NE(refusal_of(scene).find("set fixed = true"), std::string::npos);
}

TEST(SharedBodies, HaveHandsThatAreAlikeAndOneKindOfFriction)
{
    scene::Description scene = scene_of(2);
    scene.own_hands.resize(1);
    EXPECT_NE(refusal_of(scene).find("all alike"), std::string::npos);
    scene = scene_of(2);
    scene.hands.friction = 0.5;
    EXPECT_NE(refusal_of(scene).find("set static_friction instead"), std::string::npos);
    scene = scene::paper_scene();
    scene.hands.friction = 0.5;
    EXPECT_EQ(refusal_of(scene), "");
    scene.bodies[1].feel.stiffness_n_per_m = 100.0;
    EXPECT_NE(refusal_of(scene).find("set static_friction alone"), std::string::npos);
}

TEST(SharedBody, NeedsAHandAndANumberThatAMessageCanTell)
{
    scene::Description scene = scene::paper_scene();
    scene.hands.count = 0;
    EXPECT_NE(refusal_of(scene).find("hand"), std::string::npos);
    scene.hands.count = 1;
    EXPECT_EQ(refusal_of(scene), "");
    scene.bodies.insert(scene.bodies.begin(), 32'767, scene.bodies[1]);
    EXPECT_EQ(shared_body(scene), 32'767U);
    scene.bodies.insert(scene.bodies.begin(), scene.bodies[0]);
    EXPECT_NE(refusal_of(scene).find("32768"), std::string::npos);
}

TEST(SharedBodies, ThatTurnOrAreSeveralAreForRemoteProxyAndForBaseAsItIsByDefault)
{
    const auto one = shared_bodies(scene::paper_scene()).value();
    const auto several = shared_bodies(scene_of(2)).value();
    for (const char* name : {"base", "dead-reckoning", "sep"})
        EXPECT_TRUE(check_bodies_of(algorithm_named(name).value(), one)) << name;
    EXPECT_TRUE(check_bodies_of(BaseAlgorithm{}, several));
    EXPECT_TRUE(check_bodies_of(RemoteProxy{}, several));
    for (const char* name : {"dead-reckoning", "sep"}) {
        const auto checked = check_bodies_of(algorithm_named(name).value(), several);
        ASSERT_FALSE(checked);
        EXPECT_NE(checked.error().message.find(name), std::string::npos);
        EXPECT_NE(checked.error().message.find("use base or remote-proxy"), std::string::npos);
    }
    EXPECT_TRUE(
        check_bodies_of(BaseAlgorithm{{.stale = Stale::take, .settle_after = {}}}, several));
    EXPECT_FALSE(check_bodies_of(BaseAlgorithm{{.follow = Follow::relative}}, several));
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
