// SPDX-FileCopyrightText: 2026 The Hapnet authors
// SPDX-License-Identifier: MIT
#include "peer/core/sync/pose_correction.hpp"

#include "peer/core/sync/remote_proxy.hpp"
#include "scene/maths/rotation.hpp"
#include "tests/unit/peer/core/sync/copy.hpp"

#include <gtest/gtest.h>

namespace hapnet::peer::pose_correction_test {
namespace {

constexpr glm::dquat upright{1.0, 0.0, 0.0, 0.0};

/// `count` cubes of 40 mm beside each other, in the air.
scene::Description cubes(std::size_t count)
{
    scene::Description scene{.name = "cubes"};
    scene.gravity = glm::dvec3{0.0};
    for (std::size_t i = 0; i < count; ++i) {
        scene::BodyDescription body{.name = "cube"};
        body.position.value.x = 0.1 * static_cast<double>(i);
        body.turning = scene::Turning::free;
        scene.bodies.push_back(body);
    }
    return scene;
}

wire::BodyState state_of(std::uint16_t id, const glm::dvec3& place, const glm::dvec3& turned)
{
    wire::BodyState state;
    state.body = id;
    state.position = {place};
    state.turning.emplace().orientation = wire::Orientation::from(scene::rotated(upright, turned));
    return state;
}

/// The copy of peer 2 with remote-proxy, which receives from peer 1.
class Copy {
public:
    explicit Copy(const scene::Description& scene = cubes(1), std::uint16_t own_id = 2)
        : world{scene::World::freeze(scene).value()}, poses{shared_bodies(scene).value(), own_id}
    {
        algorithm.prepare(1, world);
    }
    /// A message of peer 1, `age_ms` old. It touches the body that it gave the last impulse.
    void hear(wire::State state, double age_ms = 0.0)
    {
        ++ms;
        state.sequence = ++sequence_;
        state.sent = at_ms(ms - age_ms);
        const bool taken = remote.update(state, at_ms(ms));
        algorithm.hear({.state = state,
                        .arrived = at_ms(ms),
                        .taken = taken,
                        .clock = RemoteClock{clock_},
                        .force_max_n = force_max});
    }
    Outcome tick(const scene::HandInput& hand = away)
    {
        world.set_hand(own_hand, hand);
        look_when_fresh_by(1.0, remote);
        return algorithm.tick(world, {.now = at_ms(ms),
                                      .others = {&remote, 1},
                                      .remote = remote,
                                      .yields = true,
                                      .clock = RemoteClock{clock_},
                                      .force_max_n = force_max,
                                      .lower_ids = 1,
                                      .poses = &poses});
    }
    [[nodiscard]] glm::dvec3 turned(scene::BodyId body = 0) const
    {
        return scene::turn_between(upright, world.body(body).orientation);
    }

    double ms = 0.0;
    scene::World world;
    SharedPoses poses;
    Remote remote{{.id = 1}};
    RemoteProxy algorithm;

private:
    std::uint32_t sequence_ = 0;
    std::optional<ClockEstimate> clock_ = ClockEstimate{};
};

/// Off the body, whatever the message says. Its proxy touches nothing either.
constexpr double off = -0.1;

/// The state of a hand on the left face of the first cube, off its middle. Both may be rotated.
wire::State pushing(const glm::dvec3& turned, double depth_m = 0.002, double beside_m = 0.01)
{
    const glm::dquat orientation = scene::rotated(upright, turned);
    wire::State state;
    state.touching = true;
    state.hip = {orientation * glm::dvec3{-0.025 + depth_m, 0.0, beside_m}};
    state.bodies.add(state_of(0, {}, turned));
    return state;
}

TEST(PoseCorrection, AProxyEntersWhereItsOwnersHandIsOnTheBodyHoweverThatIsTurnedHere)
{
    Copy copy;
    scene::BodyState here = copy.world.body(0);
    here.position = {{0.0, 0.05, 0.0}};
    here.orientation = scene::rotated(upright, {0.0, 1.0, 0.0});
    copy.world.place(0, here);
    copy.hear(pushing({0.0, 0.4, 0.0}));
    const Outcome outcome = copy.tick();
    EXPECT_TRUE(outcome.remote_touching);
    // 2 mm deep are 1 N along the face's normal, which is the body's x.
    const glm::dvec3 force = glm::conjugate(here.orientation) * outcome.remote_force.value;
    EXPECT_NEAR(force.x, 1.0, 0.05);
    EXPECT_NEAR(force.z, 0.0, 0.05);
    // And it rotates the body about its contact point: off the middle, on the user's side.
    EXPECT_GT(copy.world.body(0).angular_velocity.y, 0.0);
}

TEST(PoseCorrection, TurnsABodyThatAnotherAloneMovesToTheLeadersOrientationNoFasterThanItsRate)
{
    Copy copy;
    const glm::dvec3 goal{0.0, 1.0, 0.0};
    double before = 0.0;
    for (int i = 0; i < 500; ++i) {
        copy.hear(pushing(goal, off));
        static_cast<void>(copy.tick());
        const double now = copy.turned().y;
        EXPECT_LE(now - before, 1e-3 * 0.25 / copy.poses.bodies()[0].reach_m + 1e-9) << i;
        before = now;
    }
    EXPECT_NEAR(before, 1.0, 0.01);
    EXPECT_EQ(copy.poses.mover(0), SharedPoses::Mover::others);
}

TEST(PoseCorrection, LeavesTheBodyToTheOwnHandWhileThatTouches)
{
    Copy copy;
    const scene::HandInput holding{.position = {{-0.0205, 0.0, 0.0}}, .gripping = true};
    for (int i = 0; i < 100; ++i) {
        copy.hear(pushing({0.0, 0.5, 0.0}, off));
        static_cast<void>(copy.tick(holding));
    }
    EXPECT_EQ(copy.poses.mover(0), SharedPoses::Mover::own);
    EXPECT_NEAR(copy.turned().y, 0.0, 1e-3);
}

TEST(PoseCorrection, ComparesWithItsOwnPastOnceNobodyTouchesSoThatTheDelayIsNotInTheLoop)
{
    Copy copy;
    for (int i = 0; i < 200; ++i) {
        ++copy.ms;
        static_cast<void>(copy.tick());
    }
    copy.hear(pushing({0.0, 0.3, 0.0}, off), 150.0); // it touched last, and leads
    static_cast<void>(copy.tick());
    for (int i = 0; i < 190; ++i) {
        wire::State let_go;
        let_go.bodies.add(state_of(0, {0.004, 0.0, 0.0}, {0.0, 0.3, 0.0}));
        copy.hear(let_go, 150.0);
        static_cast<void>(copy.tick());
        ASSERT_LT(copy.turned().y, 0.3 + 1e-3) << i; // no swinging beyond
        ASSERT_LT(copy.world.position(0).x(), 0.004 + 1e-5) << i;
    }
    EXPECT_NEAR(copy.turned().y, 0.3, 0.02);
    EXPECT_FALSE(copy.poses.is_settling(0));
}

TEST(PoseCorrection, ChargesTheAccountForWhatItStretchesInAProxysContact)
{
    Copy copy;
    const PoseCorrection::Rates rates;
    PoseCorrection correction{1, rates};
    copy.hear(pushing({0.0, 0.5, 0.0}));
    look_when_fresh_by(1.0, copy.remote);
    const Situation situation{.now = at_ms(copy.ms),
                              .others = {&copy.remote, 1},
                              .remote = copy.remote,
                              .poses = &copy.poses};
    const auto given_j = [&](double torque_n_m) {
        scene::World world = copy.world;
        PoseCorrection once = correction;
        once.begin_pushes();
        // 1 N with a lever, about y.
        once.add_push(0, {{1.0, 0.0, 0.0}}, {{0.0, 0.0, torque_n_m}});
        return once.keep_together({world, situation, copy.algorithm.proxies()});
    };
    const double step_rad = 1e-3 * 0.25 / copy.poses.bodies()[0].reach_m; // the most in a tick
    EXPECT_NEAR(given_j(-0.01), 0.01 * step_rad, 1e-9);
    EXPECT_EQ(given_j(0.01), 0.0); // that relaxes it
}

TEST(PoseCorrection, AHandIsOnTheBodyThatItPushesOverThere)
{
    Copy copy{cubes(2)};
    scene::BodyState second = copy.world.body(1);
    second.position = {{0.1, 0.03, 0.0}};
    copy.world.place(1, second);
    wire::State state;
    state.bodies.add(state_of(0, {}, {}));
    state.bodies.add(state_of(1, {0.1, 0.0, 0.0}, {}));
    copy.hear(state);
    state.touching = true;
    state.hip = {{0.1 - 0.025 + 0.002, 0.0, 0.0}};
    state.bodies.clear();
    state.bodies.add(state_of(0, {}, {}));
    wire::BodyState pushed = state_of(1, {0.1, 0.0, 0.0}, {});
    pushed.caused_impulse_uns[0] = 1000;
    state.bodies.add(pushed);
    copy.hear(state);
    const Outcome outcome = copy.tick();
    EXPECT_NEAR(outcome.remote_force.x(), 1.0, 0.05);
    EXPECT_GT(copy.world.velocity(1).x(), 0.0);
    EXPECT_EQ(copy.world.velocity(0).x(), 0.0);
    EXPECT_EQ(copy.poses.mover(1), SharedPoses::Mover::others);
    EXPECT_EQ(copy.poses.mover(0), SharedPoses::Mover::none);
}

} // namespace
} // namespace hapnet::peer::pose_correction_test
