// SPDX-FileCopyrightText: 2026 The Hapnet authors
// SPDX-License-Identifier: MIT
#pragma once

#include "proto/base/result.hpp"
#include "proto/base/time.hpp"
#include "proto/record/reader.hpp"

#include <cstdint>
#include <span>
#include <string>

namespace hapnet::lab::records {

enum class ClockMethod : std::uint8_t {
    same_boot, ///< one machine, one CLOCK_BOOTTIME: nothing to convert
    echo,      ///< two clocks, compared by the echoes in the messages
};

/// How B's clock stands to A's.
struct Clock {
    ClockMethod method = ClockMethod::same_boot;
    /// B's clock minus A's.
    base::Duration offset{};
    base::Duration uncertainty{};

    [[nodiscard]] base::TimePoint to_a(base::TimePoint on_b) const { return on_b - offset; }
};

/// One peer's part of a session. Refers into its record.
struct Side {
    record::SessionRow terms;
    /// From the first row of this session up to the next session's.
    std::span<const record::TickRow> ticks;
    /// All that the record holds: what belongs to the session says its messages themselves.
    std::span<const record::MessageRow> messages;
    std::int64_t peer_id = 0;
};

/// What two records tell of the same session.
struct Session {
    Side a;
    Side b;
    Clock clock;
    base::Duration tick{};
    std::string task; // as A's record names it; "" when it does not
};

/// The last session that both records know. Refers into both records. Refuses records that share
/// none, or that one peer has written.
[[nodiscard]] base::Result<Session> common_session(const record::Record& a,
                                                   const record::Record& b);

} // namespace hapnet::lab::records
