// SPDX-FileCopyrightText: 2026 The Hapnet authors
// SPDX-License-Identifier: MIT
#pragma once

#include "peer/core/scene/bodies.hpp"
#include "peer/core/scene/contact/measures.hpp"

#include <vector>

namespace hapnet::scene {

/// Where the bodies' boxes are at the start of a tick: found when they are asked for, and only of
/// what has moved since. Nobody asks for a body that flies alone.
class Boxes {
public:
    explicit Boxes(const Bodies& bodies);

    void begin_tick() { ++now_; }
    /// The reference is good until the next tick.
    [[nodiscard]] const OrientedBox& at(const Bodies& bodies, BodyId body)
    {
        Entry& entry = entries_[body];
        if (entry.seen != now_) renew(bodies, body, entry);
        return entry.box;
    }

private:
    struct Entry {
        OrientedBox box;
        glm::dquat orientation{1.0, 0.0, 0.0, 0.0};
        std::uint64_t seen = 0;
    };

    void renew(const Bodies& bodies, BodyId body, Entry& entry) const;

    std::vector<Entry> entries_; // by id
    std::uint64_t now_ = 0;
};

} // namespace hapnet::scene
