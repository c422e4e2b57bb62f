// SPDX-FileCopyrightText: 2026 The Hapnet authors
// SPDX-License-Identifier: MIT
#pragma once

#include "scene/collide/manifold.hpp"

namespace hapnet::scene {

/// Finds where a box lies on the face of a reference box that looks at it along `axis` (0..2): the
/// face of the incident box that looks back most, cut at the reference face's edges (Sutherland and
/// Hodgman 1974). The normal goes from the reference to the incident box. Points lie on the
/// reference face or within; what is farther off than `margin` does not count. Where the two faces'
/// edges lie within 1/256 of the smaller face's half edge they count as one, so that boxes that lie
/// flush do not change their features with every rounding.
[[nodiscard]] Manifold face_manifold(const OrientedBox& reference, const OrientedBox& incident,
                                     int axis, double margin);

/// An edge of one box across an edge of another: which axes (0..2) they are parallel to.
struct EdgePair {
    int of_a = 0;
    int of_b = 0;
};

/// Finds where two edges cross, the outermost of their axes towards each other: one point between
/// the nearest points of the two, or none when they are farther apart than `margin` or pass each
/// other by more than 1/256 of the boxes' smallest half edge. The edges must not be parallel.
[[nodiscard]] Manifold edge_manifold(const OrientedBox& a, const OrientedBox& b, EdgePair edges,
                                     double margin);

} // namespace hapnet::scene
