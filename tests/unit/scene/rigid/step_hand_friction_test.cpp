// SPDX-FileCopyrightText: 2026 The Hapnet authors
// SPDX-License-Identifier: MIT
//
// Hands that stick to bodies, and slide over them.
#include "proto/base/math.hpp"
#include "scene/text/text.hpp"
#include "tests/support/scene/bench_scenes.hpp"
#include "tests/unit/scene/rigid/scenes.hpp"

#include <algorithm>
#include <array>
#include <gtest/gtest.h>
#include <limits>

namespace hapnet::scene::hand_friction_test {
namespace {

constexpr double tick_s = 1e-3;
constexpr double stiffness = 500.0;
constexpr double radius = 0.005;
constexpr double sticking = 0.6;
constexpr double sliding = 0.4;

/// Hands that are only springs, with the coefficients of the bodies that they touch.
Description rough_hands(std::uint32_t count)
{
    Description scene;
    scene.hands.count = count;
    scene.hands.stiffness_n_per_m = stiffness;
    scene.hands.damping_ns_per_m = 0.0;
    scene.hands.force_max_n = std::numeric_limits<double>::infinity();
    scene.hands.static_friction = sticking;
    scene.hands.dynamic_friction = sliding;
    return scene;
}

/// A body that is equally rough to hands, and smooth to bodies.
BodyDescription rough_cube(const glm::dvec3& place)
{
    BodyDescription cube = cube_at(place);
    cube.material.friction = 0.0;
    cube.feel.static_friction = sticking;
    cube.feel.dynamic_friction = sliding;
    return cube;
}

Description over_felt_plane()
{
    Description scene = rough_hands(1);
    scene.planes.push_back({.name = "felt", .felt = true});
    scene.planes[0].material.friction = sticking;
    scene.hands.dynamic_friction = sliding * sliding / sticking; // the geometric mean is `sliding`
    return scene;
}

Description over_fixed_block(const glm::dvec3& velocity = glm::dvec3{0.0})
{
    Description scene = rough_hands(1);
    scene.bodies.push_back(rough_cube({0.0, -half, 0.0}));
    scene.bodies[0].half = {1.0, half, 1.0};
    scene.bodies[0].movable = false;
    scene.bodies[0].kinematic = velocity != glm::dvec3{0.0};
    scene.bodies[0].velocity.value = velocity;
    return scene;
}

/// A hand that presses down on y = top with this force, at `place` along x and z.
HandInput pressing(double force, const glm::dvec3& place, const glm::dvec3& velocity, double top)
{
    const glm::dvec3 at{place.x, top + radius - force / stiffness, place.z};
    return {.position = {at}, .velocity = {velocity}};
}

/// The mean over a tick of the pull on a hand, whose path since the touch grew from `from` to `to`.
/// It sticks up to `sticking` times the push, then slides.
double mean_pull(double from, double to, double push)
{
    const double loose = sticking * push / stiffness;
    const double stuck = std::clamp((loose - from) / (to - from), 0.0, 1.0);
    const double until = from + stuck * (to - from);
    return stuck * 0.5 * stiffness * (from + until) + (1.0 - stuck) * sliding * push;
}

class DrawnAcross : public testing::TestWithParam<Description> {};

TEST_P(DrawnAcross, AHandSticksUntilTheConeIsLeftAndSlidesThen)
{
    World world = World::freeze(GetParam()).value();
    EXPECT_EQ(world.stepper_kind(), StepperKind::lone);
    constexpr double push = 1.0;
    constexpr double speed = 0.0107; // breaks loose within a tick
    const glm::dvec3 along{0.6, 0.0, -0.8};
    double worst = 0.0;
    for (int i = 0; i < 300; ++i) {
        const double from = speed * i * tick_s;
        ASSERT_FALSE(world.set_hand(0, pressing(push, from * along, speed * along, 0.0)));
        world.tick();
        const glm::dvec3 expected =
            glm::dvec3{0.0, push, 0.0} - mean_pull(from, from + speed * tick_s, push) * along;
        worst = std::max(worst, length(world.touch(0).on_hand.value - expected));
        EXPECT_EQ(world.state().slips[0].slides,
                  from + speed * tick_s > sticking * push / stiffness);
    }
    EXPECT_LE(worst, 1e-11);
    // After a stop the stretch of sliding holds it without any creep.
    const double place = speed * 300 * tick_s;
    for (int i = 0; i < 1000; ++i) {
        ASSERT_FALSE(world.set_hand(0, pressing(push, place * along, {}, 0.0)));
        world.tick();
        EXPECT_NEAR(glm::dot(world.touch(0).on_hand.value, along), -sliding * push, 1e-11);
    }
    EXPECT_TRUE(world.state().slips[0].sticks);
    // Backwards it sticks at once, with the opposite sign after twice the stretch.
    ASSERT_FALSE(world.set_hand(
        0, pressing(push, (place - 2.0 * sliding * push / stiffness) * along, {}, 0.0)));
    world.tick();
    EXPECT_NEAR(glm::dot(world.touch(0).on_hand.value, along), sliding * push, 1e-11);
}

INSTANTIATE_TEST_SUITE_P(HandFriction, DrawnAcross,
                         testing::Values(over_felt_plane(), over_fixed_block()));

TEST(HandFriction, AKinematicBodyCarriesItsProxyAlong)
{
    const glm::dvec3 velocity{0.01, 0.0, 0.0};
    World world = World::freeze(over_fixed_block(velocity)).value();
    for (int i = 0; i < 100; ++i) { // moves along: no pull
        ASSERT_FALSE(world.set_hand(0, pressing(1.0, (i * tick_s) * velocity, velocity, 0.0)));
        world.tick();
        EXPECT_NEAR(world.touch(0).on_hand.x(), 0.0, 1e-11);
    }
    const double place = 100 * tick_s * velocity.x;
    for (int i = 0; i < 200; ++i) { // it stands still and is dragged
        ASSERT_FALSE(world.set_hand(0, pressing(1.0, {place, 0.0, 0.0}, {}, 0.0)));
        world.tick();
        const double from = velocity.x * i * tick_s;
        EXPECT_NEAR(world.touch(0).on_hand.x(), mean_pull(from, from + velocity.x * tick_s, 1.0),
                    1e-11);
    }
}

/// A cube on a smooth floor that can only slide, and a hand that presses down on it.
Description on_smooth_floor(double damping)
{
    Description scene = rough_hands(1);
    scene.hands.damping_ns_per_m = damping;
    scene.bodies.push_back(rough_cube({0.0, half, 0.0}));
    scene.bodies[0].turning = Turning::locked;
    scene.planes.push_back({.name = "smooth"});
    return scene;
}

TEST(HandFriction, DragsACubeAlongAsASpringAndADamper)
{
    World world = World::freeze(on_smooth_floor(2.0)).value();
    constexpr double speed = 0.02;
    // m x'' = k (v t - x) + c (v - x'): the lag v t - x is a damped oscillator from 0 at speed v.
    const double decay = 0.5 * 2.0 / 0.1;
    const double frequency = std::sqrt(stiffness / 0.1 - decay * decay);
    double worst = 0.0;
    for (int i = 0; i < 1000; ++i) {
        ASSERT_FALSE(world.set_hand(
            0, pressing(2.0, {speed * i * tick_s, 0, 0}, {speed, 0.0, 0.0}, 2.0 * half)));
        world.tick();
        const double t = (i + 1) * tick_s;
        const double lag = speed / frequency * base::exp(-decay * t) * base::sin(frequency * t);
        worst = std::max(worst, std::abs(world.position(0).x() - (speed * t - lag)));
        EXPECT_FALSE(world.state().slips[0].slides);
    }
    EXPECT_LE(worst, 4e-7); // of 0.28 mm; second order: measured 3.1e-7
    EXPECT_NEAR(world.velocity(0).x(), speed, 1e-4 * speed); // e^-10
    EXPECT_NEAR(world.touch(0).on_hand.x(), 0.0, 1e-4);
}

TEST(HandFriction, AHandThatIsTooFastGivesItsConeAndNoMore)
{
    World world = World::freeze(on_smooth_floor(0.0)).value();
    constexpr double speed = 0.5;
    for (int i = 0; i < 40; ++i) {
        ASSERT_FALSE(world.set_hand(0, pressing(2.0, {-0.01 + speed * i * tick_s, 0.0, 0.0},
                                                {speed, 0.0, 0.0}, 2.0 * half)));
        const double before = world.velocity(0).x();
        world.tick();
        const double slid_from = sticking * 2.0 / stiffness / speed / tick_s;
        if (i < slid_from + 2.0) continue;
        EXPECT_NEAR(0.1 * (world.velocity(0).x() - before) / tick_s, sliding * 2.0, 1e-12) << i;
        EXPECT_NEAR(world.touch(0).on_hand.x(), -sliding * 2.0, 1e-12);
        EXPECT_TRUE(world.state().slips[0].slides);
    }
}

TEST(HandFriction, NothingDriftsWhileItSticks)
{
    Description scene = on_smooth_floor(2.0);
    scene.bodies[0].turning = Turning::free;
    scene.planes[0].material.friction = 0.5;
    scene.bodies[0].material.friction = 0.5;
    scene.own_hands.resize(1);
    World world = World::freeze(scene).value();
    const HandInput pulled = pressing(2.0, {1e-3, 0.0, 0.0}, {}, 2.0 * half);
    ASSERT_FALSE(world.set_hand(0, pressing(2.0, {0.5e-3, 0.0, 0.0}, {}, 2.0 * half)));
    run(world, 10);
    ASSERT_FALSE(world.set_hand(0, pulled));
    run(world, 1000); // 0.25 N of 1.2 N that the hand, and 1.5 N that the floor could hold
    const BodyState before = world.body(0);
    const base::Force felt = world.touch(0).on_hand;
    EXPECT_NEAR(felt.x(), -stiffness * 0.5e-3, 1e-6);
    run(world, 20'000);
    // The solver's rest, 1e-10 of the speed that gravity adds in a tick, would be 2e-11 m by now.
    EXPECT_LE(length(world.body(0).position.value - before.position.value), 1e-11);
    EXPECT_LE(length(world.touch(0).on_hand.value - felt.value), 1e-8);
}

/// A mass on a spring and a hand that is drawn over it: the classical stick-slip oscillator, with
/// the friction of this library in steps of a microsecond.
struct StickSlip {
    double place = 0.0, speed = 0.0; // of the mass
    double stretch = 0.0;
    bool slides = false;
    double farthest = 0.0;
    int slips = 0;

    void advance(int steps, double drawn, double push)
    {
        constexpr double step = 1e-6;
        constexpr double mass = 0.1, spring = 50.0, damping = 2.0;
        for (int i = 0; i < steps; ++i) {
            const double over = drawn - speed;
            const double limit = (slides ? sliding : sticking) * push;
            double pull = stiffness * stretch + damping * over;
            stretch += step * over;
            const bool cut = std::abs(pull) > limit;
            if (cut) {
                pull = std::copysign(limit, pull);
                stretch = std::clamp(stretch, -limit / stiffness, limit / stiffness);
            }
            if (cut && !slides) ++slips;
            slides = cut;
            speed += step / mass * (pull - spring * place);
            place += step * speed;
            farthest = std::max(farthest, place);
        }
    }
};

TEST(HandFriction, SticksAndSlipsWithThePeriodAndTheWayOfAFineIntegration)
{
    Description scene = on_smooth_floor(2.0);
    scene.fields.push_back({.name = "spring",
                            .position = {{0.0, half, 0.0}},
                            .stiffness_n_per_m = 50.0,
                            .line = glm::dvec3{0.0, 1.0, 0.0},
                            .on_hands = false,
                            .on_bodies = true});
    scene.bodies[0].half.x = 0.5; // a long way to draw the hand over
    World world = World::freeze(scene, {.tick = std::chrono::microseconds{250}}).value();
    constexpr double tick = 250e-6, drawn = 0.05, push = 1.0;
    StickSlip reference;
    double farthest = 0.0, worst = 0.0;
    int slips = 0;
    bool slid = false;
    for (int i = 0; i < 8000; ++i) {
        ASSERT_FALSE(world.set_hand(
            0, pressing(push, {-0.2 + drawn * i * tick, 0, 0}, {drawn, 0, 0}, 2.0 * half)));
        world.tick();
        reference.advance(250, drawn, push);
        const HandSlip& slip = world.state().slips[0];
        if (slip.slides && !slid) ++slips;
        slid = slip.slides;
        farthest = std::max(farthest, world.position(0).x());
        worst = std::max(worst, std::abs(world.position(0).x() - reference.place));
    }
    EXPECT_EQ(reference.slips, 6);
    EXPECT_EQ(slips, reference.slips);
    EXPECT_NEAR(farthest, reference.farthest, 0.005 * reference.farthest);
    EXPECT_LE(worst, 0.01 * reference.farthest) << slips;
}

/// Kinetic energy and the energy in the hand's springs.
double energy_of(const World& world)
{
    const BodyState body = world.body(0);
    const glm::dvec3& v = body.velocity.value;
    const glm::dvec3& w = body.angular_velocity;
    const double inertia = 0.1 * 4.0 * half * half / 6.0;
    return 0.5 * 0.1 * glm::dot(v, v) + 0.5 * inertia * glm::dot(w, w);
}

TEST(HandFriction, IsPassiveAtAnyStiffness)
{
    for (const double k : {1e1, 1e3, 1e5, 1e7, 1e9}) {
        for (const Turning turning : {Turning::locked, Turning::free}) {
            Description scene = on_smooth_floor(0.0);
            scene.gravity = glm::dvec3{0.0};
            scene.bodies[0].turning = turning;
            scene.bodies[0].velocity.value = {1.0, 0.0, 0.3};
            scene.hands.stiffness_n_per_m = k;
            World world = World::freeze(scene).value();
            // A resting hand, 0.5 N on the floor's cube.
            const double deep = 0.5 / k;
            ASSERT_FALSE(world.set_hand(
                0, {.position = {{0.0, 2.0 * half + radius - deep, 0.0}}, .velocity = {}}));
            const double all = energy_of(world) + 0.5 * k * deep * deep;
            for (int i = 0; i < 300; ++i) {
                world.tick();
                EXPECT_LE(energy_of(world), all * (1.0 + 1e-9)) << k << " tick " << i;
            }
        }
    }
}

TEST(HandFriction, GivesTheBodyWhatItTakesFromTheHandsAndNoMoreThanTheirGreatestForce)
{
    Description scene = rough_hands(2);
    scene.gravity = glm::dvec3{0.0};
    scene.hands.force_max_n = 1.0;
    scene.hands.damping_ns_per_m = 1.0;
    scene.bodies.push_back(rough_cube({0.0, 0.0, 0.0}));
    World world = World::freeze(scene).value();
    glm::dvec3 given{0.0};
    double most = 0.0, across = 0.0;
    for (int i = 0; i < 100; ++i) {
        const double swing = 0.01 * base::sin(0.1 * i);
        for (const std::uint32_t hand : {0U, 1U}) {
            const double side = hand == 0 ? -1.0 : 1.0;
            ASSERT_FALSE(world.set_hand(
                hand, {.position = {{side * (half + 0.001), side * swing, 0.5 * swing}},
                       .velocity = {{0.0, side * base::cos(0.1 * i), 0.0}}}));
        }
        world.tick();
        for (const std::uint32_t hand : {0U, 1U}) {
            const glm::dvec3& felt = world.touch(hand).on_hand.value;
            given -= tick_s * felt;
            most = std::max(most, length(felt));
            across = std::max(across, std::abs(felt.y));
        }
        EXPECT_LE(length(0.1 * world.velocity(0).value - given), 1e-15);
    }
    EXPECT_LE(most, 1.0 + 1e-9);
    EXPECT_GE(across, 0.3); // both parts were there
}

TEST(HandFriction, CostsAFeatureAndAHashOnlyWhereHandsAndWhatTheyMeetAreRough)
{
    Description scene = on_smooth_floor(0.0);
    const auto needs = [](const Description& one) {
        return required_features(requirements_of(one, true)).has(Feature::hand_friction);
    };
    EXPECT_TRUE(needs(scene));
    Description smooth_hands = scene;
    smooth_hands.hands.static_friction = 0.0;
    smooth_hands.hands.dynamic_friction.reset();
    EXPECT_FALSE(needs(smooth_hands));
    EXPECT_NE(hash(smooth_hands), hash(scene));
    EXPECT_TRUE(World::freeze(smooth_hands).value().state().slips.empty());
    Description smooth_body = scene;
    smooth_body.bodies[0].feel = {};
    EXPECT_FALSE(needs(smooth_body));
    EXPECT_NE(hash(smooth_body), hash(scene));
    smooth_body.planes[0].material.friction = 0.5;
    EXPECT_FALSE(needs(smooth_body));
    smooth_body.planes[0].felt = true;
    EXPECT_TRUE(needs(smooth_body));
    Description own = smooth_hands;
    own.own_hands = {{.static_friction = 0.5}};
    EXPECT_TRUE(needs(own));
    EXPECT_NE(hash(own), hash(smooth_hands));
}

TEST(HandFriction, IsTheHandsOwnThenThatOfAllHandsAndTheBodysOwnThenThatOfItsMaterial)
{
    HandDescription hands{.static_friction = 0.6, .dynamic_friction = 0.4};
    EXPECT_EQ(friction_of(hands, {}), (HandFriction{0.6, 0.4}));
    EXPECT_EQ(friction_of(hands, {.static_friction = 0.2}), (HandFriction{0.2, 0.2}));
    EXPECT_EQ(friction_of(hands, {.dynamic_friction = 0.1}), (HandFriction{0.6, 0.1}));
    EXPECT_EQ(friction_of(Material{.friction = 0.3}), (HandFriction{0.3, 0.3}));
    EXPECT_EQ(friction_of(Material{.friction = 0.3}, {.static_friction = 0.9}),
              (HandFriction{0.9, 0.9}));
    EXPECT_EQ(combined(HandFriction{0.25, 0.0625}, HandFriction{1.0, 0.25}),
              (HandFriction{0.5, 0.125}));
    hands.dynamic_friction = 0.7;
    Description scene;
    scene.hands = hands;
    EXPECT_FALSE(check(scene));
    scene.hands.dynamic_friction = 0.6;
    EXPECT_TRUE(check(scene));
    scene.own_hands = {{.static_friction = 0.1, .dynamic_friction = 0.2}};
    EXPECT_FALSE(check(scene));
}

TEST(HandFriction, TheSceneOfStickAndSlipIsReadPrintedAndPlayed)
{
    const Description scene = test::bench_scene("stick-slip");
    EXPECT_EQ(parse_scene(to_text(scene), "again").value(), scene);
    World world = World::freeze(scene).value();
    for (const std::uint32_t hand : {0U, 1U}) { // over the block
        for (int i = 0; i < 200; ++i) {
            ASSERT_FALSE(world.set_hand(hand, {.position = {{0.1 + 1e-4 * i, half + 0.004, 0.0}},
                                               .velocity = {{0.1, 0, 0}}}));
            world.tick();
        }
        const double sliding_of_both = std::sqrt(0.8 * (hand == 0 ? 0.5 : 0.1));
        EXPECT_NEAR(world.touch(hand).on_hand.x(), -0.5 * sliding_of_both, 1e-9);
        ASSERT_FALSE(world.set_hand(hand, {.position = {}, .velocity = {}, .present = false}));
    }
}

} // namespace
} // namespace hapnet::scene::hand_friction_test
