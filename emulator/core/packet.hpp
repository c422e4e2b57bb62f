// SPDX-FileCopyrightText: 2026 The Hapnet authors
// SPDX-License-Identifier: MIT
#pragma once

#include "proto/base/time.hpp"

#include <cstddef>
#include <cstdint>

namespace hapnet::emulator {

/// Facts of a datagram that an impairment may use.
struct Packet {
    std::uint64_t number = 0; // counts what arrived in its direction, from 0
    std::size_t bytes = 0;    // of payload
    base::Duration at{};      // when it arrived, since the run began; not less than the one before
};

} // namespace hapnet::emulator
