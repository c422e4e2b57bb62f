// SPDX-FileCopyrightText: 2026 The Hapnet authors
// SPDX-License-Identifier: MIT
#pragma once

#include <algorithm>
#include <cstddef>

namespace hapnet::emulator {

/// Limits of the datagrams and bytes in flight at a time.
struct QueueLimits {
    static constexpr std::size_t bytes_by_default = std::size_t{256} << 20;
    static constexpr std::size_t datagrams_min = 65'536;

    /// The limit of each direction. Address space for the queues is reserved for this number, about
    /// 350 bytes a datagram. Memory is used only for the largest number that was in flight so far.
    std::size_t datagrams_max = datagrams_of(bytes_by_default);
    /// The limit of each direction. It is the size of the slab unless the slab is shared.
    std::size_t bytes_max = bytes_by_default;

    /// Returns the limits of a path that has this amount of memory: one datagram for each KiB, at
    /// least 65 536.
    [[nodiscard]] static constexpr QueueLimits within(std::size_t bytes)
    {
        return {.datagrams_max = datagrams_of(bytes), .bytes_max = bytes};
    }

    /// Returns the limits of one of several paths that share this amount of memory. A path may use
    /// more than its part while others need less, and may always have a few datagrams in flight.
    [[nodiscard]] static constexpr QueueLimits shared(std::size_t bytes, std::size_t paths)
    {
        constexpr std::size_t parts = 4;
        constexpr std::size_t one_path_datagrams_min = 1024;
        constexpr std::size_t one_path_bytes_min = std::size_t{1} << 20;
        const auto all = within(bytes);
        const auto part = [&](std::size_t of, std::size_t least) {
            return std::min(of, std::max(least, of / paths * parts));
        };
        return {.datagrams_max = part(all.datagrams_max, one_path_datagrams_min),
                .bytes_max = part(all.bytes_max, one_path_bytes_min)};
    }

private:
    static constexpr std::size_t datagrams_of(std::size_t bytes)
    {
        return std::max(datagrams_min, bytes >> 10);
    }
};

} // namespace hapnet::emulator
