// SPDX-FileCopyrightText: 2026 The Hapnet authors
// SPDX-License-Identifier: MIT
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <vector>

namespace hapnet::emulator::tools {

/// Datagrams in a row that were lost, or that arrived.
struct LossRun {
    bool is_lost = false;
    std::size_t length = 0;
};

[[nodiscard]] std::vector<LossRun> runs_of(const std::vector<bool>& lost);

/// A Markov chain that steps once per datagram, each of whose states loses a share. States that are
/// not used are never entered.
struct LossChain {
    static constexpr std::size_t states_max = 4;
    using Row = std::array<double, states_max>;

    std::array<Row, states_max> steps{}; // [from][to]
    Row loses{};
    Row shares{}; // share of datagrams in each state, in the long run
};

/// The lengths of runs of losses, or of arrivals, in a chain, up to `most` datagrams: [i] is the
/// probability that a run has at least (i + 1) datagrams.
[[nodiscard]] std::vector<double> run_lengths(const LossChain& chain, bool of_losses,
                                              std::size_t most);

/// Tests if runs of losses, or those of arrivals between them, follow a chain. Returns the p-value
/// of Pearson's chi-square of their lengths, in classes where at least 5 are expected. Where runs
/// come in clusters it is divided by what that adds to the variance (Rao and Scott, JASA 76, 1981).
/// As the chain was fitted to the same runs, the p-value is too large: a rejection is more reliable
/// than a pass. The first run and the last are cut off and do not count. nullopt: too few runs.
[[nodiscard]] std::optional<double> test_runs(const std::vector<LossRun>& runs,
                                              const LossChain& chain, bool of_losses);

} // namespace hapnet::emulator::tools
