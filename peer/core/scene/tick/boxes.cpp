// SPDX-FileCopyrightText: 2026 The Hapnet authors
// SPDX-License-Identifier: MIT
#include "peer/core/scene/tick/boxes.hpp"

#include "peer/core/scene/motion/rotation.hpp"
#include "peer/core/scene/tick/courses.hpp"

namespace hapnet::scene {

Boxes::Boxes(const Bodies& bodies) : entries_(bodies.size())
{
    for (Slot slot = 0; slot < bodies.size(); ++slot) {
        entries_[bodies.form[slot].id] = {box_of(bodies, slot), bodies.orientation.at(slot), 0};
    }
}

void Boxes::renew(const Bodies& bodies, BodyId body, Entry& entry) const
{
    const Slot slot = bodies.slot_of[body];
    entry.seen = now_;
    entry.box.centre = bodies.position.at(slot);
    const glm::dquat orientation = bodies.orientation.at(slot);
    if (orientation == entry.orientation) return;
    entry.orientation = orientation;
    entry.box.axes = axes_of(orientation);
}

} // namespace hapnet::scene
