// SPDX-FileCopyrightText: 2026 The Hapnet authors
// SPDX-License-Identifier: MIT
#pragma once

#include <cstddef>
#include <span>
#include <vector>

namespace hapnet::emulator {

/// Byte buffers that are used again, so that a steady stream of datagrams does not allocate.
class BufferPool {
public:
    /// Larger buffers are freed instead of kept: a flood of huge datagrams must not leave its
    /// memory behind for good. Above what an Ethernet frame carries.
    static constexpr std::size_t kept_bytes_max = 2048;

    /// Keeps up to `buffers_max` buffers.
    explicit BufferPool(std::size_t buffers_max);

    /// A copy of `bytes`.
    [[nodiscard]] std::vector<std::byte> copy_of(std::span<const std::byte> bytes);

    void give_back(std::vector<std::byte>&& buffer);

private:
    std::size_t buffers_max_;
    std::vector<std::vector<std::byte>> spare_;
};

} // namespace hapnet::emulator
