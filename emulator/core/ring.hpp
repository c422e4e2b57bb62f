// SPDX-FileCopyrightText: 2026 The Hapnet authors
// SPDX-License-Identifier: MIT
#pragma once

#include "proto/base/ensure.hpp"

#include <bit>
#include <cstddef>
#include <vector>

namespace hapnet::emulator {

/// A first-in-first-out queue of bounded size whose memory is taken at construction.
template <typename T>
class Ring {
public:
    explicit Ring(std::size_t size_max) : entries_(std::bit_ceil(size_max)) {}

    [[nodiscard]] bool empty() const { return size_ == 0; }
    [[nodiscard]] std::size_t size() const { return size_; }
    [[nodiscard]] bool full() const { return size_ == entries_.size(); }

    void push(const T& entry)
    {
        base::ensure(size_ < entries_.size());
        entries_[(first_ + size_) & mask()] = entry;
        ++size_;
    }

    [[nodiscard]] T& front() { return entries_[first_]; }
    [[nodiscard]] const T& front() const { return entries_[first_]; }
    [[nodiscard]] const T& back() const { return entries_[(first_ + size_ - 1) & mask()]; }

    T pop()
    {
        base::ensure(size_ > 0);
        const T entry = entries_[first_];
        first_ = (first_ + 1) & mask();
        --size_;
        return entry;
    }

private:
    [[nodiscard]] std::size_t mask() const { return entries_.size() - 1; }

    std::vector<T> entries_; // a power of two of them
    std::size_t first_ = 0;
    std::size_t size_ = 0;
};

} // namespace hapnet::emulator
