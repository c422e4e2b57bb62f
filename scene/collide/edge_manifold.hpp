// SPDX-FileCopyrightText: 2026 The Hapnet authors
// SPDX-License-Identifier: MIT
#pragma once

#include "scene/collide/manifold.hpp"

namespace hapnet::scene {

/// An edge of one box across an edge of another: which axes (0..2) they are parallel to.
struct EdgePair {
    int of_a = 0;
    int of_b = 0;
};

/// Where two edges cross, the outermost of their axes towards each other: one point between the
/// nearest points of the two, or none when they are farther apart than `margin` or pass each other
/// by more than 1/256 of the boxes' smallest half edge. The edges must not be parallel.
[[nodiscard]] Manifold edge_manifold(const OrientedBox& a, const OrientedBox& b, EdgePair edges,
                                     double margin);

} // namespace hapnet::scene
