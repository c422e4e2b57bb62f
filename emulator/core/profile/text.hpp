// SPDX-FileCopyrightText: 2026 The Hapnet authors
// SPDX-License-Identifier: MIT
#pragma once

#include "emulator/core/profile/profile.hpp"
#include "emulator/core/profile/reading.hpp"
#include "emulator/core/profile/settings.hpp"
#include "proto/base/result.hpp"

#include <string>
#include <string_view>

namespace hapnet::emulator {

/// The most changes that a timeline may have.
inline constexpr std::size_t changes_max = 10'000;
/// The most checks.
inline constexpr std::size_t checks_max = 100;

/// Reads a profile. `source` is the name of its file in errors, which begin with
/// "FILE:LINE:COLUMN: " and say what is wrong and what would be right. Files that the profile
/// names are asked from `open`. It may speak of the paths that `names` has.
[[nodiscard]] base::Result<Profile> parse_profile(std::string_view text, const std::string& source,
                                                  const OpenFile& open,
                                                  const PathNames& names = {.any = true});

/// Reads the conditions at the beginning from their tables, which stand among others: both, all,
/// up, down, matrix and those of single paths. Sets `path` and `paths` of the profile.
void read_conditions(TableReader& table, const PathNames& names, Profile& profile);

/// Reads the changes during the run from the [[at]] tables, which stand among others. Sets
/// `timeline`, after read_conditions().
void read_timeline(TableReader& table, const PathNames& names, Profile& profile);

/// The profile as TOML, in canonical form: it reads back as the same profile.
[[nodiscard]] std::string to_text(const Profile& profile);

} // namespace hapnet::emulator
