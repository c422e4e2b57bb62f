// SPDX-FileCopyrightText: 2026 The Hapnet authors
// SPDX-License-Identifier: MIT
#pragma once

#include <span>
#include <string_view>

namespace hapnet::lab {

/// A profile that is built into every emulator of this version.
struct Preset {
    std::string_view name;
    std::string_view text;
};

/// All presets of the lab, by name.
[[nodiscard]] std::span<const Preset> presets_of_lab();

} // namespace hapnet::lab
