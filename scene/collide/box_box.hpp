// SPDX-FileCopyrightText: 2026 The Hapnet authors
// SPDX-License-Identifier: MIT
#pragma once

#include "scene/collide/manifold.hpp"

namespace hapnet::scene {

/// The separating axis that decided last time. It is tried first the next time and kept unless
/// another axis is clearly better, so that a resting contact does not switch between axes.
struct BoxBoxMemory {
    std::int8_t axis = -1; // 0-2 faces of the first, 3-5 of the second, 6-14 edges; -1: none
};

/// Finds where two boxes touch, by separating axes, then by clipping of the faces or by two edges'
/// closest points. The result is reduced to four points in a fixed order. Points up to `margin` >=
/// 0 apart count. Boxes that are farther apart have no points. Boxes within the margin may have
/// none either, where their corners pass each other. Boxes that overlap have at least one point.
///
/// All tolerances are relative to the smallest half edge of the two. An axis is kept, and a face is
/// taken before an edge, unless another axis is better by more than 1/128. Edges of faces that lie
/// flush count as one within 1/256. A feature is a face, an edge or a corner of each box, see
/// FeatureBits. Mirrored boxes give the same points mirrored, to the bit. For round bodies see
/// round_manifold().
[[nodiscard]] Manifold collide(const OrientedBox& a, const OrientedBox& b, double margin,
                               BoxBoxMemory& memory);

} // namespace hapnet::scene
