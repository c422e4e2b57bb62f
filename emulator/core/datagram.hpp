// SPDX-FileCopyrightText: 2026 The Hapnet authors
// SPDX-License-Identifier: MIT
#pragma once

#include "proto/base/time.hpp"

#include <cstddef>
#include <cstdint>
#include <vector>

namespace hapnet::emulator {

/// A datagram on its way through the emulator. What its bytes mean is nobody's business here.
struct Datagram {
    std::vector<std::byte> bytes;
    std::uint64_t number = 0; // counts what arrived in its direction, from 0
    base::TimePoint arrival{};
    base::TimePoint due{}; // when it is to leave: never before
};

} // namespace hapnet::emulator
