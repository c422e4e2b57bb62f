// SPDX-FileCopyrightText: 2026 The Hapnet authors
// SPDX-License-Identifier: MIT
#include "proto/secure/frames.hpp"

#include "proto/base/bytes.hpp"
#include "tests/unit/proto/secure/circle.hpp"

#include <gtest/gtest.h>

namespace hapnet::secure {

namespace {

using circle::hello;
using circle::secret_of;
using circle::state;

Text sealed_of(const Text& plain, Sealer& sealer, std::uint32_t number = 1)
{
    Text room = plain;
    room.resize(plain.size() + control_overhead);
    const auto size = seal_frame(room, plain.size(), 0x01020304, number, sealer);
    if (!size) return {};
    room.resize(*size);
    return room;
}

} // namespace

TEST(Frames, KeepTheHeadOfAStateReadable)
{
    Sealer sealer{secret_of(1)};
    const Text plain = state(77, 5);
    const Text sealed = sealed_of(plain, sealer);
    ASSERT_EQ(sealed.size(), plain.size() + 16);
    EXPECT_EQ(to_hex(Bytes{sealed}.first(20)),
              "484e0282"         // magic, version 2, a state, sealed
              "04030201"         // the key
              "05000000"         // the sequence
              "404b4c0000000000" // 5 ms
    );
    EXPECT_EQ(key_of(sealed), 0x01020304U);
}

TEST(Frames, GiveBackWhatWasSealedWithoutItsSession)
{
    for (const bool is_state : {true, false}) {
        Sealer sealer{secret_of(1)};
        Opener opener{secret_of(1)};
        Text plain = is_state ? state(77, 5) : hello(3);
        Text sealed = sealed_of(plain, sealer);
        const OpenedFrame opened = open_frame(sealed, opener);
        EXPECT_EQ(opened.outcome, Opener::Outcome::opened_newest);
        EXPECT_EQ(opened.is_state, is_state);
        ASSERT_EQ(opened.size, plain.size());
        sealed.resize(opened.size);
        std::fill_n(plain.begin() + 4, 4, std::byte{0});
        EXPECT_EQ(to_hex(sealed), to_hex(plain));
    }
}

TEST(Frames, OpenNothingWithAnyByteChangedOrMissingOrAdded)
{
    for (const bool is_state : {true, false}) {
        Sealer sealer{secret_of(1)};
        const Text sealed = sealed_of(is_state ? state(77, 5) : hello(3), sealer);
        const auto opens = [](Text bytes) {
            Opener opener{secret_of(1)};
            return key_of(bytes) && open_frame(bytes, opener).size != 0;
        };
        ASSERT_TRUE(opens(sealed));
        for (std::size_t i = 0; i < sealed.size(); ++i) {
            for (const int bit : {0, 3, 7}) {
                Text other = sealed;
                other[i] ^= std::byte{1} << bit;
                EXPECT_FALSE(opens(other)) << "byte " << i << ", bit " << bit;
            }
        }
        for (std::size_t size = 0; size < sealed.size() + 40; ++size) {
            if (size == sealed.size()) continue;
            Text other = sealed;
            other.resize(size);
            EXPECT_FALSE(opens(other)) << size << " bytes";
        }
    }
}

TEST(Frames, SealNoOtherMessage)
{
    Sealer sealer{secret_of(1)};
    EXPECT_TRUE(sealed_of(Text(7), sealer).empty());
    Text other = hello();
    other[3] = std::byte{4};
    EXPECT_TRUE(sealed_of(other, sealer).empty());
    Text short_state = state(1, 1);
    short_state.resize(19);
    EXPECT_TRUE(sealed_of(short_state, sealer).empty());
}

TEST(Frames, AreNamedByTheirFourthByte)
{
    EXPECT_EQ(frame_type_of(from_hex("484e0288")), FrameType::initiation);
    EXPECT_EQ(frame_type_of(from_hex("484e0202")), std::nullopt); // plain
    EXPECT_EQ(frame_type_of(from_hex("484e0188")), std::nullopt); // version 1
    EXPECT_EQ(frame_type_of(from_hex("484f0288")), std::nullopt);
    EXPECT_EQ(frame_type_of(from_hex("484e028b")), std::nullopt);
    EXPECT_EQ(frame_type_of(from_hex("484e02")), std::nullopt);
    EXPECT_EQ(key_of(from_hex("484e0282")), std::nullopt);
}

TEST(Frames, OfHandshakesAreReadAsTheyWereWritten)
{
    const Text noise1(64, std::byte{1}), noise2(52, std::byte{2}), sealed(32, std::byte{3});
    HandshakeFrame initiation = HandshakeFrame::initiation(7, {1, 2}, noise1);
    initiation.set_macs(from_hex("00112233445566778899aabbccddeeff"), Mac{});
    const auto one = read_initiation(initiation.bytes());
    ASSERT_TRUE(one);
    EXPECT_EQ(one->sender, 7U);
    EXPECT_EQ(one->ends, (Ends{1, 2}));
    EXPECT_EQ(to_hex(one->noise), to_hex(noise1));
    EXPECT_EQ(to_hex(one->macs.mac1), to_hex(initiation.mac1()));
    EXPECT_NE(to_hex(one->macs.mac2), std::string(32, '0'));

    const HandshakeFrame response = HandshakeFrame::response(7, 8, noise2);
    const auto two = read_response(response.bytes());
    ASSERT_TRUE(two);
    EXPECT_EQ(two->receiver, 7U);
    EXPECT_EQ(two->sender, 8U);
    EXPECT_EQ(to_hex(two->noise), to_hex(noise2));
    EXPECT_EQ(to_hex(two->macs.mac2), std::string(32, '0'));

    WideNonce nonce{};
    nonce.fill(std::byte{9});
    const HandshakeFrame cookie = HandshakeFrame::cookie(7, nonce, sealed);
    const auto three = read_cookie_reply(cookie.bytes());
    ASSERT_TRUE(three);
    EXPECT_EQ(three->receiver, 7U);
    EXPECT_EQ(three->nonce, nonce);
    EXPECT_EQ(to_hex(three->sealed), to_hex(sealed));

    EXPECT_EQ(initiation.bytes().size(), 108U);
    EXPECT_EQ(response.bytes().size(), 96U);
    EXPECT_EQ(cookie.bytes().size(), 64U);
    EXPECT_FALSE(read_initiation(response.bytes()));
    EXPECT_FALSE(read_response(cookie.bytes()));
    EXPECT_FALSE(read_cookie_reply(initiation.bytes()));
}

} // namespace hapnet::secure
