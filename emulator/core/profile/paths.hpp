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

// A profile of several paths, and what it is to each of them.

/// The paths that have something of their own in it, ascending by their names.
[[nodiscard]] std::vector<std::string> paths_in(const Profile& profile);

/// Returns the profile of this path alone. Its timeline has the same changes, also those that
/// change nothing here. A flow takes only the MTU from the conditions of all paths, and nothing if
/// it passes untouched.
[[nodiscard]] Profile profile_of(const Profile& profile, std::string_view path);

/// Timeline::validate() of every path.
[[nodiscard]] tl::expected<void, Timeline::BadChange> validate_timelines(const Profile& profile);

/// The profile of one of several paths.
struct NamedProfile {
    std::string path;
    Profile profile;
};
/// Joins profiles into one that has the same effect on each path as its own. Settings that most
/// paths have at the beginning, and equal changes on all of them, are written once for all.
/// `flows`: those that the paths have.
[[nodiscard]] Profile joined(std::span<const NamedProfile> profiles,
                             std::span<const Flow> flows = {});

/// One patch for several paths: the settings that are equal for all, and the rest of each.
struct JoinedPatch {
    Patch up;
    Patch down;
    std::vector<PathPatch> paths; // ascending by their names
};
[[nodiscard]] JoinedPatch joined(std::vector<PathPatch> patches);

/// Returns the settings that lead from one to the other.
[[nodiscard]] Patch difference(const Conditions& before, const Conditions& after);

/// The patch of this path in `patches`, made if there is none; they stay in their order.
[[nodiscard]] PathPatch& patch_for(std::vector<PathPatch>& patches, std::string_view path);

} // namespace hapnet::emulator
