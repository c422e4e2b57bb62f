// SPDX-FileCopyrightText: 2026 The Hapnet authors
// SPDX-License-Identifier: MIT
#include "device/hid/field.hpp"

#include "proto/base/ensure.hpp"

#include <algorithm>
#include <cmath>

namespace hapnet::device::hid {

namespace {

bool reaches(std::span<const std::byte> data, const Field& field)
{
    return std::uint64_t{field.bit_offset} + field.bit_size <= 8 * std::uint64_t{data.size()};
}

} // namespace

std::optional<std::int64_t> unpack(const Field& field, std::span<const std::byte> data)
{
    if (!reaches(data, field)) return std::nullopt;
    std::int64_t value = 0;
    for (std::uint32_t i = 0; i < field.bit_size; ++i) {
        const std::uint32_t bit = field.bit_offset + i;
        const auto byte = std::to_integer<std::uint32_t>(data[bit / 8]);
        value |= static_cast<std::int64_t>((byte >> (bit % 8)) & 1U) << i;
    }
    const std::int64_t range = std::int64_t{1} << field.bit_size;
    if (field.logical_min < 0 && value >= range / 2) value -= range;
    if (value < field.logical_min || value > field.logical_max) return std::nullopt;
    return value;
}

void pack(const Field& field, std::int64_t value, std::span<std::byte> data)
{
    base::ensure(value >= field.logical_min && value <= field.logical_max);
    pack_bits(field, static_cast<std::uint32_t>(value), data);
}

void pack_bits(const Field& field, std::uint32_t bits, std::span<std::byte> data)
{
    base::ensure(reaches(data, field));
    for (std::uint32_t i = 0; i < field.bit_size; ++i) {
        const std::uint32_t bit = field.bit_offset + i;
        const std::byte mask{static_cast<unsigned char>(1U << (bit % 8))};
        std::byte& byte = data[bit / 8];
        byte = ((bits >> i) & 1U) != 0 ? byte | mask : byte & ~mask;
    }
}

std::int64_t scaled(const Field& field, double share)
{
    if (!std::isfinite(share)) return 0;
    const auto most = static_cast<double>(field.logical_max);
    const double least = std::max(static_cast<double>(field.logical_min), -most);
    return std::llround(std::clamp(share * most, least, most));
}

double share_of(const Field& field, std::int64_t value)
{
    const auto from = static_cast<double>(field.logical_min);
    const auto to = static_cast<double>(field.logical_max);
    return to > from ? 2.0 * (static_cast<double>(value) - from) / (to - from) - 1.0 : 0.0;
}

} // namespace hapnet::device::hid
