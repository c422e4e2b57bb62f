// SPDX-FileCopyrightText: 2026 The Hapnet authors
// SPDX-License-Identifier: MIT
#pragma once

#include "scene/one_box/step.hpp"

#include <limits>

namespace hapnet::scene {

/// A one-box stepper with its own state.
template <bool coulomb>
struct Rig {
    WorldConfig config;
    WorldState state;
    OneBoxStepper<coulomb> stepper;

    explicit Rig(const Description& scene, double tick = 1e-3)
        : config{scene.planes, scene.hands, scene.gravity, tick, true},
          state{.bodies = Bodies{scene}},
          stepper{scene, config, state}
    {
        for (HandInput& hand : state.hands) hand.present = false;
        state.pushes.resize(scene.bodies.size());
        state.pushed = Bounded<BodyId>{scene.bodies.size()};
    }
    void tick(int times = 1)
    {
        for (int i = 0; i < times; ++i) stepper.step(config, state);
    }
    /// Moves the hands on by their velocities before every tick but the first.
    void carry(int times)
    {
        for (int i = 0; i < times; ++i) {
            tick();
            for (HandInput& hand : state.hands) {
                hand.position.value += config.tick * hand.velocity.value;
            }
        }
    }
    void set_hand(std::uint32_t index, const glm::dvec3& position, const glm::dvec3& velocity = {})
    {
        state.hands[index] = {{position}, {velocity}};
    }
    void place(const glm::dvec3& position, const glm::dvec3& velocity = {})
    {
        state.bodies.position.put(0, position);
        state.bodies.velocity.put(0, velocity);
    }
    [[nodiscard]] glm::dvec3 position() const { return state.bodies.position.at(0); }
    [[nodiscard]] glm::dvec3 velocity() const { return state.bodies.velocity.at(0); }
    [[nodiscard]] const HandTouch& touch(std::uint32_t hand) const { return state.touches[hand]; }
};

/// A cube of 40 mm and 100 g in empty space without gravity.
inline Description lone_cube()
{
    Description scene;
    scene.bodies.resize(1);
    scene.bodies[0].turning = Turning::locked;
    scene.gravity = glm::dvec3{0.0};
    scene.hands.damping_ns_per_m = 0.0;
    scene.hands.force_max_n = std::numeric_limits<double>::infinity();
    return scene;
}

/// ... on a platform, with gravity.
inline Description cube_on_platform(double friction = 0.0, double drag = 0.0)
{
    Description scene = lone_cube();
    scene.gravity = {0.0, -9.81, 0.0};
    scene.bodies[0].drag_ns_per_m = drag;
    scene.bodies[0].material.friction = friction;
    scene.planes = {{.name = "platform", .offset_m = -0.020, .material = {.friction = friction}}};
    return scene;
}

} // namespace hapnet::scene
