// SPDX-FileCopyrightText: 2026 The Hapnet authors
// SPDX-License-Identifier: MIT
#pragma once

#include "proto/base/ensure.hpp"

#include <cstddef>
#include <vector>

namespace hapnet::scene {

/// A list with a bound that never takes memory after its construction: unlike a std::vector it
/// keeps its room when it is copied, so that the copy of a world may tick without allocating.
template <typename T>
class Reserved {
public:
    explicit Reserved(std::size_t room = 0) { values_.reserve(room); }
    Reserved(const Reserved& other)
    {
        values_.reserve(other.values_.capacity());
        values_ = other.values_;
    }
    Reserved(Reserved&&) noexcept = default;
    Reserved& operator=(const Reserved& other)
    {
        values_.reserve(other.values_.capacity());
        values_ = other.values_;
        return *this;
    }
    Reserved& operator=(Reserved&&) noexcept = default;
    ~Reserved() = default;

    [[nodiscard]] bool full() const { return values_.size() == values_.capacity(); }
    [[nodiscard]] bool empty() const { return values_.empty(); }
    [[nodiscard]] std::size_t size() const { return values_.size(); }
    /// Only while it is not full.
    void push_back(const T& value)
    {
        base::ensure(!full());
        values_.push_back(value);
    }
    void pop_back() { values_.pop_back(); }
    void clear() { values_.clear(); }
    /// Within its room.
    void resize(std::size_t size)
    {
        base::ensure(size <= values_.capacity());
        values_.resize(size);
    }

    [[nodiscard]] T& operator[](std::size_t i) { return values_[i]; }
    [[nodiscard]] const T& operator[](std::size_t i) const { return values_[i]; }
    [[nodiscard]] T& back() { return values_.back(); }
    [[nodiscard]] T* data() { return values_.data(); }
    [[nodiscard]] const T* data() const { return values_.data(); }
    [[nodiscard]] auto begin() { return values_.begin(); }
    [[nodiscard]] auto end() { return values_.end(); }
    [[nodiscard]] auto begin() const { return values_.begin(); }
    [[nodiscard]] auto end() const { return values_.end(); }

private:
    std::vector<T> values_;
};

} // namespace hapnet::scene
