// SPDX-FileCopyrightText: 2026 The Hapnet authors
// SPDX-License-Identifier: MIT
#pragma once

#include "proto/base/ensure.hpp"

#include <cstddef>
#include <memory>
#include <span>
#include <utility>
#include <vector>

namespace hapnet::scene {

/// A list with a bound that takes its memory at construction. A copy takes the same room at once,
/// unlike a copy of a vector after reserve(). So a copied world takes no memory in its ticks. Room
/// that was never used is neither touched nor copied.
template <typename T>
class Bounded {
public:
    Bounded() = default;
    explicit Bounded(std::size_t size_max) { elements_.reserve(size_max); }
    Bounded(const Bounded& other) { *this = other; }
    Bounded(Bounded&&) noexcept = default;
    Bounded& operator=(const Bounded& other)
    {
        if (this == &other) return *this;
        elements_.reserve(other.size_max());
        elements_ = other.elements_;
        return *this;
    }
    Bounded& operator=(Bounded&&) noexcept = default;
    ~Bounded() = default;

    /// Adds an element. Returns true if there was room for it.
    bool add(T element)
    {
        if (is_full()) return false;
        elements_.push_back(std::move(element));
        return true;
    }
    /// Removes an element and moves the last one into its place.
    void remove(std::size_t index)
    {
        base::ensure(index < size());
        elements_[index] = std::move(elements_.back());
        elements_.pop_back();
    }
    /// Removes the last element and returns it.
    T take_last()
    {
        base::ensure(!is_empty());
        T last = std::move(elements_.back());
        elements_.pop_back();
        return last;
    }
    /// Drops the elements beyond `size`, or adds default ones up to it.
    void resize(std::size_t size)
    {
        base::ensure(size <= size_max());
        elements_.resize(size);
    }
    void clear() { elements_.clear(); }

    [[nodiscard]] bool is_empty() const { return elements_.empty(); }
    [[nodiscard]] bool is_full() const { return size() == size_max(); }
    [[nodiscard]] std::size_t size() const { return elements_.size(); }
    [[nodiscard]] std::size_t size_max() const { return elements_.capacity(); }
    [[nodiscard]] T& operator[](std::size_t index) { return elements_[index]; }
    [[nodiscard]] const T& operator[](std::size_t index) const { return elements_[index]; }
    [[nodiscard]] std::span<const T> all() const { return elements_; }

    [[nodiscard]] T* begin() { return elements_.data(); }
    [[nodiscard]] T* end() { return elements_.data() + size(); }
    [[nodiscard]] const T* begin() const { return elements_.data(); }
    [[nodiscard]] const T* end() const { return elements_.data() + size(); }

private:
    std::vector<T> elements_;
};

/// A bounded list for data that live no longer than a tick. A copy has the room but not the
/// elements, so a snapshot does not pay for them. A new element keeps the value that its memory had
/// before.
template <typename T>
class Scratch {
public:
    Scratch() = default;
    explicit Scratch(std::size_t size_max) { elements_.reserve(size_max); }
    Scratch(const Scratch& other) { elements_.reserve(other.elements_.capacity()); }
    Scratch(Scratch&&) noexcept = default;
    Scratch& operator=(const Scratch& other)
    {
        if (this != &other) {
            size_ = 0;
            elements_.reserve(other.elements_.capacity());
        }
        return *this;
    }
    Scratch& operator=(Scratch&&) noexcept = default;
    ~Scratch() = default;

    [[nodiscard]] bool is_full() const { return size_ == elements_.capacity(); }
    /// Adds an element. It has the value that its memory held before.
    T& add()
    {
        if (elements_.data() + size_ == made()) elements_.emplace_back();
        return elements_[size_++];
    }
    void drop_last() { --size_; }
    void clear() { size_ = 0; }
    /// Sets the size, which is at most the reserved one.
    void resize(std::size_t size)
    {
        if (elements_.data() + size > made()) elements_.resize(size);
        size_ = size;
    }

    [[nodiscard]] std::size_t size() const { return size_; }
    [[nodiscard]] T& operator[](std::size_t index) { return elements_[index]; }
    [[nodiscard]] const T& operator[](std::size_t index) const { return elements_[index]; }
    [[nodiscard]] std::span<T> all() { return {elements_.data(), size_}; }
    [[nodiscard]] std::span<const T> all() const { return {elements_.data(), size_}; }

private:
    /// Returns the end of the constructed elements. Compare it as an address: a size would cost a
    /// division.
    [[nodiscard]] const T* made() const { return std::to_address(elements_.end()); }

    std::vector<T> elements_;
    std::size_t size_ = 0;
};

} // namespace hapnet::scene
