// SPDX-FileCopyrightText: 2026 The Hapnet authors
// SPDX-License-Identifier: MIT
#pragma once

#include <string_view>

namespace hapnet::lab::report {

// The scripts of a page: files of page/, compiled in.

/// What draws figures from their data, zooming of plots, and the player of replays.
[[nodiscard]] std::string_view figures_script();
[[nodiscard]] std::string_view zoom_script();
[[nodiscard]] std::string_view player_script();

} // namespace hapnet::lab::report
