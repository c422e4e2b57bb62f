// SPDX-FileCopyrightText: 2026 The Hapnet authors
// SPDX-License-Identifier: MIT
#pragma once

#include "proto/base/formats.hpp"

#include <cstddef>
#include <initializer_list>
#include <memory>
#include <string>
#include <utility>
#include <vector>

namespace hapnet::base {

/// A vector whose elements never change and are shared by its copies, so that copying is cheap
/// whatever the number of elements. Two are equal if their elements are.
template <typename T>
class SharedVector {
public:
    SharedVector() = default;
    // Implicit, so that a struct with a SharedVector can be initialised with a vector.
    SharedVector(std::vector<T> elements) // NOLINT(google-explicit-constructor)
        : elements_{std::make_shared<const std::vector<T>>(std::move(elements))}
    {}
    SharedVector(std::initializer_list<T> elements) : SharedVector{std::vector<T>(elements)} {}

    [[nodiscard]] auto begin() const { return get().begin(); }
    [[nodiscard]] auto end() const { return get().end(); }
    [[nodiscard]] std::size_t size() const { return get().size(); }
    [[nodiscard]] bool empty() const { return get().empty(); }
    /// Returns an element; `index` must be below size().
    [[nodiscard]] decltype(auto) operator[](std::size_t index) const { return get()[index]; }

    /// Returns all elements.
    [[nodiscard]] const std::vector<T>& get() const
    {
        static const std::vector<T> none;
        return elements_ ? *elements_ : none;
    }

    friend bool operator==(const SharedVector& a, const SharedVector& b)
    {
        return a.elements_ == b.elements_ || a.get() == b.get();
    }

private:
    std::shared_ptr<const std::vector<T>> elements_; // nullptr: no elements
};

/// The format of a SharedVector, which is that of a vector.
template <typename Format>
struct InShared {
    Format format;

    template <typename T>
    void read(const Node& node, SharedVector<T>& target, Reading& reading) const
    {
        std::vector<T> elements;
        format.read(node, elements, reading);
        if (reading.is_good()) target = std::move(elements);
    }
    template <typename T>
    [[nodiscard]] std::string print(const SharedVector<T>& value) const
    {
        return format.print(value.get());
    }
    [[nodiscard]] std::string describe() const { return format.describe(); }
};

template <typename T>
struct UsualFormat<SharedVector<T>> : InShared<UsualFormat<std::vector<T>>> {};

} // namespace hapnet::base
