// SPDX-FileCopyrightText: 2026 The Hapnet authors
// SPDX-License-Identifier: MIT
#include "peer/core/tick_count.hpp"

#include "proto/base/nearest.hpp"

namespace hapnet::peer {

TickCount::Counted TickCount::of(const wire::State& state, base::Duration tick)
{
    if (!origin_) origin_ = Origin{state.sequence, state.sent};
    const std::int64_t messages = std::int64_t{state.sequence} - origin_->sequence;
    const std::int64_t ticks =
        base::nearest(base::to_seconds(state.sent - origin_->sent) / base::to_seconds(tick));
    is_sparse_ = is_sparse_ || ticks - messages > missed_max + ticks / 10;
    Counted counted{static_cast<std::uint32_t>(origin_->sequence + (is_sparse_ ? ticks : messages)),
                    tick};
    const bool is_newer = state.sequence > newest_ && counted.number > newest_number_;
    if (!is_newer) return counted;
    if (is_sparse_ && newest_ > 0)
        counted.span = (counted.number - newest_number_) * tick / (state.sequence - newest_);
    newest_ = state.sequence;
    newest_number_ = counted.number;
    return counted;
}

} // namespace hapnet::peer
