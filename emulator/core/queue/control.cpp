// SPDX-FileCopyrightText: 2026 The Hapnet authors
// SPDX-License-Identifier: MIT
#include "emulator/core/queue/control.hpp"

#include "emulator/core/delay/bounds.hpp"

namespace hapnet::emulator {

base::Result<void> validate(const QueueControl& queue)
{
    constexpr base::Duration zero{0};
    const bool has_target = queue.target.has_value();
    const bool has_interval = queue.interval.has_value();
    const bool has_codel = queue.law == QueueLaw::codel || queue.law == QueueLaw::fq_codel;
    return all(
        {require(!has_target || *queue.target > zero, "target must be more than 0"),
         require(!has_target || *queue.target <= longest_delay, "target must be at most 1000000s"),
         require(!has_target || queue.law != QueueLaw::drop_tail,
                 "target belongs to codel, fq-codel or pie: drop-tail aims at nothing"),
         require(!has_interval || (*queue.interval > zero && *queue.interval <= longest_delay),
                 "interval must be more than 0 and at most 1000000s"),
         require(!has_interval || has_codel,
                 "interval belongs to codel or fq-codel: remove it, or use one of these laws"),
         require(!queue.is_marking || queue.law != QueueLaw::drop_tail,
                 "ecn belongs to codel, fq-codel or pie: drop-tail drops only what does not fit. "
                 "Remove it, or use ecn_threshold, which marks under any law"),
         require((!queue.flows && !queue.quantum_bytes) || queue.law == QueueLaw::fq_codel,
                 "flows and quantum belong to fq-codel: remove them, or use that law"),
         require(queue.time_max >= zero, "time must not be negative"),
         require(!queue.mark_above ||
                     (*queue.mark_above >= zero && *queue.mark_above <= longest_delay),
                 "ecn_threshold must be from 0 to 1000000s"),
         require(queue.flow_count() > 0 && queue.flow_count() <= QueueControl::flows_most,
                 "flows must be from 1 to 65536"),
         require(queue.turn_bytes() > 0 && queue.turn_bytes() <= QueueControl::quantum_most,
                 "quantum must be from 1 to 1073741824")});
}

} // namespace hapnet::emulator
