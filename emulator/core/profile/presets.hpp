// SPDX-FileCopyrightText: 2026 The Hapnet authors
// SPDX-License-Identifier: MIT
#pragma once

#include <span>
#include <string_view>

namespace hapnet::emulator {

/// A built-in profile: a file of scripts/profiles.
struct Preset {
    std::string_view name; // file name without .toml
    std::string_view text;
};

/// All presets, by name.
[[nodiscard]] std::span<const Preset> presets();

} // namespace hapnet::emulator
