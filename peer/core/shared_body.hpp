// SPDX-FileCopyrightText: 2026 The Hapnet authors
// SPDX-License-Identifier: MIT
#pragma once

#include "proto/base/result.hpp"
#include "scene/world.hpp"

#include <span>
#include <vector>

namespace hapnet::peer {

/// A body that all peers of a session can move.
struct SharedBody {
    scene::BodyId id = 0;
    scene::Turning turning = scene::Turning::locked;
    double reach_m = 0.0; // from the centre of mass to the farthest point

    [[nodiscard]] bool turns() const { return turning != scene::Turning::locked; }
};

/// Returns the bodies of a scene that a session shares, sorted by id: all that are movable, one to
/// wire::bodies_max of them. The error names what a session does not support, and the cure.
[[nodiscard]] base::Result<std::vector<SharedBody>> shared_bodies(const scene::Description& scene);

/// Returns the first shared body, which represents all of them in the ticks of a record.
[[nodiscard]] base::Result<scene::BodyId> shared_body(const scene::Description& scene);

/// True if only one body is shared and it does not turn, as in the paper. Every algorithm can play
/// it.
[[nodiscard]] bool is_one_without_turning(std::span<const SharedBody> bodies);

} // namespace hapnet::peer
