// SPDX-FileCopyrightText: 2026 The Hapnet authors
// SPDX-License-Identifier: MIT
#pragma once

#include "scene/collide/manifold.hpp"

namespace hapnet::scene {

/// The axis that decided last time: tried first the next time, and kept unless another is clearly
/// better, so that a resting contact does not change its mind.
struct BoxBoxMemory {
    std::int8_t axis = -1; // 0-2 faces of the first, 3-5 of the second, 6-14 edges; -1: none
};

/// Finds where two boxes touch: by separating axes, then clipping of the faces (or two edges'
/// closest points), reduced to four points in a fixed order. Points up to `margin` >= 0 apart
/// count; no points when the boxes are farther apart, though within the margin there may be none
/// either, where corners pass each other. SweptBoxes that overlap have one at least. All tolerances
/// are relative to the smallest half edge of the two: an axis is kept, and a face taken before an
/// edge, unless another is better by more than 1/128; edges of faces that lie flush count as one
/// within 1/256. A feature is face, edge or corner of each box, see features.hpp. Mirrored boxes
/// give the same points mirrored, to the bit. Round bodies: see round_manifold().
[[nodiscard]] Manifold collide(const OrientedBox& a, const OrientedBox& b, double margin,
                               BoxBoxMemory& memory);

} // namespace hapnet::scene
