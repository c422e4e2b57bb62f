// SPDX-FileCopyrightText: 2026 The Hapnet authors
// SPDX-License-Identifier: MIT
#pragma once

#include "scene/description.hpp"

#include <string>

namespace hapnet::test {

/// A scene of tests/bench/scenes: one that no session plays.
[[nodiscard]] scene::Description bench_scene(const std::string& name);

} // namespace hapnet::test
