// SPDX-FileCopyrightText: 2026 The Hapnet authors
// SPDX-License-Identifier: MIT
#include "peer/core/sync/base_bodies.hpp"

#include "peer/core/sync/shared_poses.hpp"
#include "scene/maths/rotation.hpp"
#include "tests/support/session/fresh.hpp"

#include <chrono>
#include <gtest/gtest.h>
#include <tuple>
#include <vector>

namespace hapnet::peer::base_bodies_test {
namespace {

using namespace std::chrono_literals;

constexpr base::TimePoint begin{1h};

/// `count` cubes of 40 mm beside each other, in the air.
scene::Description cubes(std::size_t count, scene::Turning turning = scene::Turning::free)
{
    scene::Description scene{.name = "cubes"};
    scene.gravity = glm::dvec3{0.0};
    for (std::size_t i = 0; i < count; ++i) {
        scene::BodyDescription body{.name = "cube"};
        body.position.value.x = 0.1 * static_cast<double>(i);
        body.turning = turning;
        scene.bodies.push_back(body);
    }
    return scene;
}

/// The copy of peer 2, and its messages from peer 1.
class Copy {
public:
    explicit Copy(const scene::Description& scene)
        : world{scene::World::freeze(scene).value()}, bodies{shared_bodies(scene).value(), 2}
    {}

    /// A message of peer 1, whose hand pushes the first of `states` here; zero force: no touch.
    void hear(const std::vector<wire::BodyState>& states, base::Force force = {},
              base::Position hip = {})
    {
        wire::State state;
        state.sequence = ++sequence_;
        state.touching = base::norm(force) > 0.0;
        state.contact_force = force;
        state.hip = hip;
        for (const wire::BodyState& body : states) state.bodies.add(body);
        remote.update(state, now);
    }
    Outcome tick(const scene::HandInput& hand = {.present = false})
    {
        now += 1ms;
        world.set_hand(own_hand, hand);
        look_when_fresh_by(1.0, remote);
        return tick_bodies(world,
                           {.now = now,
                            .others = {&remote, 1},
                            .remote = remote,
                            .yields = true,
                            .poses = &bodies},
                           BaseOptions{});
    }
    void tick_for(base::Duration duration)
    {
        for (const auto end = now + duration; now < end;) std::ignore = tick();
    }

    base::TimePoint now = begin;
    scene::World world;
    SharedPoses bodies;
    Remote remote{{.id = 1}};

private:
    std::uint32_t sequence_ = 0;
};

wire::BodyState state_of(std::uint16_t id, const glm::dvec3& place, const glm::dvec3& turned,
                         std::uint32_t given_uns = 0)
{
    const glm::dquat upright{1.0, 0.0, 0.0, 0.0};
    wire::BodyState state;
    state.body = id;
    state.position = {place};
    state.caused_impulse_uns[0] = given_uns;
    state.turning.emplace().orientation = wire::Orientation::from(scene::rotated(upright, turned));
    return state;
}

double angle_between(const glm::dquat& a, const glm::dquat& b)
{
    return base::norm(base::Displacement{scene::turn_between(a, b)});
}

TEST(BaseBodies, ArePushedAndTurnedWhereTheOtherHandIsWhileThisOneTouches)
{
    Copy copy{cubes(1)};
    const scene::HandInput holding{.position = {{-0.0205, 0.0, 0.0}}, .gripping = true};
    std::ignore = copy.tick(holding);
    // To the right, off the middle on the user's side, so it rotates about +y.
    copy.hear({state_of(0, {}, {}, 1000)}, {{1.0, 0.0, 0.0}}, {{-0.02, 0.0, 0.01}});
    const Outcome outcome = copy.tick(holding);
    EXPECT_EQ(copy.bodies.mover(0), SharedPoses::Mover::own);
    EXPECT_TRUE(outcome.remote_touching);
    EXPECT_EQ(outcome.remote_force, (base::Force{{1.0, 0.0, 0.0}}));
    const scene::BodyState body = copy.world.body(0);
    EXPECT_GT(body.velocity.x(), 0.0);
    EXPECT_GT(body.angular_velocity.y, 0.0);
    EXPECT_NEAR(body.angular_velocity.x, 0.0, 1e-3 * body.angular_velocity.y);
}

TEST(BaseBodies, AreWhereTheOtherHasThemWhileItAloneTouches)
{
    Copy copy{cubes(2)};
    const glm::dvec3 turned{0.1, -0.4, 0.2};
    copy.hear({state_of(0, {0.01, 0.02, 0.0}, turned, 1000), state_of(1, {0.3, 0.0, 0.0}, {})},
              {{1.0, 0.0, 0.0}});
    std::ignore = copy.tick();
    EXPECT_EQ(copy.bodies.mover(0), SharedPoses::Mover::others);
    EXPECT_NEAR(copy.world.position(0).y(), 0.02, 1e-12);
    EXPECT_LT(
        angle_between(copy.world.body(0).orientation, scene::rotated({1.0, 0.0, 0.0, 0.0}, turned)),
        5e-6);
    EXPECT_EQ(copy.bodies.mover(1), SharedPoses::Mover::none); // peer 2 touches nothing
    EXPECT_EQ(copy.world.position(1).x(), 0.1);
}

TEST(BaseBodies, ThatTouchEachOtherAreMovedTogether)
{
    scene::Description scene = cubes(2);
    scene.bodies[1].position = {{0.0, 0.04, 0.0}}; // on the first
    scene.gravity = {0.0, -9.81, 0.0};
    scene.planes.push_back({.name = "platform", .offset_m = -0.02});
    Copy copy{scene};
    copy.tick_for(5ms);
    const auto stands = state_of(1, {0.01, 0.04, 0.0}, {});
    copy.hear({state_of(0, {0.01, 0.0, 0.0}, {}, 1000), stands}, {{1.0, 0.0, 0.0}});
    std::ignore = copy.tick();
    EXPECT_EQ(copy.bodies.mover(1), SharedPoses::Mover::others);
    EXPECT_NEAR(copy.world.position(1).x(), 0.01, 1e-6);
}

TEST(BaseBodies, GoToTheOwnersPlaceAndOrientationOnceNobodyMovesThem)
{
    Copy copy{cubes(1)};
    const glm::dvec3 turned{0.0, 0.3, 0.0};
    copy.hear({state_of(0, {0.01, 0.0, 0.0}, turned)});
    copy.tick_for(201ms);
    EXPECT_NEAR(copy.world.position(0).x(), 0.0, 1e-12);
    copy.tick_for(50ms);
    EXPECT_NEAR(copy.world.position(0).x(), 0.005, 1e-6);
    EXPECT_NEAR(angle_between(copy.world.body(0).orientation, {1.0, 0.0, 0.0, 0.0}), 0.15, 1e-5);
    copy.tick_for(60ms);
    EXPECT_NEAR(copy.world.position(0).x(), 0.01, 1e-12);
    EXPECT_NEAR(angle_between(copy.world.body(0).orientation, {1.0, 0.0, 0.0, 0.0}), 0.3, 1e-5);
}

TEST(BaseBodies, TurnOnlyAsTheyMay)
{
    Copy copy{cubes(1, scene::Turning::about_y)};
    copy.hear({state_of(0, {0.01, 0.0, 0.0}, {0.2, 0.3, 0.1}, 1000)}, {{1.0, 0.0, 0.0}});
    std::ignore = copy.tick();
    const glm::dquat orientation = copy.world.body(0).orientation;
    EXPECT_NEAR(orientation.x, 0.0, 1e-12);
    EXPECT_NEAR(orientation.z, 0.0, 1e-12);
    EXPECT_GT(orientation.y, 0.14);
    EXPECT_NEAR(copy.world.position(0).x(), 0.01, 1e-12);
}

TEST(BaseBodies, ComeSlowlyWhereThisHandIs)
{
    Copy copy{cubes(1)};
    const scene::HandInput near{.position = {{0.028, 0.0, 0.0}}}; // 3 mm off the face
    for (int ms = 0; ms < 5; ++ms) {
        const double before = copy.world.position(0).x();
        copy.hear({state_of(0, {0.03, 0.0, 0.0}, {}, 1000U * static_cast<unsigned>(ms + 1))},
                  {{1e-3, 0.0, 0.0}});
        std::ignore = copy.tick(near);
        EXPECT_GT(copy.world.position(0).x(), before);
        EXPECT_LE(copy.world.position(0).x() - before, 0.5e-3 + 1e-8);
        EXPECT_LE(base::norm(copy.world.velocity(0)), SharedPoses::approach_m_per_s);
    }
}

} // namespace
} // namespace hapnet::peer::base_bodies_test
