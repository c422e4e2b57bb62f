// SPDX-FileCopyrightText: 2026 The Hapnet authors
// SPDX-License-Identifier: MIT
#include "device/hid/field.hpp"
#include "proto/base/random.hpp"

#include <algorithm>
#include <array>
#include <gtest/gtest.h>
#include <limits>
#include <string_view>

namespace hapnet::device::hid {
namespace {

/// Draws one value after the other.
class Draws {
public:
    explicit Draws(std::string_view name) : stream_{base::Seed{42}.stream(name)} {}

    std::int64_t below(std::int64_t end)
    {
        const std::uint64_t bits = stream_.bits(index_++);
        return static_cast<std::int64_t>(bits % static_cast<std::uint64_t>(end));
    }
    double uniform() { return stream_.uniform(index_++); }

private:
    base::RandomStream stream_;
    std::uint64_t index_ = 0;
};

/// A field anywhere in 16 bytes, of any length and any range that fits.
Field any_field(Draws& draws)
{
    Field field;
    field.bit_size = 1 + static_cast<std::uint32_t>(draws.below(32));
    field.bit_offset = static_cast<std::uint32_t>(draws.below(129 - field.bit_size));
    const std::int64_t values = std::int64_t{1} << field.bit_size;
    const bool is_signed = field.bit_size > 1 && draws.below(2) == 0;
    const std::int64_t low = is_signed ? -values / 2 : 0;
    const auto a = low + draws.below(values);
    const auto b = low + draws.below(values);
    field.logical_min = is_signed ? std::min({a, b, std::int64_t{-1}}) : std::min(a, b);
    field.logical_max = std::max(a, b);
    return field;
}

std::int64_t any_value(const Field& field, Draws& draws)
{
    return field.logical_min + draws.below(field.logical_max - field.logical_min + 1);
}

TEST(Field, IsReadAsItWasWrittenAndChangesNoOtherBit)
{
    Draws draws{"fields"};
    for (int i = 0; i < 20000; ++i) {
        const Field field = any_field(draws);
        std::array<std::byte, 16> data{};
        for (std::byte& byte : data) byte = static_cast<std::byte>(draws.below(256));
        auto other = data;
        const std::int64_t value = any_value(field, draws);
        pack(field, value, data);
        ASSERT_EQ(unpack(field, data), value) << i;
        for (std::uint32_t bit = 0; bit < 128; ++bit) {
            if (bit >= field.bit_offset && bit < field.bit_offset + field.bit_size) continue;
            const std::byte mask{static_cast<unsigned char>(1U << (bit % 8))};
            ASSERT_EQ(data[bit / 8] & mask, other[bit / 8] & mask) << i;
        }
        const std::size_t needed = (field.bit_offset + field.bit_size + 7) / 8;
        ASSERT_EQ(unpack(field, std::span{data}.first(needed - 1)), std::nullopt) << i;
    }
}

TEST(Field, GivesNoValueOutsideItsLogicalRange)
{
    const Field field{.bit_size = 8, .logical_min = -100, .logical_max = 100};
    for (int bits = 0; bits < 256; ++bits) {
        const std::array data{static_cast<std::byte>(bits)};
        const int value = bits < 128 ? bits : bits - 256;
        const bool is_inside = value >= -100 && value <= 100;
        EXPECT_EQ(unpack(field, data).has_value(), is_inside) << value;
    }
}

TEST(Field, ScalesSharesToWholeValuesAroundZeroAndLimitsThem)
{
    const Field field{.bit_size = 16, .logical_min = -32768, .logical_max = 32767};
    EXPECT_EQ(scaled(field, 0.0), 0);
    EXPECT_EQ(scaled(field, 1.0), 32767);
    EXPECT_EQ(scaled(field, -1.0), -32767);
    EXPECT_EQ(scaled(field, 1e300), 32767);
    EXPECT_EQ(scaled(field, std::numeric_limits<double>::quiet_NaN()), 0);
    EXPECT_EQ(scaled({.bit_size = 8, .logical_min = -10, .logical_max = 100}, -1.0), -10);
    Draws draws{"shares"};
    for (int i = 0; i < 10000; ++i) {
        const double share = 2.0 * draws.uniform() - 1.0;
        // Within half a step, due to rounding.
        ASSERT_NEAR(static_cast<double>(scaled(field, share)) / 32767, share, 0.5 / 32767 + 1e-12);
    }
}

TEST(Field, SaysWhereInItsRangeAValueLies)
{
    const Field field{.bit_size = 16, .logical_min = 0, .logical_max = 65535};
    EXPECT_EQ(share_of(field, 0), -1.0);
    EXPECT_EQ(share_of(field, 65535), 1.0);
    EXPECT_EQ(share_of({.logical_min = -127, .logical_max = 127}, 0), 0.0);
    EXPECT_EQ(share_of({.logical_min = 3, .logical_max = 3}, 3), 0.0);
}

} // namespace
} // namespace hapnet::device::hid
