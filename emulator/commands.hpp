// SPDX-FileCopyrightText: 2026 The Hapnet authors
// SPDX-License-Identifier: MIT
#pragma once

#include "emulator/options.hpp"
#include "proto/base/result.hpp"

namespace hapnet::emulator {

// The commands of the program. Each returns its exit code, or an error about bad input.

/// Relays for one pair until a signal or a client of the control socket stops it, or --duration is
/// over.
[[nodiscard]] base::Result<int> run(const Options& options);
/// Relays for many pairs.
[[nodiscard]] base::Result<int> run(const LinkOptions& options);
/// Relays for any client of a server.
[[nodiscard]] base::Result<int> run(const UpstreamOptions& options);
/// Runs two or more commands with the emulator between them. Returns the exit code of the first.
[[nodiscard]] base::Result<int> run(const BetweenOptions& options);
/// Runs a command with the emulator between it and the network. Returns the command's exit code.
[[nodiscard]] base::Result<int> run(const ExecOptions& options);
/// Joins two interfaces until it is stopped, or finds a loop.
[[nodiscard]] base::Result<int> run(const BridgeOptions& options);
/// Prints the profile in canonical form, a description of each stage, and warnings.
[[nodiscard]] base::Result<int> run(const CheckOptions& options);
/// Prints the effect that the profile will have on a stream.
[[nodiscard]] base::Result<int> run(const PredictOptions& options);
/// Tests whether the fates of a run agree with its profile. Returns 1 when a test fails.
[[nodiscard]] base::Result<int> run(const VerifyOptions& request);
/// Prints a profile that reproduces what was measured.
[[nodiscard]] base::Result<int> run(const LearnOptions& options);
/// Writes the page of a run.
[[nodiscard]] base::Result<int> run(const ReportOptions& options);
/// Sends questions and measures the answers until it has all of them, or answers questions until it
/// is stopped.
[[nodiscard]] base::Result<int> run(const ProbeOptions& options);

} // namespace hapnet::emulator
