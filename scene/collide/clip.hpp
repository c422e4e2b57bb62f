// SPDX-FileCopyrightText: 2026 The Hapnet authors
// SPDX-License-Identifier: MIT
#pragma once

#include "scene/collide/manifold.hpp"

namespace hapnet::scene {

/// Finds the contact of a box with one face of a reference box. That face is the one across `axis`
/// (0..2) that faces the incident box. The face of the incident box that faces the reference box
/// most is cut at the reference face's edges (Sutherland and Hodgman 1974). The normal points from
/// the reference box to the incident box. Points lie on the reference face or below it; points more
/// than `margin` above it do not count. Edges of the two faces within 1/256 of the smaller face's
/// half edge count as one, so that boxes that lie flush do not change their features with every
/// rounding.
[[nodiscard]] Manifold face_manifold(const OrientedBox& reference, const OrientedBox& incident,
                                     int axis, double margin);

/// An edge of one box across an edge of another: the axes (0..2) that the two edges are parallel
/// to.
struct EdgePair {
    int of_a = 0;
    int of_b = 0;
};

/// Finds the contact of two edges that cross. The edges are the outermost ones along their axes,
/// towards the other box. The contact is one point between the nearest points of the two edges.
/// There is none when the edges are farther apart than `margin`, or pass each other by more than
/// 1/256 of the boxes' smallest half edge. The edges must not be parallel.
[[nodiscard]] Manifold edge_manifold(const OrientedBox& a, const OrientedBox& b, EdgePair edges,
                                     double margin);

} // namespace hapnet::scene
