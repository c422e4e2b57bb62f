// SPDX-FileCopyrightText: 2026 The Hapnet authors
// SPDX-License-Identifier: MIT
#include "emulator/core/buffer_pool.hpp"

#include <utility>

namespace hapnet::emulator {

BufferPool::BufferPool(std::size_t buffers_max) : buffers_max_{buffers_max}
{
    spare_.reserve(buffers_max);
}

std::vector<std::byte> BufferPool::copy_of(std::span<const std::byte> bytes)
{
    std::vector<std::byte> buffer;
    if (!spare_.empty()) {
        buffer = std::move(spare_.back());
        spare_.pop_back();
    }
    buffer.assign(bytes.begin(), bytes.end());
    return buffer;
}

void BufferPool::give_back(std::vector<std::byte>&& buffer)
{
    if (buffer.capacity() > kept_bytes_max || spare_.size() >= buffers_max_) {
        buffer = {};
        return;
    }
    spare_.push_back(std::move(buffer));
}

} // namespace hapnet::emulator
