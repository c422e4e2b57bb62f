// SPDX-FileCopyrightText: 2026 The Hapnet authors
// SPDX-License-Identifier: MIT
#pragma once

#include <array>
#include <concepts>
#include <cstddef>
#include <new>
#include <tuple>
#include <type_traits>

namespace hapnet::peer {

/// A first-in-first-out queue of at most `capacity` values that never allocates. When it is full,
/// the oldest value makes room: messages age, and the newest are worth most.
template <typename Value, std::size_t capacity>
class Outbox {
public:
    void put(const Value& value)
    {
        put([&value] { return value; });
    }
    /// Puts the value that make() returns. It is made in place.
    template <std::invocable Make>
    void put(Make make)
    {
        static_assert(std::is_trivially_destructible_v<Value>);
        if (size_ == capacity) std::ignore = take();
        ::new (static_cast<void*>(&values_[(first_ + size_) % capacity])) Value(make());
        ++size_;
    }

    /// The oldest, which stays where it is until the next put(); nullptr: there is none.
    [[nodiscard]] const Value* take()
    {
        if (size_ == 0) return nullptr;
        const Value& oldest = values_[first_];
        first_ = (first_ + 1) % capacity;
        --size_;
        return &oldest;
    }

private:
    std::array<Value, capacity> values_{};
    std::size_t first_ = 0;
    std::size_t size_ = 0;
};

} // namespace hapnet::peer
