// SPDX-FileCopyrightText: 2026 The Hapnet authors
// SPDX-License-Identifier: MIT
#include "proto/base/bytes.hpp"

#include <array>
#include <cmath>
#include <gtest/gtest.h>
#include <limits>
#include <tuple>
#include <vector>

namespace hapnet::base {
namespace {

std::vector<int> numbers(std::span<const std::byte> bytes)
{
    std::vector<int> values;
    for (const std::byte b : bytes) values.push_back(std::to_integer<int>(b));
    return values;
}

TEST(Bytes, AreLittleEndianWhateverTheMachine)
{
    std::array<std::byte, 32> buffer{};
    ByteWriter out{buffer};
    out.u8(0x01);
    out.u16(0x0302);
    out.u32(0x07060504);
    out.u64(0x0f0e0d0c0b0a0908);
    out.i64(-2);
    EXPECT_EQ(numbers(out.written()),
              (std::vector{1,  2,  3,  4,   5,   6,   7,   8,   9,   10,  11, 12,
                           13, 14, 15, 254, 255, 255, 255, 255, 255, 255, 255}));
}

TEST(Bytes, FloatsAreTheirIeeeBits)
{
    std::array<std::byte, 12> buffer{};
    ByteWriter out{buffer};
    out.f32(1.0F);
    out.f64(-2.0);
    EXPECT_EQ(numbers(out.written()), (std::vector{0, 0, 0x80, 0x3f, 0, 0, 0, 0, 0, 0, 0, 0xc0}));
}

TEST(Bytes, WhatWasWrittenIsReadBack)
{
    std::array<std::byte, 64> buffer{};
    ByteWriter out{buffer};
    out.u8(255);
    out.u16(65535);
    out.u32(4'000'000'000);
    out.u64(std::numeric_limits<std::uint64_t>::max());
    out.i64(std::numeric_limits<std::int64_t>::min());
    out.f32(std::numeric_limits<float>::denorm_min());
    out.f64(-0.0);
    const std::array tail{std::byte{7}, std::byte{9}};
    out.raw(tail);

    ByteReader in{out.written()};
    EXPECT_EQ(in.u8(), 255);
    EXPECT_EQ(in.u16(), 65535);
    EXPECT_EQ(in.u32(), 4'000'000'000);
    EXPECT_EQ(in.u64(), std::numeric_limits<std::uint64_t>::max());
    EXPECT_EQ(in.i64(), std::numeric_limits<std::int64_t>::min());
    EXPECT_EQ(in.f32(), std::numeric_limits<float>::denorm_min());
    EXPECT_TRUE(std::signbit(in.f64()));
    EXPECT_FALSE(in.complete());
    EXPECT_EQ(numbers(in.raw(2)), (std::vector{7, 9}));
    EXPECT_TRUE(in.complete());
}

TEST(Bytes, RunningShortIsRememberedAndGivesZeros)
{
    const std::array three{std::byte{1}, std::byte{2}, std::byte{3}};
    ByteReader in{three};
    EXPECT_EQ(in.u32(), 0U);
    EXPECT_FALSE(in.ok());
    EXPECT_EQ(in.u8(), 0U); // although three bytes are left
    EXPECT_TRUE(in.raw(1).empty());
    EXPECT_FALSE(in.ok());
    EXPECT_FALSE(in.complete());
}

TEST(Bytes, ALeftOverByteIsNotComplete)
{
    const std::array two{std::byte{1}, std::byte{2}};
    ByteReader in{two};
    EXPECT_EQ(in.u8(), 1U);
    EXPECT_TRUE(in.ok());
    EXPECT_FALSE(in.complete());
}

TEST(Bytes, NothingIsCompletelyRead) { EXPECT_TRUE(ByteReader{{}}.complete()); }

TEST(Bytes, AnAbsurdCountIsRunningShortAndNotAnOverflow)
{
    const std::array two{std::byte{1}, std::byte{2}};
    ByteReader in{two};
    std::ignore = in.u8();
    EXPECT_TRUE(in.raw(std::numeric_limits<std::size_t>::max()).empty());
    EXPECT_FALSE(in.ok());
}

TEST(BytesDeathTest, WritingPastTheEndIsOurMistakeAndStopsTheProgram)
{
    std::array<std::byte, 3> buffer{};
    ByteWriter out{buffer};
    out.u16(1);
    EXPECT_DEATH(out.u16(2), "must never happen");
}

} // namespace
} // namespace hapnet::base
