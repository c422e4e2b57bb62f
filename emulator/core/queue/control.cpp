// SPDX-FileCopyrightText: 2026 The Hapnet authors
// SPDX-License-Identifier: MIT
#include "emulator/core/queue/control.hpp"

#include "emulator/core/delay/bounds.hpp"

namespace hapnet::emulator {

base::Result<void> validate(const QueueControl& queue)
{
    constexpr base::Duration zero{0};
    const bool has_target = queue.target.has_value();
    return all(
        {require(!has_target || *queue.target > zero, "target must be more than 0"),
         require(!has_target || *queue.target <= longest_delay, "target must be at most 1000000s"),
         require(!has_target || queue.law != QueueLaw::drop_tail,
                 "target belongs to codel, fq-codel or pie: drop-tail aims at nothing"),
         require(queue.interval > zero && queue.interval <= longest_delay,
                 "interval must be more than 0 and at most 1000000s"),
         require(queue.time_max >= zero, "time must not be negative"),
         require(!queue.mark_above ||
                     (*queue.mark_above >= zero && *queue.mark_above <= longest_delay),
                 "ecn_threshold must be from 0 to 1000000s"),
         require(queue.flows > 0 && queue.flows <= QueueControl::flows_most,
                 "flows must be from 1 to 65536"),
         require(queue.quantum_bytes > 0 && queue.quantum_bytes <= QueueControl::quantum_most,
                 "quantum must be from 1 to 1073741824")});
}

} // namespace hapnet::emulator
