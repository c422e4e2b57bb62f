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
/// the oldest value is dropped, because the newest messages are the most useful.
template <typename Value, std::size_t capacity>
class Outbox {
public:
    void put(const Value& value)
    {
        put([&value] { return value; });
    }
    /// Adds the value that make() returns, constructed in place.
    template <std::invocable Make>
    void put(Make make)
    {
        static_assert(std::is_trivially_destructible_v<Value>);
        if (size_ == capacity) std::ignore = take();
        ::new (static_cast<void*>(&values_[(first_ + size_) % capacity])) Value(make());
        ++size_;
    }

    /// Takes the oldest value, which stays valid until the next put(); nullptr if there is none.
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
