// SPDX-FileCopyrightText: 2026 The Hapnet authors
// SPDX-License-Identifier: MIT
#pragma once

#include <array>
#include <cstddef>
#include <optional>
#include <tuple>

namespace hapnet::peer {

/// A first-in-first-out queue of at most `capacity` values that never allocates. When it is full,
/// the oldest value makes room: messages age, and the newest are worth most.
template <typename Value, std::size_t capacity>
class Outbox {
public:
    void put(const Value& value)
    {
        if (size_ == capacity) std::ignore = take();
        values_[(first_ + size_) % capacity] = value;
        ++size_;
    }

    [[nodiscard]] std::optional<Value> take()
    {
        if (size_ == 0) return std::nullopt;
        const Value& oldest = values_[first_]; // stays as it is until put() needs its place
        first_ = (first_ + 1) % capacity;
        --size_;
        return oldest;
    }

private:
    std::array<Value, capacity> values_{};
    std::size_t first_ = 0;
    std::size_t size_ = 0;
};

} // namespace hapnet::peer
