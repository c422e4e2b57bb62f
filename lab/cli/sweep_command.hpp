// SPDX-FileCopyrightText: 2026 The Hapnet authors
// SPDX-License-Identifier: MIT
#pragma once

#include "lab/cli/options.hpp"
#include "proto/base/result.hpp"

#include <string>

namespace hapnet::lab {

// The experiment of a plan, session by session in real time. The lab decides which session is
// played next and compares the played sessions; scripts/real-time.sh starts the programs. A session
// has a folder cells/NAME/attempt-N. Each function throws std::system_error when something cannot
// be written.

/// True if sessions of a plan were played in the folder.
[[nodiscard]] bool is_sweep(const std::string& folder);

/// Writes the files of the next session. Returns a line with its folder, peers, task, seconds and
/// seed, and a description for people. Returns an empty text when every session is valid or has
/// been attempted as often as allowed. Removes the files of an attempt that was broken off.
[[nodiscard]] base::Result<std::string> next_session(const RealTimeCommand& command);

/// Plays in virtual time a session that was played into a folder, and writes result.json there.
/// Returns a line for people.
[[nodiscard]] base::Result<std::string> compare_session(const RealTimeCommand& command);

/// Writes the tables and the manifest from the sessions played so far. Returns a table for people.
[[nodiscard]] base::Result<std::string> conclude_sweep(const RealTimeCommand& command);

} // namespace hapnet::lab
