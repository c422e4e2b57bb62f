// SPDX-FileCopyrightText: 2026 The Hapnet authors
// SPDX-License-Identifier: MIT
#pragma once

#include "proto/base/ensure.hpp"

#include <cstddef>
#include <span>
#include <utility>
#include <vector>

namespace hapnet::scene {

/// A list of at most so many elements, for which the memory is taken at construction. Unlike a
/// vector's reserve, that holds for copies too: a copied world takes no memory in its ticks.
template <typename T>
class Bounded {
public:
    Bounded() = default;
    explicit Bounded(std::size_t size_max) : elements_(size_max) {}

    /// Whether there was room.
    bool add(T element)
    {
        if (size_ == elements_.size()) return false;
        elements_[size_++] = std::move(element);
        return true;
    }
    /// Puts the last one in the place of the one that goes.
    void remove(std::size_t index)
    {
        base::ensure(index < size_);
        elements_[index] = std::move(elements_[--size_]);
    }
    void clear() { size_ = 0; }

    [[nodiscard]] bool is_empty() const { return size_ == 0; }
    [[nodiscard]] std::size_t size() const { return size_; }
    [[nodiscard]] std::size_t size_max() const { return elements_.size(); }
    [[nodiscard]] T& operator[](std::size_t index) { return elements_[index]; }
    [[nodiscard]] const T& operator[](std::size_t index) const { return elements_[index]; }

    [[nodiscard]] T* begin() { return elements_.data(); }
    [[nodiscard]] T* end() { return elements_.data() + size_; }
    [[nodiscard]] const T* begin() const { return elements_.data(); }
    [[nodiscard]] const T* end() const { return elements_.data() + size_; }

private:
    std::vector<T> elements_;
    std::size_t size_ = 0;
};

} // namespace hapnet::scene
