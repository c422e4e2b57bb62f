// SPDX-FileCopyrightText: 2026 The Hapnet authors
// SPDX-License-Identifier: MIT
#pragma once

#include "emulator/core/path_name.hpp"
#include "emulator/core/profile/profile.hpp"
#include "emulator/core/profile/reading.hpp"
#include "proto/base/result.hpp"

#include <span>
#include <string>

namespace hapnet::emulator {

/// Reads the tables [[flow]] among other tables. Sets `flows` of the profile, and adds the
/// conditions of each flow to `paths`.
void read_flows(TableReader& table, Profile& profile);

/// Prints the properties of a flow, one key a line, without its conditions.
[[nodiscard]] std::string flow_lines(const Flow& flow);

/// Returns `names` with these flows on each path.
[[nodiscard]] PathNames with_flows(PathNames names, std::span<const Flow> flows);

/// Refuses settings for a flow that passes untouched, and settings of a rate or a queue for a flow
/// without a rate of its own.
[[nodiscard]] base::Result<void> validate_patch(const Patch& patch, std::string_view path,
                                                const PathNames& names);

/// Refuses flows whose filters use facts that a run of UDP datagrams does not have.
[[nodiscard]] base::Result<void> validate_for_datagrams(std::span<const Flow> flows);
/// Refuses flows whose filters use frames that pass undisturbed.
[[nodiscard]] base::Result<void> validate_for_frames(std::span<const Flow> flows, bool all_frames);

/// Refuses a profile whose flows differ from those of the run, which cannot change.
[[nodiscard]] base::Result<void> ensure_same_flows(const Profile& profile,
                                                   std::span<const Flow> flows);

} // namespace hapnet::emulator
