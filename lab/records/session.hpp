// SPDX-FileCopyrightText: 2026 The Hapnet authors
// SPDX-License-Identifier: MIT
#pragma once

#include "proto/base/describe.hpp"
#include "proto/base/result.hpp"
#include "proto/base/time.hpp"
#include "proto/record/reader.hpp"

#include <cstdint>
#include <optional>
#include <span>
#include <string>
#include <vector>

namespace hapnet::lab::records {

enum class ClockMethod : std::uint8_t {
    same_boot,    ///< one machine, one clock: nothing to convert
    synchronised, ///< clocks that both peers state to be synchronised: nothing to convert
    echo,         ///< two clocks, compared by the echoes in the messages
};

constexpr auto names_of(base::Tag<ClockMethod>)
{
    return base::names("same-boot", "synchronised", "echo");
}

/// The relation of B's clock to A's clock.
struct Clock {
    ClockMethod method = ClockMethod::same_boot;
    /// B's clock minus A's, at the time `when` on A's clock.
    base::Duration offset{};
    base::Duration uncertainty{};
    base::TimePoint when{};
    double skew = 0.0; // share by which B's clock runs faster than A's; far below 1

    [[nodiscard]] base::TimePoint to_a(base::TimePoint on_b) const
    {
        const base::TimePoint roughly = on_b - offset;
        return roughly - drift(skew / (1.0 + skew), roughly);
    }
    [[nodiscard]] base::TimePoint to_b(base::TimePoint on_a) const
    {
        return on_a + offset + drift(skew, on_a);
    }

    /// Returns the growth of the difference since `when`.
    [[nodiscard]] base::Duration drift(double share, base::TimePoint at) const
    {
        if (share == 0.0) return {};
        return std::chrono::duration_cast<base::Duration>(share * (at - when));
    }
};

constexpr auto fields_of(base::Tag<Clock>)
{
    return base::fields(
        "clock",
        base::member("method", &Clock::method,
                     "`same-boot`: one machine, one clock. `synchronised`: both peers state that "
                     "their clocks are. `echo`: two clocks, compared by the echoes."),
        base::member("offset_ms", &Clock::offset, "B's clock minus A's."),
        base::member("uncertainty_ms", &Clock::uncertainty, "The bound of its error."));
}

/// One peer's part of a session. It refers to the peer's record.
struct Side {
    record::SessionRow terms;
    /// The ticks from the first row of this session up to that of the next session.
    std::span<const record::TickRow> ticks;
    /// All messages that the record holds. Each message says to which session it belongs.
    std::span<const record::MessageRow> messages;
    /// All body rows that the record holds, ascending in tick and number.
    std::span<const record::BodyRow> bodies{};
    std::int64_t peer_id = 0;
    /// True if `sent_sequence` of the ticks counts the messages to the other side of this session.
    bool numbers_sent = true;
    /// True if the record has only the last seconds. Messages before them do not count as lost.
    bool begins_late = false;
};

/// Returns the clock of the other peer relative to that of the record which holds this row.
[[nodiscard]] Clock clock_of(const record::SessionRow& row);

/// One of the bodies that a session shared.
struct RecordedBody {
    std::optional<std::uint16_t> number{}; // number in the scene, from 0; nullopt: not recorded
    std::string name{};                    // name in the scene; may be empty
    bool can_turn = false;
    bool has_rows = false; // the body has rows of its own; false: only the ticks have its position
};

/// A session as the records of two peers hold it.
struct Session {
    Side a;
    Side b;
    Clock clock;
    base::Duration tick{};
    std::string task; // as A's record names it; "" when it does not name a task
    std::vector<RecordedBody> bodies{};
};

/// Returns the last session that both records contain. It refers to both records. Fails for records
/// that share no session, or that one peer has written.
[[nodiscard]] base::Result<Session> common_session(const record::Record& a,
                                                   const record::Record& b);

} // namespace hapnet::lab::records
