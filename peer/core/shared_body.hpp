// SPDX-FileCopyrightText: 2026 The Hapnet authors
// SPDX-License-Identifier: MIT
#pragma once

#include "proto/base/result.hpp"
#include "scene/world.hpp"

namespace hapnet::peer {

/// The one body of a scene that two peers share; the error says why they cannot. A session shares
/// exactly one movable body, and one that does not rotate: messages carry its position and
/// velocity, but no orientation.
[[nodiscard]] base::Result<scene::BodyId> shared_body(const scene::Description& scene);

} // namespace hapnet::peer
