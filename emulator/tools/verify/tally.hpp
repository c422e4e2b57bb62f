// SPDX-FileCopyrightText: 2026 The Hapnet authors
// SPDX-License-Identifier: MIT
#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

namespace hapnet::emulator::tools {

/// Counts of a sequence of losses, as far as the tests need them. Takes one datagram after the
/// other and keeps none.
class LossTally {
public:
    /// Keeps only every `stride`-th run of losses: neighbouring runs of some laws depend on each
    /// other.
    explicit LossTally(std::size_t stride = 1) : stride_{stride} {}

    void add(bool is_lost);

    [[nodiscard]] std::uint64_t datagrams() const { return datagrams_; }
    [[nodiscard]] std::uint64_t losses() const { return losses_; }

    /// Pairs of neighbours, by the first and the second of them.
    [[nodiscard]] std::uint64_t pairs(bool first, bool second) const
    {
        return pairs_[(first ? 2U : 0U) + (second ? 1U : 0U)];
    }

    /// [i]: runs of i + 1 losses, without one at the very beginning and one at the end, of which
    /// only a part may have been seen.
    [[nodiscard]] const std::vector<std::uint64_t>& runs() const { return runs_; }

private:
    void end_run();

    std::size_t stride_;
    std::uint64_t datagrams_ = 0;
    std::uint64_t losses_ = 0;
    std::uint64_t pairs_[4] = {};
    std::vector<std::uint64_t> runs_{};
    std::size_t run_ = 0; // length of the run of losses in progress
    bool began_ = false;  // a datagram that was not lost has come: the first run is over
    bool was_lost_ = false;
    std::uint64_t ended_runs_ = 0;
};

/// Counts of two sequences of losses, side by side.
struct PairTally {
    std::uint64_t datagrams = 0;
    std::uint64_t first = 0;  // losses in the first sequence
    std::uint64_t second = 0; // losses in the second sequence
    std::uint64_t both = 0;

    void add(bool first_lost, bool second_lost)
    {
        ++datagrams;
        if (first_lost) ++first;
        if (second_lost) ++second;
        if (first_lost && second_lost) ++both;
    }
};

} // namespace hapnet::emulator::tools
