// SPDX-FileCopyrightText: 2026 The Hapnet authors
// SPDX-License-Identifier: MIT
#pragma once

#include "proto/base/time.hpp"
#include "proto/wire/message.hpp"

#include <cstdint>
#include <optional>

namespace hapnet::peer {

/// Finds the ticks of a remote's messages. Messages are numbered in the order of sending. If every
/// tick has a message, its number is the number of the tick. If the remote sends in fewer ticks,
/// the tick follows from the send stamp.
class TickCount {
public:
    /// The number of ticks, in addition to a tenth of all ticks, that may lack a message although
    /// every tick should have one, because the loop stalled or missed ticks.
    static constexpr std::int64_t missed_max = 50;

    struct Counted {
        /// The number of the tick, on the scale of sequence numbers: newer states have greater
        /// numbers.
        std::uint32_t number = 0;
        base::Duration span{}; // interval between the sender's messages: a tick or more
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
