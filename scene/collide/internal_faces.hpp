// SPDX-FileCopyrightText: 2026 The Hapnet authors
// SPDX-License-Identifier: MIT
#pragma once

#include "scene/bodies.hpp"
#include "scene/collide/manifold.hpp"
#include "scene/collide/sphere_box.hpp"

#include <optional>
#include <vector>

namespace hapnet::scene {

/// The faces of boxes that lie inside a solid: between fixed bodies that lie flush, and between the
/// parts of one body. Nothing touches such a face, so a floor of tiles feels like one slab. The
/// faces are found when a scene is frozen.
class InternalFaces {
public:
    InternalFaces() = default;
    explicit InternalFaces(const Bodies& bodies);

    /// True if any part has a neighbour.
    [[nodiscard]] bool any() const { return !neighbours_.empty(); }
    /// True if a part has a neighbour.
    [[nodiscard]] bool has(PartId part) const
    {
        return any() && first_[part] != first_[part + std::size_t{1}];
    }

    /// True if the way out of a part, from a point of its surface along a unit normal, leads into a
    /// neighbour. Point and normal are in the part's own frame. A normal that leans towards a face
    /// by less than `lean` (a sine) does not lead through that face.
    [[nodiscard]] bool leads_inside(PartId part, const glm::dvec3& half, const LocalOverlap& at,
                                    double lean) const;
    /// True if a neighbour with a lower id has the same point of the surface. Then only the
    /// neighbour's counts.
    [[nodiscard]] bool is_shared(PartId part, const LocalOverlap& at) const;
    /// Returns the face nearest to a place in the part that is not internal there.
    [[nodiscard]] std::optional<BoxFace> nearest_outer_face(PartId part, const glm::dvec3& half,
                                                            const glm::dvec3& place) const;

    /// One of the two boxes of a contact.
    struct Side {
        PartId part = 0;
        const OrientedBox& box;
    };
    /// Keeps only those points of a contact, from `a` to `b`, at which neither face is internal.
    void leave_outer(const Side& a, const Side& b, Manifold& manifold) const;

private:
    struct Neighbour {
        PartId part = 0;
        OrientedBox box; // in the frame of the part that has this neighbour
    };

    void leave_outer_of(const Side& side, bool is_first, double lean, Manifold& manifold) const;
    [[nodiscard]] bool is_covered(PartId part, const glm::dvec3& half, const glm::dvec3& place,
                                  const BoxFace& face) const;

    std::vector<Neighbour> neighbours_{}; // of all parts, part by part
    std::vector<std::uint32_t> first_{};  // by PartId: its first neighbour; one extra entry
};

} // namespace hapnet::scene
