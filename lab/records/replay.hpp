// SPDX-FileCopyrightText: 2026 The Hapnet authors
// SPDX-License-Identifier: MIT
#pragma once

#include "lab/records/agreement.hpp"
#include "peer/core/sync/algorithm.hpp"
#include "proto/base/describe.hpp"
#include "proto/base/result.hpp"
#include "proto/base/space.hpp"
#include "proto/base/time.hpp"
#include "proto/record/reader.hpp"

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

namespace hapnet::lab::records {

/// One tick of the replay.
struct ReplayedTick {
    std::uint64_t tick = 0;
    base::TimePoint at; // time of the tick in the record
    base::Force recorded_contact;
    base::Force contact; // force of the scene on the hand, before the governor
    base::Force recorded_device;
    base::Force device; // force from the governor to the device
};

/// The result of replaying a recorded session in virtual time.
struct Replayed {
    std::vector<ReplayedTick> ticks;
    std::size_t messages = 0;
    std::string algorithm;
    bool is_the_recorded_one = true; // true if `algorithm` is that of the record
    /// The largest differences between recorded and replayed forces, over all ticks and axes.
    double contact_difference_max_n = 0.0;
    double device_difference_max_n = 0.0;
    /// The largest difference of the positions and orientations of all bodies of which the record
    /// has rows; nullopt: it has none.
    std::optional<double> body_difference_max_m;
    std::optional<double> turn_difference_max_rad;
    /// The number of ticks in which a body has another owner than recorded; nullopt: the record
    /// names no owners.
    std::optional<std::uint64_t> other_owner_ticks;
    /// The first tick whose differences exceed the tolerances.
    std::optional<std::uint64_t> differs_from;
    bool is_complete = false; // true if the last tick has phase `ended`: nothing is cut off
};

/// The rounding that may remain after the description of a session is printed and read again.
inline constexpr double tolerance_n = 1e-9;
inline constexpr double tolerance_m = 1e-9;
inline constexpr double tolerance_rad = 1e-9;

constexpr auto fields_of(base::Tag<Replayed>)
{
    using R = Replayed;
    return base::fields(
        "replay",
        base::computed<R>(
            "ticks", [](const R& one) { return one.ticks.size(); }, "Ticks that were played."),
        base::member("messages", &R::messages, "Messages that they took."),
        base::member("algorithm", &R::algorithm, "The algorithm that played."),
        base::member("algorithm_is_the_recorded_one", &R::is_the_recorded_one,
                     "Whether it is that of the record."),
        base::member("contact_difference_max_n", &R::contact_difference_max_n,
                     "The largest difference from the recorded forces of the scene."),
        base::member("device_difference_max_n", &R::device_difference_max_n,
                     "That from the forces that the device was told."),
        base::computed<R>(
            "tolerance_n", [](const R&) { return tolerance_n; },
            "The difference that counts as none."),
        base::computed<R>(
            "body_difference_max_mm",
            [](const R& one) { return scaled(one.body_difference_max_m, mm_per_m); },
            "From the recorded places of bodies; null: the record has no rows of bodies."),
        base::computed<R>(
            "turn_difference_max_deg",
            [](const R& one) { return scaled(one.turn_difference_max_rad, deg_per_rad); },
            "From their orientations, likewise."),
        base::member("other_owner_ticks", &R::other_owner_ticks,
                     "Ticks in which a body has another owner than recorded; null: the record does "
                     "not say any."),
        base::member("differs_from_tick", &R::differs_from,
                     "The first tick that differs by more than 1e-9 N, m or rad; null: none does."),
        base::member("complete", &R::is_complete,
                     "Whether the record does not stop before its session's end."),
        base::computed<R>(
            "reproduced", [](const R& one) { return !one.differs_from; },
            "Whether no tick differs."));
}

/// Replays one peer on the cores that the daemon runs. The recorded messages arrive in the ticks
/// that took them, and the recorded hand moves as it did, whatever force it is given. Another
/// algorithm than the recorded one shows the forces that it would have computed from the same
/// messages, but the hand moves as it did with the recorded one. Fails when ticks of the record are
/// missing or out of order, or when its configuration is incomplete; the error says which. Rows
/// have no checksum. If the same forces come out again, both the recorded forces and their inputs
/// are intact.
[[nodiscard]] base::Result<Replayed> replay(const record::Record& record,
                                            const std::optional<peer::Algorithm>& instead);

/// Returns the replay in a few lines, for a person.
[[nodiscard]] std::string to_table(const Replayed& replayed);

[[nodiscard]] std::string replay_csv_header();
/// Returns a tick as a line of CSV, with the time in seconds since `zero`.
[[nodiscard]] std::string csv_line(const ReplayedTick& tick, base::TimePoint zero);

} // namespace hapnet::lab::records
