// SPDX-FileCopyrightText: 2026 The Hapnet authors
// SPDX-License-Identifier: MIT
#pragma once

#include "scene/description.hpp"

#include <nlohmann/json.hpp>

namespace hapnet::peer {

/// Describes a scene to programs that draw a session: docs/formats/live.md. A scene of more than
/// `bodies_shown_max` bodies is cut there, and says so.
[[nodiscard]] nlohmann::ordered_json scene_json(const scene::Description& scene);
inline constexpr std::size_t bodies_shown_max = 1000;

} // namespace hapnet::peer
