// SPDX-FileCopyrightText: 2026 The Hapnet authors
// SPDX-License-Identifier: MIT
#pragma once

#include "scene/one_box/step.hpp"

#include <limits>

namespace hapnet::scene {

/// A sliding tick on a stage of its own.
template <bool coulomb>
struct Rig {
    Frozen frozen;
    Stage stage;
    SlidingTick<coulomb> sliding;

    explicit Rig(const Description& scene, double tick = 1e-3)
        : frozen{scene.planes, scene.hips, scene.gravity, tick, true},
          stage{.bodies = Bodies{scene}},
          sliding{scene, frozen, stage}
    {
        for (HipInput& hip : stage.hips) hip.present = false;
        stage.pushes.resize(scene.bodies.size());
        stage.pushed = Bounded<BodyId>{scene.bodies.size()};
    }
    void tick(int times = 1)
    {
        for (int i = 0; i < times; ++i) sliding.tick(frozen, stage);
    }
    /// Moves the hands on by their velocities before every tick but the first.
    void carry(int times)
    {
        for (int i = 0; i < times; ++i) {
            tick();
            for (HipInput& hip : stage.hips) {
                hip.position.value += frozen.tick * hip.velocity.value;
            }
        }
    }
    void hip(std::uint32_t index, const glm::dvec3& position, const glm::dvec3& velocity = {})
    {
        stage.hips[index] = {{position}, {velocity}};
    }
    void place(const glm::dvec3& position, const glm::dvec3& velocity = {})
    {
        stage.bodies.position.put(0, position);
        stage.bodies.velocity.put(0, velocity);
    }
    [[nodiscard]] glm::dvec3 position() const { return stage.bodies.position.at(0); }
    [[nodiscard]] glm::dvec3 velocity() const { return stage.bodies.velocity.at(0); }
    [[nodiscard]] const HipTouch& touch(std::uint32_t hip) const { return stage.touches[hip]; }
};

/// A cube of 40 mm and 100 g in empty space without gravity.
inline Description lone_cube()
{
    Description scene;
    scene.bodies.resize(1);
    scene.bodies[0].turning = Turning::locked;
    scene.gravity = glm::dvec3{0.0};
    scene.hips.damping_ns_per_m = 0.0;
    scene.hips.force_max_n = std::numeric_limits<double>::infinity();
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
