// SPDX-FileCopyrightText: 2026 The Hapnet authors
// SPDX-License-Identifier: MIT
#pragma once

#include "emulator/core/datagram.hpp"
#include "proto/base/time.hpp"

#include <cstddef>
#include <optional>
#include <vector>

namespace hapnet::emulator {

/// How much a delay line holds. The defaults are 65 s of a 1 kHz stream, or a second of 64 kHz.
struct QueueLimits {
    std::size_t datagrams_max = 65'536;
    std::size_t bytes_max = 256U << 20;
};

/// Holds datagrams until they are due. Those due at the same time leave in the order of their
/// numbers. Storage for its own entries is allocated once, at construction.
class DelayLine {
public:
    explicit DelayLine(QueueLimits limits = {});

    /// Whether one more datagram of so many bytes keeps within the limits.
    [[nodiscard]] bool has_room(std::size_t bytes) const;

    /// Ensures has_room().
    void push(Datagram datagram);

    /// The earliest datagram that is due at `now`.
    [[nodiscard]] std::optional<Datagram> pop(base::TimePoint now);

    /// When the earliest datagram is due; nullopt when the line is empty.
    [[nodiscard]] std::optional<base::TimePoint> next_due() const;

    [[nodiscard]] std::size_t size() const { return heap_.size(); }

private:
    QueueLimits limits_;
    std::size_t bytes_ = 0;
    std::vector<Datagram> heap_;
};

} // namespace hapnet::emulator
