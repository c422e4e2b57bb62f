// SPDX-FileCopyrightText: 2026 The Hapnet authors
// SPDX-License-Identifier: MIT
#pragma once

#include "peer/core/sync/algorithm.hpp"
#include "proto/base/result.hpp"
#include "proto/base/space.hpp"
#include "proto/base/time.hpp"
#include "proto/record/reader.hpp"

#include <cstdint>
#include <nlohmann/json.hpp>
#include <optional>
#include <string>
#include <vector>

namespace hapnet::lab::records {

/// One tick, lived through again.
struct ReplayedTick {
    std::uint64_t tick = 0;
    base::TimePoint at; // as in the record
    base::Force recorded_contact;
    base::Force contact; // of the scene on the hand, before the governor
    base::Force recorded_device;
    base::Force device; // what the governor left of it
};

/// A recorded session, lived through again in virtual time.
struct Replayed {
    std::vector<ReplayedTick> ticks;
    std::size_t messages = 0;
    std::string algorithm;
    bool is_the_recorded_one = true;       // the algorithm
    double contact_difference_max_n = 0.0; // between recorded and replayed, over all ticks
    double device_difference_max_n = 0.0;  // likewise
    /// Likewise of the places and orientations of all bodies that the record has rows of; nullopt:
    /// it has none.
    std::optional<double> body_difference_max_m;
    std::optional<double> turn_difference_max_rad;
    /// Likewise in how many ticks a body has another owner; nullopt: the record does not say any.
    std::optional<std::uint64_t> other_owner_ticks;
    /// The first tick with more than the tolerances.
    std::optional<std::uint64_t> differs_from;
    bool is_complete = false; // its last tick is one of the session's end: nothing is cut off
};

/// Rounding that a printed and read-again description of a session may leave.
inline constexpr double tolerance_n = 1e-9;
inline constexpr double tolerance_m = 1e-9;
inline constexpr double tolerance_rad = 1e-9;

/// Plays one peer again on the cores that the daemon runs: the recorded messages arrive in the
/// ticks that took them, and the recorded hand moves as it did, whatever force it is given. With
/// another algorithm than the recorded one: what that would have made of the same messages; the
/// hand did not know of it. The error says what in the record stands in the way: ticks that are
/// missing or out of order, or a configuration that is incomplete. Rows have no checksum: that
/// these forces come out again is the check of all that forces follow from, and of the forces.
[[nodiscard]] base::Result<Replayed> replay(const record::Record& record,
                                            const std::optional<peer::Algorithm>& instead);

/// One object: ticks, messages, algorithm, differences, whether the forces are reproduced.
[[nodiscard]] nlohmann::json to_json(const Replayed& replayed);
/// The same in a few lines, for a person.
[[nodiscard]] std::string to_table(const Replayed& replayed);

[[nodiscard]] std::string replay_csv_header();
/// Time in seconds since `zero`.
[[nodiscard]] std::string csv_line(const ReplayedTick& tick, base::TimePoint zero);

} // namespace hapnet::lab::records
