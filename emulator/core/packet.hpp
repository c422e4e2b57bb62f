// SPDX-FileCopyrightText: 2026 The Hapnet authors
// SPDX-License-Identifier: MIT
#pragma once

#include "proto/base/time.hpp"

#include <cstddef>
#include <cstdint>

namespace hapnet::emulator {

/// Facts about a datagram that an impairment may use.
struct Packet {
    std::uint64_t number = 0; // counts the arrivals in its direction, from 0
    std::size_t bytes = 0;    // payload bytes
    // Arrival since the run began; never earlier than the previous arrival
    base::Duration at{};
};

} // namespace hapnet::emulator
