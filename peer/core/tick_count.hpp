// SPDX-FileCopyrightText: 2026 The Hapnet authors
// SPDX-License-Identifier: MIT
#pragma once

#include "proto/base/time.hpp"
#include "proto/wire/message.hpp"

#include <cstdint>
#include <optional>

namespace hapnet::peer {

/// The ticks of a remote's messages. Messages are numbered as they are sent: where every tick has
/// one, the number is the tick. Where the remote sends in fewer ticks, its send stamps tell the
/// tick.
class TickCount {
public:
    /// The number of ticks, beside a tenth of all, that may have no message although every tick
    /// should have one: the loop stood still, or missed ticks.
    static constexpr std::int64_t missed_max = 50;

    struct Counted {
        /// Number of the tick, on the scale of sequence numbers: newer states have greater ones.
        std::uint32_t number = 0;
        base::Duration span{}; // time from one message of the sender to the next: a tick or more
    };
    [[nodiscard]] Counted of(const wire::State& state, base::Duration tick);
    void forget() { *this = {}; }

private:
    struct Origin {
        std::uint32_t sequence = 0;
        base::TimePoint sent;
    };
    std::optional<Origin> origin_;
    std::uint32_t newest_ = 0; // sequence number of the newest state
    std::uint32_t newest_number_ = 0;
    bool is_sparse_ = false; // the remote does not send in every tick
};

} // namespace hapnet::peer
