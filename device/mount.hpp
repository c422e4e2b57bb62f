// SPDX-FileCopyrightText: 2026 The Hapnet authors
// SPDX-License-Identifier: MIT
#pragma once

#include "proto/base/space.hpp"

namespace hapnet::device {

/// The position of a device in the scene: scene = offset + scale * device. All axes have one scale,
/// because otherwise pushing along one axis would do work along another. Forces are converted back
/// by the same scale, so that the power at the hand is the power in the scene.
struct Mount {
    base::Displacement offset{};
    double scale = 1.0; // metres of the scene per metre of the device; above 0

    [[nodiscard]] base::Position to_scene(const base::Position& p) const
    {
        return {offset.value + scale * p.value};
    }
    [[nodiscard]] base::Velocity to_scene(const base::Velocity& v) const
    {
        return {scale * v.value};
    }
    [[nodiscard]] base::Position to_device(const base::Position& p) const
    {
        return {(1.0 / scale) * (p.value - offset.value)};
    }
    [[nodiscard]] base::Velocity to_device(const base::Velocity& v) const
    {
        return {(1.0 / scale) * v.value};
    }
    [[nodiscard]] base::Force to_device(const base::Force& f) const { return {scale * f.value}; }

    friend bool operator==(const Mount&, const Mount&) = default;
};

} // namespace hapnet::device
