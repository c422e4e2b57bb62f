// SPDX-FileCopyrightText: 2026 The Hapnet authors
// SPDX-License-Identifier: MIT
#pragma once

#include "lab/experiment/jobs.hpp"
#include "proto/base/result.hpp"

#include <string>
#include <vector>

namespace hapnet::lab::experiment {

// Experiments that the daemons play in real time: the emulator and the peers over UDP.

/// Returns the sessions of an experiment, as jobs. The error names the part of it that only virtual
/// time can play, and what to change.
[[nodiscard]] base::Result<std::vector<SessionJob>> daemon_sessions(const Experiment& experiment);

/// A file that describes a session to the programs.
struct ProgramFile {
    /// algorithm.toml, left.toml, right.toml, scene.toml, profile.toml, or peer.words: more options
    /// of the peers.
    std::string name;
    std::string text;
};
[[nodiscard]] std::vector<ProgramFile> program_files(const virtual_time::Setting& setting);

} // namespace hapnet::lab::experiment
