// SPDX-FileCopyrightText: 2026 The Hapnet authors
// SPDX-License-Identifier: MIT
#pragma once

#include <cstddef>
#include <span>
#include <vector>

namespace hapnet::scene {

/// Room for what lives no longer than a tick. The memory is reserved at construction and by a
/// copy, which has the room but not what is in it; elements are used again as they are.
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
    /// Another element, with whatever it held before.
    T& add()
    {
        if (size_ == elements_.size()) elements_.emplace_back();
        return elements_[size_++];
    }
    void take_back() { --size_; }
    void clear() { size_ = 0; }
    /// At most what was reserved.
    void resize(std::size_t size)
    {
        if (size > elements_.size()) elements_.resize(size);
        size_ = size;
    }

    [[nodiscard]] std::size_t size() const { return size_; }
    [[nodiscard]] T& operator[](std::size_t index) { return elements_[index]; }
    [[nodiscard]] const T& operator[](std::size_t index) const { return elements_[index]; }
    [[nodiscard]] std::span<T> all() { return {elements_.data(), size_}; }
    [[nodiscard]] std::span<const T> all() const { return {elements_.data(), size_}; }

private:
    std::vector<T> elements_;
    std::size_t size_ = 0;
};

} // namespace hapnet::scene
