// SPDX-FileCopyrightText: 2026 The Hapnet authors
// SPDX-License-Identifier: MIT
#pragma once

#include "emulator/core/conditions.hpp"
#include "emulator/core/flow/flow.hpp"
#include "proto/base/condition.hpp"
#include "proto/base/random.hpp"
#include "proto/base/time.hpp"

#include <optional>
#include <string>
#include <vector>

namespace hapnet::emulator {

/// The settings of one of several paths, which override those of all paths.
struct PathPatch {
    std::string path; // name of the path; see path_name.hpp
    Patch up;
    Patch down;

    friend bool operator==(const PathPatch&, const PathPatch&) = default;
};

/// A point of the timeline: these settings are in effect from `time` since the run began. With a
/// ramp, the values change linearly from the previous ones and are reached at time + ramp. Only
/// numbers of the same law can be ramped.
struct Change {
    base::Duration time{};
    base::Duration ramp{};
    Patch up;
    Patch down;
    std::vector<PathPatch> paths{}; // ascending by their names

    friend bool operator==(const Change&, const Change&) = default;
};

/// The contents of a profile file.
struct Profile {
    std::string name;
    std::optional<base::Seed> seed; // nullopt: the file does not say
    Path path;                      // conditions at the beginning
    std::vector<Change> timeline;   // ascending in time
    std::vector<PathPatch> paths{}; // ascending by their names
    // Conditions that the statistics of a run must meet at its end
    std::vector<base::Condition> checks{};
    std::vector<Flow> flows{}; // a packet belongs to the first that matches

    friend bool operator==(const Profile&, const Profile&) = default;
};

/// A profile translated from another notation, with a sentence about each part that it cannot
/// express.
struct TranslatedProfile {
    Profile profile;
    std::vector<std::string> warnings;
};

} // namespace hapnet::emulator
