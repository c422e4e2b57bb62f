// SPDX-FileCopyrightText: 2026 The Hapnet authors
// SPDX-License-Identifier: MIT
#pragma once

#include "lab/experiment/experiment.hpp"
#include "lab/metrics/metrics.hpp"
#include "lab/virtual_time/setting.hpp"
#include "proto/base/result.hpp"

#include <cstdint>
#include <functional>
#include <optional>
#include <string>
#include <string_view>

namespace hapnet::lab::experiment {

/// A session to be played, and how many rows a second are kept besides its metrics.
struct SessionSpec {
    virtual_time::Setting setting{};
    std::uint32_t rows_per_s = 0;
    std::string algorithm{}; // name in the experiment, which does not affect the session
    /// The files that the experiment names. The setting holds their contents but not their names.
    std::vector<NamedContents> files{};
    /// If set, only the distance of the copies this time after silence is kept: see claims.hpp.
    std::optional<base::Duration> silence{};
};

/// The outcome of a session: a pure function of its spec.
struct PlayedSession {
    metrics::Metrics metrics{};
    std::string rows{}; // CSV without a header: see replay.hpp; empty when none were to be kept
    std::optional<double> apart_m{}; // distance of the copies, if the session ends in silence
};

/// Plays a session, or returns its known result.
using PlaySession = std::function<base::Result<PlayedSession>(const SessionSpec&)>;

/// The identity of one of an experiment's sessions.
struct SessionCase {
    const NamedAlgorithm& algorithm;
    const Hands& hands;
    device::Task task{};
    std::uint32_t seed = 1;
    Party party{};
    std::size_t trial = 0; // index of the trial of the people whose hands play
};

[[nodiscard]] SessionSpec make_session_spec(const Experiment& experiment, const SessionCase& one,
                                            const emulator::Path& path);

/// Returns the spec of the same session on a perfect network. Scores are relative to it. It keeps
/// no rows.
[[nodiscard]] SessionSpec perfect_twin(const SessionSpec& spec);
/// Returns the spec of the same hands in one scene, whatever the algorithm is. Stiffness is
/// relative to it. It keeps no rows.
[[nodiscard]] SessionSpec one_world_twin(const SessionSpec& spec);

/// Returns a profile on one line.
[[nodiscard]] std::string network_text(const emulator::Profile& profile);

/// Returns one line that identifies a session: the facts that a person looks for, and a hash of all
/// inputs of the session, including the contents of its files. `program` is the program that plays
/// it, since another one may play it differently.
[[nodiscard]] std::string key_of(const SessionSpec& spec, std::string_view program);

} // namespace hapnet::lab::experiment
