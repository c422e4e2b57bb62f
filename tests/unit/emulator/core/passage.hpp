// SPDX-FileCopyrightText: 2026 The Hapnet authors
// SPDX-License-Identifier: MIT
#pragma once

#include "emulator/core/stream_statistics.hpp"

#include <cstdint>

namespace hapnet::emulator {

/// A datagram that left.
struct Passage {
    std::uint64_t number = 0;
    base::TimePoint arrival{};
    base::TimePoint sent{};
    bool is_copy = false;
};

inline void note(StreamStatistics& statistics, const Passage& passage)
{
    statistics.on_sent(
        {.is_copy = passage.is_copy, .number = passage.number, .arrival = passage.arrival},
        passage.sent);
}

} // namespace hapnet::emulator
