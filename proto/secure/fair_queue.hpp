// SPDX-FileCopyrightText: 2026 The Hapnet authors
// SPDX-License-Identifier: MIT
#pragma once

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>
#include <span>

namespace hapnet::secure {

/// A bounded queue that serves items in descending order of numbers, which the caller draws at
/// random. If it is full, the item with the lowest number is lost. So a flood of items reduces the
/// chance of every item equally, whatever its time of arrival. Items are small values.
template <typename Item, std::size_t room>
class FairQueue {
public:
    /// Adds an item. Returns false if the queue was full, so that this item or another one is lost.
    bool add(const Item& item, std::uint32_t number)
    {
        if (size_ < room) {
            all_[size_++] = {item, number};
            return true;
        }
        Numbered& lowest = *std::ranges::min_element(all_, {}, &Numbered::number);
        if (lowest.number < number) lowest = {item, number};
        return false;
    }
    /// Removes and returns the item with the highest number. The queue must not be empty.
    [[nodiscard]] Item take()
    {
        Numbered& next = *std::ranges::max_element(waiting(), {}, &Numbered::number);
        const Item item = next.item;
        next = all_[--size_];
        return item;
    }
    /// Returns an item for which `is_it` is true; nullptr if there is none.
    template <typename Predicate>
    [[nodiscard]] Item* find(Predicate is_it)
    {
        const std::span<Numbered> all = waiting();
        const auto found = std::ranges::find_if(all, is_it, &Numbered::item);
        return found == all.end() ? nullptr : &found->item;
    }
    void clear() { size_ = 0; }
    [[nodiscard]] std::size_t size() const { return size_; }
    [[nodiscard]] bool is_empty() const { return size_ == 0; }

private:
    struct Numbered {
        Item item{};
        std::uint32_t number = 0;
    };

    [[nodiscard]] std::span<Numbered> waiting() { return std::span{all_}.first(size_); }

    std::array<Numbered, room> all_{};
    std::size_t size_ = 0;
};

} // namespace hapnet::secure
