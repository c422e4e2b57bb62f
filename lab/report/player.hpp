// SPDX-FileCopyrightText: 2026 The Hapnet authors
// SPDX-License-Identifier: MIT
#pragma once

#include "proto/page/page.hpp"

#include <span>

namespace hapnet::lab::report {

using page::Asset;

/// The modules of the player, and the library that draws its worlds where the build had it. A
/// generated file has them.
[[nodiscard]] std::span<const Asset> player_assets();

} // namespace hapnet::lab::report
