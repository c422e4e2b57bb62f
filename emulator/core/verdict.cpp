// SPDX-FileCopyrightText: 2026 The Hapnet authors
// SPDX-License-Identifier: MIT
#include "emulator/core/verdict.hpp"

#include "proto/base/ensure.hpp"

namespace hapnet::emulator {

std::string_view to_text(DropCause cause)
{
    switch (cause) {
    case DropCause::random_loss: return "random_loss";
    case DropCause::block_loss: return "block_loss";
    case DropCause::periodic_loss: return "periodic_loss";
    case DropCause::burst_loss: return "burst_loss";
    case DropCause::gilbert_elliott: return "gilbert_elliott";
    case DropCause::four_state: return "four_state";
    case DropCause::listed_loss: return "listed_loss";
    case DropCause::pattern_loss: return "pattern_loss";
    case DropCause::trace_loss: return "trace_loss";
    case DropCause::outage: return "outage";
    case DropCause::mtu: return "mtu";
    case DropCause::rate_queue_full: return "rate_queue_full";
    case DropCause::replay_ended: return "replay_ended";
    case DropCause::queue_full: return "queue_full";
    case DropCause::no_destination: return "no_destination";
    case DropCause::no_route: return "no_route";
    case DropCause::refused: return "refused";
    case DropCause::too_big: return "too_big";
    case DropCause::send_buffer_full: return "send_buffer_full";
    case DropCause::send_failed: return "send_failed";
    }
    base::ensure(false);
    return {};
}

std::string_view to_text(LossState state)
{
    switch (state) {
    case LossState::none: return "none";
    case LossState::good: return "good";
    case LossState::bad: return "bad";
    case LossState::received_in_gap: return "received_in_gap";
    case LossState::received_in_burst: return "received_in_burst";
    case LossState::lost_in_burst: return "lost_in_burst";
    case LossState::lost_in_gap: return "lost_in_gap";
    }
    base::ensure(false);
    return {};
}

} // namespace hapnet::emulator
