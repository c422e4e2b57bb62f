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

/// The settings that one of several paths has of its own, over those of all paths.
struct PathPatch {
    std::string path; // name of the path; see path_name.hpp
    Patch up;
    Patch down;

    friend bool operator==(const PathPatch&, const PathPatch&) = default;
};

/// A point of the timeline: from `time` since the run began these settings hold. With a ramp they
/// are approached in a straight line from what held before and reached at time + ramp; only
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
    std::optional<base::Seed> seed;        // nullopt: the file does not say
    Path path;                             // conditions at the beginning
    std::vector<Change> timeline;          // ascending in time
    std::vector<PathPatch> paths{};        // ascending by their names
    std::vector<base::Condition> checks{}; // what the statistics of a run must meet in the end
    std::vector<Flow> flows{};             // a packet belongs to the first that matches

    friend bool operator==(const Profile&, const Profile&) = default;
};

/// A profile translated from another notation, and a sentence on each part that it cannot express.
struct TranslatedProfile {
    Profile profile;
    std::vector<std::string> warnings;
};

} // namespace hapnet::emulator
