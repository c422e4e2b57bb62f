// SPDX-FileCopyrightText: 2026 The Hapnet authors
// SPDX-License-Identifier: MIT
#pragma once

#include "proto/base/ensure.hpp"

#include <array>
#include <cstddef>
#include <memory>
#include <new>
#include <span>
#include <type_traits>

namespace hapnet::base {

/// A vector of bounded length without heap memory, like std::inplace_vector of C++26. The unused
/// part is never written, because filling the array with zeros may cost more than all work on the
/// few elements that are added.
template <typename T, std::size_t size_most>
class InplaceVector {
    static_assert(std::is_trivially_copyable_v<T> && std::is_trivially_destructible_v<T>);

public:
    InplaceVector() {} // NOLINT(*-member-init, modernize-use-equals-default): see above

    /// Appends an element. Ensures that there is room for it.
    void push_back(const T& value)
    {
        ensure(!full());
        std::construct_at(data() + size_, value);
        ++size_;
    }
    void clear() { size_ = 0; }

    [[nodiscard]] std::size_t size() const { return size_; }
    [[nodiscard]] bool empty() const { return size_ == 0; }
    [[nodiscard]] bool full() const { return size_ == size_most; }
    [[nodiscard]] std::span<const T> all() const { return {data(), size_}; }
    [[nodiscard]] const T& operator[](std::size_t place) const { return data()[place]; }

private:
    // NOLINTBEGIN(*-reinterpret-cast): bytes in which objects have been constructed
    [[nodiscard]] T* data() { return std::launder(reinterpret_cast<T*>(room_.data())); }
    [[nodiscard]] const T* data() const
    {
        return std::launder(reinterpret_cast<const T*>(room_.data()));
    }
    // NOLINTEND(*-reinterpret-cast)

    std::size_t size_ = 0;
    alignas(T) std::array<std::byte, size_most * sizeof(T)> room_;
};

} // namespace hapnet::base
