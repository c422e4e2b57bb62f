// SPDX-FileCopyrightText: 2026 The Hapnet authors
// SPDX-License-Identifier: MIT
#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <span>

namespace hapnet::device::hid {

/// The value of an item, read as signed and as unsigned. The item's tag determines which of them is
/// valid.
struct ItemValue {
    std::int64_t as_signed = 0;
    std::int64_t as_unsigned = 0;
};

enum class ItemType : std::uint8_t { main, global, local, reserved, long_item };

/// One item of a report descriptor.
struct Item {
    std::size_t at = 0; // place of the first byte in the descriptor
    ItemType type = ItemType::main;
    std::uint8_t tag = 0;
    std::uint8_t size = 0; // bytes of the value; 0 for a long item, whose data are skipped
    ItemValue value{};
};

/// Splits a report descriptor into its items: USB Device Class Definition for HID 1.11, 6.2.2.2 and
/// 6.2.2.3.
class ItemReader {
public:
    explicit ItemReader(std::span<const std::byte> bytes) : bytes_{bytes} {}

    /// Returns the next item; nullopt at the end, or where an item is truncated.
    [[nodiscard]] std::optional<Item> next();
    /// True if the last next() reached the end of the descriptor, false if an item was truncated.
    [[nodiscard]] bool is_complete() const { return position_ == bytes_.size(); }

private:
    [[nodiscard]] std::uint32_t byte(std::size_t at) const
    {
        return std::to_integer<std::uint32_t>(bytes_[at]);
    }

    std::span<const std::byte> bytes_;
    std::size_t position_ = 0;
};

} // namespace hapnet::device::hid
