// SPDX-FileCopyrightText: 2026 The Hapnet authors
// SPDX-License-Identifier: MIT
#include "proto/record/codec.hpp"

#include "proto/base/random.hpp"
#include "proto/record/fields.hpp"
#include "tests/property/proto/record/random_fields.hpp"

#include <algorithm>
#include <cstddef>
#include <gtest/gtest.h>

namespace hapnet::record {
namespace {

constexpr std::uint64_t rounds = 20'000;

template <typename R>
void expect_round_trips(std::string_view stream)
{
    for (std::uint64_t round = 0; round < rounds; ++round) {
        R row;
        for_each_field(row, RandomFields{base::Seed{1}.stream(stream), round});
        const auto layout = Layout{}.with_bodies();
        const auto again = decode(encode(row, layout), layout);
        ASSERT_TRUE(again) << again.error().message << ", round " << round;
        ASSERT_EQ(*again, Row{row}) << "round " << round;
    }
}

TEST(RecordCodec, GivesBackEveryTickRow) { expect_round_trips<TickRow>("tick"); }
TEST(RecordCodec, GivesBackEveryMessageRow) { expect_round_trips<MessageRow>("message"); }
TEST(RecordCodec, GivesBackEverySessionRow) { expect_round_trips<SessionRow>("session"); }
TEST(RecordCodec, GivesBackEveryBodyRow) { expect_round_trips<BodyRow>("body"); }

// Random bytes are almost never a row, so most of each block is made plausible: a known kind,
// often small bytes, often zero padding.
TEST(RecordCodec, AcceptsOnlyBytesThatItWouldWriteItself)
{
    const auto stream = base::Seed{2}.stream("bytes");
    const auto layout = Layout::for_messages_of(160).with_bodies();
    std::uint64_t accepted = 0;
    for (std::uint64_t round = 0; round < rounds; ++round) {
        std::uint32_t draw = 0;
        const auto kind = static_cast<std::byte>(stream.below(5, round, draw++));
        RowBytes bytes(layout.bytes_of(kind).value_or(row_bytes));
        const auto modulus = 1 + stream.below(3, round, draw++);
        for (std::byte& b : bytes)
            b = static_cast<std::byte>(stream.below(256, round, draw++) % modulus);
        bytes[0] = kind;
        const auto used = stream.below(static_cast<std::uint32_t>(bytes.size()), round, draw++);
        std::fill(bytes.begin() + static_cast<std::ptrdiff_t>(used), bytes.end(), std::byte{0});
        const auto row = decode(bytes, layout);
        if (!row) continue;
        ++accepted;
        ASSERT_EQ(encode(*row, layout), bytes) << "round " << round;
    }
    EXPECT_GT(accepted, rounds / 10);
    EXPECT_LT(accepted, rounds);
}

TEST(RecordCodec, AcceptsOnlyBytesThatItWouldWriteItselfAfterOneByteOfARowChanged)
{
    const auto stream = base::Seed{3}.stream("mutations");
    for (std::uint64_t round = 0; round < rounds; ++round) {
        TickRow row;
        for_each_field(row, RandomFields{base::Seed{3}.stream("tick"), round});
        RowBytes bytes = encode(row);
        bytes.at(stream.below(row_bytes, round, 0)) =
            static_cast<std::byte>(stream.bits(round, 1) & 0xff);
        const auto changed = decode(bytes);
        if (changed) {
            ASSERT_EQ(encode(*changed), bytes) << "round " << round;
        }
    }
}

} // namespace
} // namespace hapnet::record
