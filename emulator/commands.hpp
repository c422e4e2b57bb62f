// SPDX-FileCopyrightText: 2026 The Hapnet authors
// SPDX-License-Identifier: MIT
#pragma once

#include "emulator/options.hpp"
#include "proto/base/result.hpp"

namespace hapnet::emulator {

// The commands of the program. Each returns its exit code; the error is one of bad input.

/// Relays for one pair until it is told to stop.
[[nodiscard]] base::Result<int> run(const Options& options);
/// Relays for many pairs.
[[nodiscard]] base::Result<int> run(const LinkOptions& options);
/// Relays for any client of a server.
[[nodiscard]] base::Result<int> run(const UpstreamOptions& options);
/// Runs two commands with the emulator between them; gives the exit code of the first.
[[nodiscard]] base::Result<int> run(const BetweenOptions& options);
/// Runs a command with the emulator between it and the network; gives its exit code.
[[nodiscard]] base::Result<int> run(const ExecOptions& options);
/// Joins two interfaces until it is told to stop, or finds a loop.
[[nodiscard]] base::Result<int> run(const BridgeOptions& options);
/// Prints the profile in canonical form, each stage in words, and warnings.
[[nodiscard]] base::Result<int> run(const CheckOptions& options);
/// Prints what the profile will do to a stream.
[[nodiscard]] base::Result<int> run(const PredictOptions& options);
/// Tests whether the fates of a run are those that its profile promises; 1 when a test fails.
[[nodiscard]] base::Result<int> run(const VerifyOptions& request);
/// Prints a profile that does what was measured.
[[nodiscard]] base::Result<int> run(const LearnOptions& options);
/// Writes the page of a run.
[[nodiscard]] base::Result<int> run(const ReportOptions& options);
/// Asks and measures until it has the answers, or answers until it is told to stop.
[[nodiscard]] base::Result<int> run(const ProbeOptions& options);

} // namespace hapnet::emulator
