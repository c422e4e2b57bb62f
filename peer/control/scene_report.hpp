// SPDX-FileCopyrightText: 2026 The Hapnet authors
// SPDX-License-Identifier: MIT
#pragma once

#include "scene/description.hpp"

#include <nlohmann/json.hpp>

namespace hapnet::peer {

/// Returns a description of a scene for programs that draw a session, see docs/formats/live.md. If
/// the scene has more than `bodies_shown_max` bodies, the rest is left out, and the result says so.
[[nodiscard]] nlohmann::ordered_json scene_json(const scene::Description& scene);
inline constexpr std::size_t bodies_shown_max = 1000;

} // namespace hapnet::peer
