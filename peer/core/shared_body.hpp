// SPDX-FileCopyrightText: 2026 The Hapnet authors
// SPDX-License-Identifier: MIT
#pragma once

#include "proto/base/result.hpp"
#include "scene/world.hpp"

#include <span>
#include <vector>

namespace hapnet::peer {

/// One of the bodies that all peers of a session move.
struct SharedBody {
    scene::BodyId id = 0;
    scene::Turning turning = scene::Turning::locked;
    double reach_m = 0.0; // from its centre of mass to its farthest point

    [[nodiscard]] bool turns() const { return turning != scene::Turning::locked; }
};

/// The bodies of a scene that a session shares, by their ids: all that are movable, one to
/// wire::bodies_max of them. The error names what a session cannot have, and the cure.
[[nodiscard]] base::Result<std::vector<SharedBody>> shared_bodies(const scene::Description& scene);

/// The first shared body, which stands for all of them in the ticks of a record.
[[nodiscard]] base::Result<scene::BodyId> shared_body(const scene::Description& scene);

/// True if only one body is shared and it does not turn, as in the paper. Every algorithm can play
/// it.
[[nodiscard]] bool is_one_without_turning(std::span<const SharedBody> bodies);

} // namespace hapnet::peer
