// SPDX-FileCopyrightText: 2026 The Hapnet authors
// SPDX-License-Identifier: MIT
#include "emulator/core/verdict.hpp"

#include "proto/base/ensure.hpp"

namespace hapnet::emulator {

std::string_view to_text(DropCause cause)
{
    switch (cause) {
    case DropCause::random_loss: return "random_loss";
    case DropCause::burst_loss: return "burst_loss";
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

} // namespace hapnet::emulator
