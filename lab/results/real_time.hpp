// SPDX-FileCopyrightText: 2026 The Hapnet authors
// SPDX-License-Identifier: MIT
#pragma once

#include "lab/metrics/spread.hpp"
#include "lab/results/manifest.hpp"
#include "lab/results/session_files.hpp"
#include "lab/results/table.hpp"
#include "lab/virtual_time/setting.hpp"
#include "lab/virtual_time/trace.hpp"
#include "proto/base/reading.hpp"
#include "proto/base/result.hpp"

#include <cstdint>
#include <nlohmann/json.hpp>
#include <optional>
#include <span>
#include <string>
#include <vector>

namespace hapnet::lab::results {

// Sessions that the programs played in real time, beside the same sessions in virtual time.

/// A session in real time.
struct RealTimeSession {
    std::string where; // "loopback" or "namespaces"
    SessionFiles files{};
    /// The times of the peers' ticks, in the order of their ids, counted from the start, as their
    /// records state them. Empty: the peers tick evenly and all at once.
    std::vector<std::vector<base::Duration>> ticks{};
};

/// The punctuality of a loop, from the times of its ticks.
struct KeptTime {
    std::uint64_t missed = 0;     // number of missed ticks
    base::Duration longest_gap{}; // longest time between two ticks
};
[[nodiscard]] KeptTime kept_time(std::span<const base::Duration> ticks);

/// Returns the reasons, for people, why the session is not the intended one: a loop stood still so
/// long that its governor took the force from the hand, and the force then came back slowly.
[[nodiscard]] std::vector<std::string> stalls_of(const RealTimeSession& session);

/// Returns the session in virtual time that has the same task, hands, algorithms, scene, seeds,
/// length, conditions and ticks. `open` returns the texts of scenes that are files. Fails when the
/// files do not hold these data, or when the hand was not simulated.
[[nodiscard]] base::Result<virtual_time::Setting> twin_of(const RealTimeSession& session,
                                                          const base::OpenFile& open);

/// |x_L - x_R| of one session in real and in virtual time, in mm.
struct RealTimeResult {
    std::string algorithm;
    std::string where;
    std::optional<metrics::Spread> real_mm;
    std::optional<metrics::Spread> virtual_mm;
    /// The reasons why the session in real time does not count, for people; empty: it does.
    std::vector<std::string> invalid_because;

    [[nodiscard]] bool valid() const { return invalid_because.empty(); }
    /// Returns the difference of real time from virtual time in mean or std, whichever differs
    /// more. Negative: real time is below. nullopt when the session does not count or there is
    /// nothing to compare.
    [[nodiscard]] std::optional<double> difference_percent() const;
};

/// Compares a session with its twin. `twin` is the trace of playing the setting of twin_of().
[[nodiscard]] RealTimeResult result_of(const RealTimeSession& session,
                                       const virtual_time::Trace& twin);

/// Returns the table real_time.
[[nodiscard]] Table real_time_rows(std::span<const RealTimeResult> results);
/// Returns the results as lines of text for a person, with the results that agree within 5 %.
[[nodiscard]] std::string real_time_table(std::span<const RealTimeResult> results);

/// Returns the entry of manifest.json under "real_time".
[[nodiscard]] nlohmann::ordered_json real_time_manifest(std::span<const RealTimeResult> results,
                                                        const Circumstances& circumstances);

} // namespace hapnet::lab::results
