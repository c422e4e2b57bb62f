// SPDX-FileCopyrightText: 2026 The Hapnet authors
// SPDX-License-Identifier: MIT
#pragma once

#include "lab/metrics/spread.hpp"
#include "lab/results/manifest.hpp"
#include "lab/results/session_files.hpp"
#include "lab/virtual_time/setting.hpp"
#include "lab/virtual_time/trace.hpp"
#include "proto/base/reading.hpp"
#include "proto/base/result.hpp"

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
    /// When in a millisecond the peers tick, in the order of their ids, as their records say;
    /// empty: all at once.
    std::vector<base::Duration> phases{};
};

/// The session in virtual time that has the same task, hands, algorithm, scene, seeds, length,
/// conditions and phases. Scenes that are files are asked from `open`. Fails when the files do not
/// say, or when it was no simulated hand.
[[nodiscard]] base::Result<virtual_time::Setting> twin_of(const RealTimeSession& session,
                                                          const base::OpenFile& open);

/// |x_L - x_R| of one session in real and in virtual time, in mm.
struct RealTimeResult {
    std::string algorithm;
    std::string where;
    std::optional<metrics::Spread> real_mm;
    std::optional<metrics::Spread> virtual_mm;
    /// Why the session in real time does not count, for people; empty: it does.
    std::vector<std::string> invalid_because;

    [[nodiscard]] bool valid() const { return invalid_because.empty(); }
    /// How far real time is from virtual time in mean or std, whichever is farther; negative: below
    /// it. nullopt when the session does not count or there is nothing to compare.
    [[nodiscard]] std::optional<double> difference_percent() const;
};

/// `twin` is what twin_of() gives, played.
[[nodiscard]] RealTimeResult result_of(const RealTimeSession& session,
                                       const virtual_time::Trace& twin);

/// real_time.csv.
[[nodiscard]] std::string real_time_csv(std::span<const RealTimeResult> results);
/// The same as lines of text for a person, who also learns which results agree within 5 %.
[[nodiscard]] std::string real_time_table(std::span<const RealTimeResult> results);

/// What manifest.json says of them under "real_time".
[[nodiscard]] nlohmann::ordered_json real_time_manifest(std::span<const RealTimeResult> results,
                                                        const Circumstances& circumstances);

} // namespace hapnet::lab::results
