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

/// A session to be played, and how many rows a second are kept of it besides its metrics.
struct SessionSpec {
    virtual_time::Setting setting{};
    std::uint32_t rows_per_s = 0;
    std::string algorithm{}; // what the experiment calls it; nothing follows from that
    /// The files that the experiment names. The setting has their contents, its texts only names.
    std::vector<NamedContents> files{};
    /// Nothing is kept but how far copies are apart so long after all is silent: see claims.hpp.
    std::optional<base::Duration> silence{};
};

/// What came of a session: a pure function of its spec.
struct PlayedSession {
    metrics::Metrics metrics{};
    std::string rows{}; // CSV without a header: see replay.hpp; empty when none were to be kept
    std::optional<double> apart_m{}; // of a session that ends in silence
};

/// Plays a session, or gives what is known of it already.
using PlaySession = std::function<base::Result<PlayedSession>(const SessionSpec&)>;

/// Which of an experiment's sessions.
struct SessionCase {
    const NamedAlgorithm& algorithm;
    const Hands& hands;
    device::Task task{};
    std::uint32_t seed = 1;
    Party party{};
    std::size_t trial = 0; // of the people whose hands these are
};

[[nodiscard]] SessionSpec make_session_spec(const Experiment& experiment, const SessionCase& one,
                                            const emulator::Path& path);

/// The same session on a perfect network: what scores are relative to. Keeps no rows.
[[nodiscard]] SessionSpec perfect_twin(const SessionSpec& spec);
/// The same hands in one scene, whatever the algorithm: what stiffness is relative to. Keeps no
/// rows.
[[nodiscard]] SessionSpec one_world_twin(const SessionSpec& spec);

/// A profile on one line.
[[nodiscard]] std::string network_text(const emulator::Profile& profile);

/// One line that tells sessions apart: what a person looks for, and a hash of all that the session
/// follows from, the contents of the files that it names included. `program` is who plays it:
/// another program may play it differently.
[[nodiscard]] std::string key_of(const SessionSpec& spec, std::string_view program);

} // namespace hapnet::lab::experiment
