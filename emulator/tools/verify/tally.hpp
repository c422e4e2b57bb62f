// SPDX-FileCopyrightText: 2026 The Hapnet authors
// SPDX-License-Identifier: MIT
#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

namespace hapnet::emulator::tools {

/// Counts the properties of a sequence of losses that the tests need. Takes one datagram after the
/// other and keeps none.
class LossTally {
public:
    /// Keeps only every `stride`-th run of losses, because neighbouring runs of some laws depend on
    /// each other.
    explicit LossTally(std::size_t stride = 1) : stride_{stride} {}

    void add(bool is_lost);

    [[nodiscard]] std::uint64_t datagrams() const { return datagrams_; }
    [[nodiscard]] std::uint64_t losses() const { return losses_; }

    /// Returns the number of pairs of neighbours of which the first was lost (or not) and the
    /// second was lost (or not).
    [[nodiscard]] std::uint64_t pairs(bool first, bool second) const
    {
        return pairs_[(first ? 2U : 0U) + (second ? 1U : 0U)];
    }

    /// Returns the counts of runs by length: [i] counts runs of i + 1 losses. A run at the very
    /// beginning and one at the end are not counted, because only a part of them may have been
    /// seen.
    [[nodiscard]] const std::vector<std::uint64_t>& runs() const { return runs_; }

private:
    void end_run();

    std::size_t stride_;
    std::uint64_t datagrams_ = 0;
    std::uint64_t losses_ = 0;
    std::uint64_t pairs_[4] = {};
    std::vector<std::uint64_t> runs_{};
    std::size_t run_ = 0; // length of the run of losses in progress
    bool began_ = false;  // a datagram was not lost, so the first run is over
    bool was_lost_ = false;
    std::uint64_t ended_runs_ = 0;
};

/// Counts of two sequences of losses, datagram by datagram.
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
