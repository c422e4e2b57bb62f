// SPDX-FileCopyrightText: 2026 The Hapnet authors
// SPDX-License-Identifier: MIT
#pragma once

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>
#include <span>

namespace hapnet::secure {

/// A bounded queue, served in the order of numbers that its user draws at random, the highest
/// first. When it is full, the item with the lowest number is lost. A flood of items so lowers the
/// chance of each item by as much, whenever each comes. Items are small values.
template <typename Item, std::size_t room>
class FairQueue {
public:
    /// Returns whether there was room; otherwise this item or another one is lost.
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
    /// Takes the item that is next; the queue is not empty.
    [[nodiscard]] Item take()
    {
        Numbered& next = *std::ranges::max_element(waiting(), {}, &Numbered::number);
        const Item item = next.item;
        next = all_[--size_];
        return item;
    }
    /// The first item of which `is_it` holds; nullptr when there is none.
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
