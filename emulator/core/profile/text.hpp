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

/// The greatest number of changes in a timeline.
inline constexpr std::size_t changes_max = 10'000;
/// The greatest number of checks.
inline constexpr std::size_t checks_max = 100;

/// Reads a profile. `source` is the name of its file in errors, which begin with "FILE:LINE:COLUMN:
/// " and say what is wrong and what would be right. `open` opens the files that the profile names.
/// The profile may set conditions for the paths that `names` has.
[[nodiscard]] base::Result<Profile> parse_profile(std::string_view text, const std::string& source,
                                                  const OpenFile& open,
                                                  const PathNames& names = {.any = true});

/// Reads the conditions at the beginning from their tables among other tables: both, all, up, down,
/// matrix and those of single paths. Sets `path` and `paths` of the profile.
void read_conditions(TableReader& table, const PathNames& names, Profile& profile);

/// Reads the changes during the run from the [[at]] tables among other tables. Sets `timeline`.
/// Call it after read_conditions().
void read_timeline(TableReader& table, const PathNames& names, Profile& profile);

/// Returns the profile as TOML, in canonical form. Reading it gives an equal profile.
[[nodiscard]] std::string to_text(const Profile& profile);

} // namespace hapnet::emulator
