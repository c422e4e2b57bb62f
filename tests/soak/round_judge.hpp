// SPDX-FileCopyrightText: 2026 The Hapnet authors
// SPDX-License-Identifier: MIT
#pragma once

#include "proto/base/result.hpp"
#include "proto/base/space.hpp"
#include "proto/base/time.hpp"
#include "proto/record/reader.hpp"

#include <cstddef>
#include <cstdint>
#include <glm/gtc/quaternion.hpp>
#include <map>
#include <optional>
#include <string>
#include <vector>

namespace hapnet::soak {

/// The verdict on the record of one peer among others that are killed and come back.
struct Verdict {
    std::int64_t peer = 0;
    double hands_on_s = 0.0;
    std::size_t silences = 0;      // of another peer, for 0.35 s or more with hands on
    std::size_t died_touching = 0; // of these, the hand was on the body in the last state
    double counted_max_ms = 0.0;   // after the last state of a silent one, its force still counted
    double felt_max_ms = 0.0;      // as above, for force felt by this hand while that one touched
    std::size_t played_on = 0;     // of the silences longer than a second, in how many it played on
    std::size_t lasted = 0;        // silences longer than a second
    double force_max_n = 0.0;      // force given to the device
    bool was_at_fault = false;     // the governor held it at zero: a machine that stood still
    std::vector<std::string> breaches;
};

/// Judges a record by its own rows and its states, without the daemon's code. From 300 ms after the
/// last state of another peer, this peer must not count that peer's force. If that peer's hand
/// touched, this hand must feel nothing until the peer is heard again or was silent for a second.
/// Then, with three peers or more, this peer must continue. Forces must be finite and within the
/// limit. For the algorithm `base`.
[[nodiscard]] base::Result<Verdict> judge(const record::Record& record);

/// The place of a body after hands off in one peer's copy, by the peer's last recorded state.
struct Pose {
    base::Position position;
    std::optional<glm::dquat> orientation; // of a body that can turn
};
/// By the number of the body and the id of the peer that has it there.
using Poses = std::map<std::uint16_t, std::map<std::uint16_t, Pose>>;

/// Adds the poses in this record.
void add_poses(Poses& poses, const record::Record& record);

/// The largest differences of copies, over all bodies and any two peers.
struct Apart {
    std::size_t copies = 0; // compared, of the body with the fewest
    double distance_mm = 0.0;
    double angle_deg = 0.0;
};
[[nodiscard]] Apart apart(const Poses& poses);

} // namespace hapnet::soak
