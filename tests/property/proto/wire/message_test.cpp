// SPDX-FileCopyrightText: 2026 The Hapnet authors
// SPDX-License-Identifier: MIT
#include "proto/wire/message.hpp"

#include "tests/property/proto/wire/random_message.hpp"

#include <algorithm>
#include <gtest/gtest.h>
#include <vector>

namespace hapnet::wire {
namespace {

constexpr std::uint64_t rounds = 20'000;

using Bytes = std::vector<std::byte>;

Bytes bytes_of(const Message& message)
{
    const Datagram datagram = encode(message);
    return {datagram.bytes().begin(), datagram.bytes().end()};
}

TEST(WireMessages, AreDecodedToWhatWasEncoded)
{
    for (std::uint64_t round = 0; round < rounds; ++round) {
        const Message message = RandomMessage{base::Seed{1}.stream("message"), round}.message();
        const auto again = decode(encode(message).bytes());
        ASSERT_TRUE(again) << again.error().message << ", round " << round;
        ASSERT_EQ(*again, message) << "round " << round;
    }
}

TEST(WireMessages, OfMutatedBytesAreRefusedOrAreTheOnesThatThoseBytesMean)
{
    const auto stream = base::Seed{2}.stream("mutations");
    std::uint64_t accepted = 0;
    for (std::uint64_t round = 0; round < rounds; ++round) {
        Bytes bytes = bytes_of(RandomMessage{base::Seed{2}.stream("message"), round}.message());
        const std::uint64_t changes = 1 + stream.below(3, round, 0);
        for (std::uint32_t i = 1; i <= changes; ++i) {
            const auto at = stream.below(static_cast<std::uint32_t>(bytes.size()), round, 2 * i);
            bytes[at] = static_cast<std::byte>(stream.bits(round, 2 * i + 1) & 0xffU);
        }
        const auto message = decode(bytes);
        if (!message) continue;
        ++accepted;
        ASSERT_EQ(bytes_of(*message), bytes) << "round " << round;
    }
    EXPECT_GT(accepted, rounds / 4); // the property was tested on many messages
    EXPECT_LT(accepted, rounds);
}

// Random bytes are almost never a message: the header and the length are made likely, and many
// bytes zero.
TEST(WireMessages, OfRandomBytesAreRefusedOrAreTheOnesThatThoseBytesMean)
{
    constexpr std::array<std::size_t, 4> sizes{117, 86, 136, 9};
    constexpr std::array<int, 4> types{1, 2, 2, 3};
    const auto stream = base::Seed{3}.stream("bytes");
    std::uint64_t accepted = 0;
    for (std::uint64_t round = 0; round < rounds; ++round) {
        const auto kind = stream.below(4, round, 0);
        Bytes bytes(sizes[kind]);
        const auto used = stream.below(static_cast<std::uint32_t>(sizes[kind]), round, 1);
        for (std::uint32_t i = 0; i < used; ++i) {
            bytes[i] = static_cast<std::byte>(stream.bits(round, i + 2) & 0x0fU);
        }
        bytes[0] = std::byte{'H'};
        bytes[1] = std::byte{'N'};
        bytes[2] = std::byte{protocol_version};
        bytes[3] = static_cast<std::byte>(types[kind]);
        const auto message = decode(bytes);
        if (!message) continue;
        ++accepted;
        ASSERT_EQ(bytes_of(*message), bytes) << "round " << round;
    }
    EXPECT_GT(accepted, rounds / 100);
    EXPECT_LT(accepted, rounds);
}

TEST(WireMessages, AreNotFoundInNoise)
{
    const auto stream = base::Seed{4}.stream("noise");
    for (std::uint64_t round = 0; round < rounds; ++round) {
        Bytes bytes(stream.below(200, round, 0));
        for (std::uint32_t i = 0; i < bytes.size(); ++i) {
            bytes[i] = static_cast<std::byte>(stream.bits(round, i + 1) & 0xffU);
        }
        ASSERT_FALSE(decode(bytes)) << "round " << round;
    }
}

} // namespace
} // namespace hapnet::wire
