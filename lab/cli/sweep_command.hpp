// SPDX-FileCopyrightText: 2026 The Hapnet authors
// SPDX-License-Identifier: MIT
#pragma once

#include "lab/cli/options.hpp"
#include "proto/base/result.hpp"

#include <string>

namespace hapnet::lab {

// The experiment of a plan, session by session in real time: the lab says what is to be played and
// compares what was played; scripts/real-time.sh starts the programs. A session has a folder
// cells/NAME/attempt-N. Each throws std::system_error when something cannot be written.

/// True if sessions of a plan were played in the folder.
[[nodiscard]] bool is_sweep(const std::string& folder);

/// Writes the files of the next session, and returns a line with its folder, peers, task, seconds,
/// seed, and words for people; empty: every session is valid or was played as often as it may be.
/// Files of an attempt that was broken off are removed.
[[nodiscard]] base::Result<std::string> next_session(const RealTimeCommand& command);

/// Plays a session that was played into a folder in virtual time, and writes result.json there.
/// Returns a line for people.
[[nodiscard]] base::Result<std::string> compare_session(const RealTimeCommand& command);

/// Writes the tables and the manifest from the sessions that were played so far. Returns a table
/// for people.
[[nodiscard]] base::Result<std::string> conclude_sweep(const RealTimeCommand& command);

} // namespace hapnet::lab
