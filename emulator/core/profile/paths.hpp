// SPDX-FileCopyrightText: 2026 The Hapnet authors
// SPDX-License-Identifier: MIT
#pragma once

#include "emulator/core/profile/profile.hpp"
#include "emulator/core/profile/timeline.hpp"

#include <span>
#include <string>
#include <string_view>
#include <vector>

namespace hapnet::emulator {

// Functions on a profile of several paths and its meaning for each of them.

/// Returns the paths that have settings of their own in the profile, ascending by their names.
[[nodiscard]] std::vector<std::string> paths_in(const Profile& profile);

/// Returns the profile of this path alone. Its timeline has all the changes, including those that
/// have no effect on this path. A flow takes only the MTU from the conditions of all paths, and
/// nothing if it passes untouched.
[[nodiscard]] Profile profile_of(const Profile& profile, std::string_view path);

/// Applies Timeline::validate() to every path.
[[nodiscard]] tl::expected<void, Timeline::BadChange> validate_timelines(const Profile& profile);

/// The profile of one of several paths.
struct NamedProfile {
    std::string path;
    Profile profile;
};
/// Joins profiles into one that has the same effect on each path as its own profile. Settings that
/// most paths have at the beginning, and equal changes on all paths, are written once for all.
/// `flows`: the flows that the paths have.
[[nodiscard]] Profile joined(std::span<const NamedProfile> profiles,
                             std::span<const Flow> flows = {});

/// One patch for several paths: the settings that are equal for all, and the other settings of each
/// path.
struct JoinedPatch {
    Patch up;
    Patch down;
    std::vector<PathPatch> paths; // ascending by their names
};
[[nodiscard]] JoinedPatch joined(std::vector<PathPatch> patches);

/// Returns the settings that lead from `before` to `after`.
[[nodiscard]] Patch difference(const Conditions& before, const Conditions& after);

/// Returns the patch of this path in `patches`, and adds it if there is none. The patches stay
/// ordered.
[[nodiscard]] PathPatch& patch_for(std::vector<PathPatch>& patches, std::string_view path);

} // namespace hapnet::emulator
