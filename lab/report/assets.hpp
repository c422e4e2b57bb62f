// SPDX-FileCopyrightText: 2026 The Hapnet authors
// SPDX-License-Identifier: MIT
#pragma once

#include "proto/page/page.hpp"

#include <array>
#include <span>
#include <string_view>

namespace hapnet::lab::report {

using page::Asset;

/// Returns the modules that lay out a page of results and the modules of the player. They include
/// the library that draws the player's worlds if the build had it. A generated file contains them.
[[nodiscard]] std::span<const Asset> lab_assets();

/// The names of the modules that lay out a page. A page without a player has them, too.
inline constexpr std::array<std::string_view, 6> layout_modules{
    "report/sections.js", "report/claims.js", "report/runs.js",
    "report/sessions.js", "report/words.js",  "words.js"};

} // namespace hapnet::lab::report
