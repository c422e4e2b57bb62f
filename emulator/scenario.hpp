// SPDX-FileCopyrightText: 2026 The Hapnet authors
// SPDX-License-Identifier: MIT
#pragma once

#include "emulator/core/fates/fates.hpp"
#include "emulator/core/path_name.hpp"
#include "emulator/core/profile/profile.hpp"
#include "emulator/options.hpp"
#include "proto/base/random.hpp"
#include "proto/base/result.hpp"

#include <memory>
#include <string>
#include <vector>

namespace hapnet::emulator {

/// The conditions of a run: the options, with the contents of the files that they name.
struct Scenario {
    Profile profile; // with the seed and the settings of the command line
    base::Seed seed{1};
    std::shared_ptr<const FatesOfPaths> replay; // null: fates are drawn
    std::vector<std::string> warnings;          // one sentence each, for people
    std::vector<base::Condition> checks;        // from the profile and the command line
};

/// Returns the profile that results from --profile, --netem and single settings. File names in it
/// are absolute. Adds a warning for each difference from netem's behaviour. The profile may set
/// conditions for the paths that `names` has.
[[nodiscard]] base::Result<Profile> profile_for(const ConditionOptions& options,
                                                std::vector<std::string>& warnings,
                                                const PathNames& names = {.any = true});

/// Returns the profile of one path, with the conditions of all paths; that of the path without a
/// name when `path` is empty. Warns on stderr when the profile has more paths, or no settings for
/// this path.
[[nodiscard]] base::Result<Profile> profile_for_path(const ConditionOptions& options,
                                                     const std::string& path,
                                                     std::vector<std::string>& warnings);

/// Translates a sentence of tc-netem into a profile with the same conditions in both directions.
[[nodiscard]] base::Result<TranslatedProfile> netem_profile(const std::string& sentence);

/// Returns the seed of the random draws: that of the command line, else that of the profile, else
/// 1.
[[nodiscard]] base::Seed seed_of(const ConditionOptions& options, const Profile& profile);

/// Opens the files that the options name. The error is one of bad input: it names the option, or
/// the file and line. `names`: the paths of the run.
[[nodiscard]] base::Result<Scenario> scenario_of(const Options& options,
                                                 const PathNames& names = {});

} // namespace hapnet::emulator
