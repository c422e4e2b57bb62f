// SPDX-FileCopyrightText: 2026 The Hapnet authors
// SPDX-License-Identifier: MIT
#pragma once

#include "tests/bench/scene/engine.hpp"

namespace hapnet::bench {

/// Returns the deepest overlap of bodies with each other and with planes, m; 0 without overlap. It
/// follows from the poses that an engine reports, not from its contacts. For two boxes it is the
/// shortest way that separates them (separating axes).
[[nodiscard]] double deepest_overlap(const scene::Description& scene, const Engine& engine);

} // namespace hapnet::bench
