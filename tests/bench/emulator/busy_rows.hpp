// SPDX-FileCopyrightText: 2026 The Hapnet authors
// SPDX-License-Identifier: MIT
#pragma once

#include "proto/base/time.hpp"
#include "tests/bench/common/rows.hpp"
#include "tests/bench/emulator/probe.hpp"
#include "tests/bench/emulator/subjects.hpp"

#include <chrono>
#include <cstddef>
#include <cstdint>
#include <map>
#include <string_view>
#include <vector>

namespace hapnet::bench {

/// The results of a relay beside busy processes, over all trials at one rate.
struct BesideBusy {
    std::vector<base::Duration> errors; // in any order
    std::size_t stalls = 0;             // waits longer than `stall_min`
    base::Duration longest_stall{};
    std::uint64_t lost = 0;
    base::Duration used{}; // its processor time
    base::Duration took{};

    static constexpr base::Duration stall_min = std::chrono::milliseconds{5};

    void add(const TimingTrial& trial);
    /// The share of a core that it used.
    [[nodiscard]] double share() const;
};

/// Above this share of its core, the timerfd relay no longer shows what is possible.
inline constexpr double share_comparable = 0.8;

/// Returns the rows of one rate: eco and precise against the timerfd relay. Without SCHED_FIFO
/// (`fifo`) the relays share the processors with the busy processes, and have no target.
[[nodiscard]] std::vector<Row>
rows_beside_busy(double rate, std::map<std::string_view, BesideBusy> relays, bool fifo);

} // namespace hapnet::bench
