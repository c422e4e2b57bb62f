// SPDX-FileCopyrightText: 2026 The Hapnet authors
// SPDX-License-Identifier: MIT
#pragma once

#include "proto/base/ensure.hpp"

#include <bit>
#include <cstddef>
#include <vector>

namespace hapnet::emulator {

/// A first-in-first-out queue of bounded size whose memory is reserved at construction. Memory that
/// has never been used is never touched.
template <typename T>
class Ring {
public:
    explicit Ring(std::size_t size_max) : mask_{std::bit_ceil(size_max) - 1}
    {
        entries_.reserve(mask_ + 1);
    }

    [[nodiscard]] bool empty() const { return size_ == 0; }
    [[nodiscard]] std::size_t size() const { return size_; }
    [[nodiscard]] bool full() const { return size_ > mask_; }
    /// True if the ring would be full with this number of elements.
    [[nodiscard]] bool is_full_with(std::size_t size) const { return size > mask_; }

    void push(const T& entry)
    {
        base::ensure(!full());
        const std::size_t place = (first_ + size_) & mask_;
        if (place == entries_.size()) { // first use of this place: places come in order
            entries_.push_back(entry);
        } else {
            entries_[place] = entry;
        }
        ++size_;
    }

    [[nodiscard]] T& front() { return entries_[first_]; }
    [[nodiscard]] const T& front() const { return entries_[first_]; }
    [[nodiscard]] const T& back() const { return entries_[(first_ + size_ - 1) & mask_]; }

    T pop()
    {
        base::ensure(size_ > 0);
        const T entry = entries_[first_];
        first_ = (first_ + 1) & mask_;
        --size_;
        return entry;
    }

private:
    std::size_t mask_;       // a power of two, less one
    std::vector<T> entries_; // places that were used at least once
    std::size_t first_ = 0;
    std::size_t size_ = 0;
};

} // namespace hapnet::emulator
