// SPDX-FileCopyrightText: 2026 The Hapnet authors
// SPDX-License-Identifier: MIT
#include "peer/core/contact.hpp"

#include <algorithm>
#include <cmath>

namespace hapnet::peer {

namespace {

glm::dvec3 closest_point(const Box& box, const glm::dvec3& from_centre)
{
    return {std::clamp(from_centre.x, -box.half.x, box.half.x),
            std::clamp(from_centre.y, -box.half.y, box.half.y),
            std::clamp(from_centre.z, -box.half.z, box.half.z)};
}

} // namespace

std::optional<Overlap> SphereBoxContact::find(const Box& box, base::Position centre, double radius)
{
    const glm::dvec3 local = (centre - box.centre).value;
    const glm::dvec3 outward = local - closest_point(box, local);
    const double gap = base::norm(base::Displacement{outward});
    if (gap >= radius) {
        entered_.reset();
        return std::nullopt;
    }
    if (gap > 0.0) { // the centre is outside: the closest point decides
        int axis = 0;
        for (const int i : {1, 2}) {
            if (std::abs(outward[i]) > std::abs(outward[axis])) axis = i;
        }
        entered_ = Face{axis, outward[axis] < 0.0 ? -1.0 : 1.0};
        return Overlap{radius - gap, outward / gap};
    }
    if (!entered_) { // suddenly inside: the nearest face
        Face nearest;
        double depth = box.half.x - std::abs(local.x);
        for (const int i : {1, 2}) {
            if (box.half[i] - std::abs(local[i]) < depth) {
                depth = box.half[i] - std::abs(local[i]);
                nearest.axis = i;
            }
        }
        nearest.sign = local[nearest.axis] < 0.0 ? -1.0 : 1.0;
        entered_ = nearest;
    }
    Overlap overlap{.depth =
                        radius + box.half[entered_->axis] - entered_->sign * local[entered_->axis]};
    overlap.normal[entered_->axis] = entered_->sign;
    return overlap;
}

double distance(const Box& box, base::Position point)
{
    const glm::dvec3 local = (point - box.centre).value;
    return base::norm(base::Displacement{local - closest_point(box, local)});
}

double contact_force(const Scene& scene, double depth, double closing_speed)
{
    return std::clamp(scene.stiffness_n_per_m * depth + scene.damping_ns_per_m * closing_speed, 0.0,
                      scene.force_max_n);
}

} // namespace hapnet::peer
