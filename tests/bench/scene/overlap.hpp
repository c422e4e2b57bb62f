// SPDX-FileCopyrightText: 2026 The Hapnet authors
// SPDX-License-Identifier: MIT
#pragma once

#include "tests/bench/scene/engine.hpp"

namespace hapnet::bench {

/// How deep the bodies lie within each other and within the planes, at the deepest, m; 0 when
/// nothing overlaps. Computed from where an engine says that they are, not from its contacts: of
/// two boxes the shortest way that parts them (separating axes).
[[nodiscard]] double deepest_overlap(const scene::Description& scene, const Engine& engine);

} // namespace hapnet::bench
