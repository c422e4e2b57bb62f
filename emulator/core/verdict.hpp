// SPDX-FileCopyrightText: 2026 The Hapnet authors
// SPDX-License-Identifier: MIT
#pragma once

#include "proto/base/time.hpp"

#include <array>
#include <cstdint>
#include <string_view>
#include <variant>

namespace hapnet::emulator {

/// Why a datagram that was received did not leave.
enum class DropCause : std::uint8_t {
    random_loss,      // the configured loss
    burst_loss,       // the configured burst loss
    queue_full,       // the bound of the delay line: too much in flight
    no_destination,   // the other side is not known yet
    no_route,         // the system knew no way to the other side
    refused,          // the other side's machine said that nobody listens there
    too_big,          // larger than the way out carries
    send_buffer_full, // the system's send buffer
    send_failed,      // any other refusal of the system
};

inline constexpr std::array drop_causes{
    DropCause::random_loss,    DropCause::burst_loss,       DropCause::queue_full,
    DropCause::no_destination, DropCause::no_route,         DropCause::refused,
    DropCause::too_big,        DropCause::send_buffer_full, DropCause::send_failed,
};

/// "random_loss": the key in statistics.
[[nodiscard]] std::string_view to_text(DropCause cause);

/// To be delivered `after` so long. Of one impairment it may be negative (jitter); the total
/// of a Pipeline is not.
struct Deliver {
    base::Duration after{};

    friend bool operator==(const Deliver&, const Deliver&) = default;
};

/// Not to be delivered.
struct Drop {
    DropCause cause;

    friend bool operator==(const Drop&, const Drop&) = default;
};

/// What is to become of a datagram.
using Verdict = std::variant<Deliver, Drop>;

} // namespace hapnet::emulator
