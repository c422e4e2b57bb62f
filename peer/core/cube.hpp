// SPDX-FileCopyrightText: 2026 The Hapnet authors
// SPDX-License-Identifier: MIT
#pragma once

#include "peer/core/scene.hpp"
#include "proto/base/time.hpp"

namespace hapnet::peer {

/// The movable cube of one peer's copy of the scene: slides on the platform under viscous
/// friction, stops without bounce at the static cube, does not rotate.
///
/// One step holds the forces of its start (zero-order hold). The velocity is exact for linear
/// drag; the position takes the velocity at the end of the step (semi-implicit Euler, first
/// order): with forces held that is the stable choice, a higher-order position is not.
class Cube {
public:
    Cube(const Scene& scene, base::Duration tick);

    [[nodiscard]] base::Position position() const { return box_.centre; }
    [[nodiscard]] base::Velocity velocity() const { return velocity_; }
    [[nodiscard]] const Box& box() const { return box_; }

    /// One tick under `force`; gravity, platform, drag and the static cube are its own affair.
    void step(base::Force force);

    /// Puts the cube somewhere, regardless of what it was doing.
    void place(base::Position position, base::Velocity velocity);

private:
    void stop_at_platform();
    void stop_at_static_cube(const Box& before);

    Box static_cube_;
    double rest_height_; // of the centre when it stands on the platform
    double mass_;
    double gravity_;
    double tick_;         // seconds
    double kept_on_drag_; // the share of its speed that drag leaves after one tick
    double push_on_drag_; // m/s gained in one tick per newton, under drag
    Box box_;
    base::Velocity velocity_;
};

} // namespace hapnet::peer
