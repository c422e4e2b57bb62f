// SPDX-FileCopyrightText: 2026 The Hapnet authors
// SPDX-License-Identifier: MIT
#pragma once

#include "proto/base/result.hpp"
#include "scene/world.hpp"

namespace hapnet::peer {

/// The one body of a scene that two peers share; the error says why they cannot. A session shares
/// one movable body so far, and one that does not turn: its messages tell where it is and how fast
/// it moves, and nothing of how it is turned.
[[nodiscard]] base::Result<scene::BodyId> shared_body(const scene::Description& scene);

/// Puts a body where a peer says that it is. How it is turned stays as it is.
void put(scene::World& world, scene::BodyId body, base::Position position, base::Velocity velocity);

} // namespace hapnet::peer
