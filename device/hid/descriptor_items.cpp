// SPDX-FileCopyrightText: 2026 The Hapnet authors
// SPDX-License-Identifier: MIT
#include "device/hid/descriptor_items.hpp"

#include <array>

namespace hapnet::device::hid {

namespace {

constexpr std::uint32_t long_item_prefix = 0xfe;

ItemValue value_from(std::uint32_t bits, std::uint8_t size)
{
    ItemValue value{.as_signed = bits, .as_unsigned = bits};
    const std::int64_t range = std::int64_t{1} << (8U * size);
    if (size > 0 && value.as_signed >= range / 2) value.as_signed -= range;
    return value;
}

} // namespace

std::optional<Item> ItemReader::next()
{
    const std::size_t left = bytes_.size() - position_;
    if (left == 0) return std::nullopt;
    Item item{.at = position_};
    const std::uint32_t prefix = byte(position_);
    if (prefix == long_item_prefix) { // length, tag and data follow
        if (left < 3 || left < 3 + byte(position_ + 1)) return std::nullopt;
        item.type = ItemType::long_item;
        position_ += 3 + byte(position_ + 1);
        return item;
    }
    constexpr std::array<std::uint8_t, 4> sizes{0, 1, 2, 4};
    item.size = sizes[prefix & 3U];
    item.type = static_cast<ItemType>((prefix >> 2U) & 3U);
    item.tag = static_cast<std::uint8_t>(prefix >> 4U);
    if (left < 1U + item.size) return std::nullopt;
    std::uint32_t bits = 0;
    for (std::size_t i = 0; i < item.size; ++i) {
        bits |= byte(position_ + 1 + i) << (8U * i);
    }
    item.value = value_from(bits, item.size);
    position_ += 1U + item.size;
    return item;
}

} // namespace hapnet::device::hid
