// SPDX-FileCopyrightText: 2026 The Hapnet authors
// SPDX-License-Identifier: MIT
#pragma once

#include "lab/experiment/jobs.hpp"
#include "proto/base/result.hpp"

#include <string>
#include <vector>

namespace hapnet::lab::experiment {

// Experiments that the daemons play: the emulator and peers over UDP, in real time.

/// The sessions of an experiment, as jobs. The error says what in it only virtual time can play,
/// and what to change.
[[nodiscard]] base::Result<std::vector<SessionJob>> daemon_sessions(const Experiment& experiment);

/// A file from which the programs read what a session is.
struct ProgramFile {
    std::string name; // algorithm.toml, left.toml, right.toml, scene.toml, profile.toml
    std::string text;
};
[[nodiscard]] std::vector<ProgramFile> program_files(const virtual_time::Setting& setting);

} // namespace hapnet::lab::experiment
