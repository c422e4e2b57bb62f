// SPDX-FileCopyrightText: 2026 The Hapnet authors
// SPDX-License-Identifier: MIT
#include "scene/collide/boxes.hpp"

#include "scene/maths/rotation.hpp"
#include "scene/rigid/integrate.hpp"

#include <cmath>
#include <glm/geometric.hpp>

namespace hapnet::scene {

SweptBoxes::SweptBoxes(const Bodies& bodies, const Scales& scales)
    : scales_{scales}, entries_(bodies.size())
{
    for (Slot slot = 0; slot < bodies.size(); ++slot) {
        const glm::dvec3& half = bodies.properties[slot].half;
        const SweptBox now{box_of(bodies, slot), std::sqrt(glm::dot(half, half)),
                           reach_of(bodies, slot, scales)};
        entries_[bodies.properties[slot].id] = {now, bodies.orientation.at(slot), 0};
    }
}

void SweptBoxes::renew(const Bodies& bodies, BodyId body, Entry& entry) const
{
    const Slot slot = bodies.slot_of[body];
    entry.seen = now_;
    entry.now.box.centre = bodies.position.at(slot);
    entry.now.reach = reach_of(bodies, slot, scales_);
    const glm::dquat orientation = bodies.orientation.at(slot);
    if (orientation == entry.orientation) return;
    entry.orientation = orientation;
    entry.now.box.axes = axes_of(orientation);
}

} // namespace hapnet::scene
