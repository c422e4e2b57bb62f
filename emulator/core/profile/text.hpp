// SPDX-FileCopyrightText: 2026 The Hapnet authors
// SPDX-License-Identifier: MIT
#pragma once

#include "emulator/core/profile/profile.hpp"
#include "emulator/core/profile/reading.hpp"
#include "emulator/core/profile/settings.hpp"
#include "proto/base/result.hpp"

#include <optional>
#include <span>
#include <string>
#include <string_view>

namespace hapnet::emulator {

/// The most changes that a timeline may have.
inline constexpr std::size_t changes_max = 10'000;

/// Reads a profile. `source` is the name of its file in errors, which begin with
/// "FILE:LINE:COLUMN: " and say what is wrong and what would be right. Files that the profile
/// names are asked from `open`.
[[nodiscard]] base::Result<Profile> parse_profile(std::string_view text, const std::string& source,
                                                  const OpenFile& open);

/// The profile as TOML, in canonical form: it reads back as the same profile.
[[nodiscard]] std::string to_text(const Profile& profile);

/// One setting, as an option or a live command makes it: `up.delay` and `300ms`.
struct Setting {
    std::optional<Direction> direction; // nullopt: both ways
    DirectionSettings settings;
};

/// Reads a setting. `key` is NAME, both.NAME, up.NAME or down.NAME with a NAME of setting_keys
/// ("burst-loss" is as good as "burst_loss"). `value` is what stands in a profile, without the
/// quotes: 5ms, 40/100, { law = "normal", sd = "3ms" }, ["5%", "40/100"]. Errors begin with `key`.
[[nodiscard]] base::Result<Setting> parse_setting(std::string_view key, std::string_view value,
                                                  const OpenFile& open);

/// `path` with the settings: those of both ways first, then those of one way, each in their order.
/// burst_loss comes last and replaces the bursts without a phase in the list of losses, or is
/// added to it. The error: more laws than a direction may have.
[[nodiscard]] base::Result<Path> with_settings(Path path, std::span<const Setting> settings);

} // namespace hapnet::emulator
