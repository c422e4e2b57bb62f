// SPDX-FileCopyrightText: 2026 The Hapnet authors
// SPDX-License-Identifier: MIT
#pragma once

#include "proto/page/page.hpp"

#include <array>
#include <span>
#include <string_view>

namespace hapnet::lab::report {

using page::Asset;

/// The modules that lay out a page of results, and those of the player with the library that draws
/// its worlds where the build had it. A generated file has them.
[[nodiscard]] std::span<const Asset> lab_assets();

/// The names of the modules that lay out a page, which it carries without a player, too.
inline constexpr std::array<std::string_view, 6> layout_modules{
    "report/sections.js", "report/claims.js", "report/runs.js",
    "report/sessions.js", "report/words.js",  "words.js"};

} // namespace hapnet::lab::report
