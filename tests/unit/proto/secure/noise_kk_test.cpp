// SPDX-FileCopyrightText: 2026 The Hapnet authors
// SPDX-License-Identifier: MIT
#include "proto/secure/noise_kk.hpp"

#include "proto/secure/transport.hpp"
#include "tests/unit/proto/secure/hex.hpp"

#include <array>
#include <gtest/gtest.h>
#include <string_view>

namespace hapnet::secure {

namespace {

// The vector Noise_KKpsk0_25519_ChaChaPoly_BLAKE2b of vectors/cacophony.txt in the Haskell library
// cacophony 0.11.0, which is in the public domain (Unlicense).
struct PublishedMessage {
    std::string_view payload, sealed;
};
constexpr std::array<PublishedMessage, 6> published{{
    {"4c756477696720766f6e204d69736573",
     "ca35def5ae56cec33dc2036731ab14896bc4c75dbb07a61f879f8e3afa4c794487521fc73d63"
     "57e877a7e9f84d5ec31a067fbf444d51ab71de409278f5857fb3"},
    {"4d757272617920526f746862617264",
     "95ebc60d2b1fa672c1f46a8aa265ef51bfe38e7ccb39ec5be34069f14480884308dc2259e85e"
     "e14692354eaaf1eb3054054e738e46fe7f8a73e02e871c732c"},
    {"462e20412e20486179656b", "9505ef116d0a22648bd4fbb58cf08cfac297917e3bfccf17eff842"},
    {"4361726c204d656e676572", "28ef5ad914f57f499c5bd3171ea0f5911787e3eae0edc7ac56c003"},
    {"4a65616e2d426170746973746520536179",
     "896265d3ae0eecdb6bf340ad1c70c5347bfab494e08a475f86ddba09d3c7b768fe"},
    {"457567656e2042f6686d20766f6e2042617765726b",
     "35fb4019719e1a545360fba324db5456214935a221e12c2e16d5d8bfdc7342669f21e54cc6"},
}};
constexpr std::string_view published_hash =
    "9d3b1f0130e16b40175dfb34aea1298d77c159e4c699ee4303350d12ea0ea8d66f89f2d6c7be"
    "9268e8f4b2f0c883f79acd503c0c4ef06905c1aaaed9c1dd812e";

StaticKeys initiator_keys()
{
    auto keys = StaticKeys::from(
        secret_from_hex("e61ef9919cde45dd5f82166404bd08e38bceb5dfdfded0a34c8df7ed542214d1"),
        public_from_hex("31e0303fd6418d2f8c0e78b91f22e8caed0fbe48656dcf4767e4834f701b8f62"),
        secret_from_hex("54686973206973206d7920417573747269616e20706572737065637469766521"));
    if (!keys) throw std::logic_error{"no keys"};
    return std::move(*keys);
}
StaticKeys responder_keys()
{
    auto keys = StaticKeys::from(
        secret_from_hex("4a3acbfdb163dec651dfa3194dece676d437029c62a408b4c5ea9114246e4893"),
        public_from_hex("6bc3822a2aa7f4e6981d6538692b3cdf3e6df9eea6ed269eb41d93c22757b75a"),
        secret_from_hex("54686973206973206d7920417573747269616e20706572737065637469766521"));
    if (!keys) throw std::logic_error{"no keys"};
    return std::move(*keys);
}
Secret initiator_ephemeral()
{
    return secret_from_hex("893e28b9dc6ca8d611ab664754b8ceb7bac5117349a4439a6b0569da977c464a");
}
Secret responder_ephemeral()
{
    return secret_from_hex("bbdb4cdbd309f1a1f2e1456967fe288cadd6f712d65dc7b7793d5e63da6b375b");
}
const Text prologue = from_hex("4a6f686e2047616c74");

/// Steps until the message is complete, and counts the steps.
NoiseKk::Progress run(NoiseKk& handshake, int* steps = nullptr)
{
    for (;;) {
        if (steps != nullptr) ++*steps;
        const auto progress = handshake.step();
        if (progress != NoiseKk::Progress::working) return progress;
    }
}

struct Pair {
    StaticKeys keys_a = initiator_keys(), keys_b = responder_keys();
    NoiseKk a{Role::initiator, keys_a, prologue, initiator_ephemeral()};
    NoiseKk b{Role::responder, keys_b, prologue, responder_ephemeral()};
};

} // namespace

TEST(NoiseKk, SaysByteForByteWhatThePublishedVectorSays)
{
    prepare();
    Pair pair;
    pair.a.write(from_hex(published[0].payload));
    ASSERT_EQ(run(pair.a), NoiseKk::Progress::done);
    EXPECT_EQ(to_hex(pair.a.message()), published[0].sealed);
    pair.b.read(pair.a.message());
    ASSERT_EQ(run(pair.b), NoiseKk::Progress::done);
    EXPECT_EQ(to_hex(pair.b.payload()), published[0].payload);
    pair.b.write(from_hex(published[1].payload));
    ASSERT_EQ(run(pair.b), NoiseKk::Progress::done);
    EXPECT_EQ(to_hex(pair.b.message()), published[1].sealed);
    pair.a.read(pair.b.message());
    ASSERT_EQ(run(pair.a), NoiseKk::Progress::done);
    EXPECT_EQ(to_hex(pair.a.payload()), published[1].payload);

    const auto keys_a = pair.a.split();
    const auto keys_b = pair.b.split();
    EXPECT_EQ(to_hex(keys_a.handshake), published_hash);
    EXPECT_EQ(keys_a.handshake, keys_b.handshake);
    // The messages after the handshake, in turn, with one count for each way.
    for (std::size_t i = 2; i < published.size(); ++i) {
        const bool from_a = i % 2 == 0;
        const Secret& sending = from_a ? keys_a.to_other : keys_b.to_other;
        const Secret& receiving = from_a ? keys_b.from_other : keys_a.from_other;
        Text room = from_hex(published[i].payload);
        const std::size_t length = room.size();
        room.resize(length + tag_bytes);
        seal(sending, i / 2 - 1, {}, room);
        EXPECT_EQ(to_hex(room), published[i].sealed) << "message " << i;
        ASSERT_TRUE(open(receiving, i / 2 - 1, {}, room));
        room.resize(length);
        EXPECT_EQ(to_hex(room), published[i].payload);
    }
}

TEST(NoiseKk, TakesOneMultiplicationAStepSoThatATickBearsIt)
{
    // e, es | es | e, ee, se | ee, se. The product of the static keys was computed before.
    Pair pair;
    int steps = 0;
    pair.a.write({});
    run(pair.a, &steps);
    EXPECT_EQ(steps, 2);
    pair.b.read(pair.a.message());
    run(pair.b, &(steps = 0));
    EXPECT_EQ(steps, 1);
    pair.b.write({});
    run(pair.b, &(steps = 0));
    EXPECT_EQ(steps, 3);
    pair.a.read(pair.b.message());
    run(pair.a, &(steps = 0));
    EXPECT_EQ(steps, 2);
}

TEST(NoiseKk, RefusesEitherMessageWithAnyBitChanged)
{
    for (const std::size_t which : {0U, 1U}) {
        const std::size_t bytes = published[which].sealed.size() / 2;
        for (std::size_t byte = 0; byte < bytes; ++byte) {
            Pair pair;
            NoiseKk& reader = which == 0 ? pair.b : pair.a;
            Text message = from_hex(published[which].sealed);
            if (which == 1) {
                pair.a.write(from_hex(published[0].payload));
                run(pair.a);
            }
            message[byte] ^= std::byte{1} << (byte % 8);
            reader.read(message);
            // The curve would ignore the last bit of a key.
            EXPECT_EQ(run(reader), NoiseKk::Progress::refused) << "byte " << byte;
        }
    }
}

TEST(NoiseKk, ReadsTheGenuineMessageAfterItHasRefusedOthers)
{
    Pair pair;
    const auto read = [](NoiseKk& reader, const PublishedMessage& message) {
        const Text genuine = from_hex(message.sealed);
        for (const std::size_t byte : {std::size_t{0}, std::size_t{31}, genuine.size() - 1}) {
            Text forged = genuine;
            forged[byte] ^= std::byte{0x80};
            reader.read(forged);
            EXPECT_EQ(run(reader), NoiseKk::Progress::refused);
        }
        for (const Text& other : {Text{}, Text(genuine.size())}) { // a key of low order
            reader.read(other);
            EXPECT_EQ(run(reader), NoiseKk::Progress::refused);
        }
        reader.read(genuine);
        ASSERT_EQ(run(reader), NoiseKk::Progress::done);
        EXPECT_EQ(to_hex(reader.payload()), message.payload);
    };
    pair.a.write(from_hex(published[0].payload));
    run(pair.a);
    read(pair.b, published[0]);
    pair.b.write(from_hex(published[1].payload));
    run(pair.b);
    EXPECT_EQ(to_hex(pair.b.message()), published[1].sealed);
    read(pair.a, published[1]);
    EXPECT_EQ(to_hex(pair.a.split().handshake), published_hash);
    EXPECT_EQ(to_hex(pair.b.split().handshake), published_hash);
}

TEST(NoiseKk, RefusesEveryOtherLength)
{
    const Text message = from_hex(published[0].sealed);
    for (std::size_t size = 0; size < 2 * NoiseKk::message_bytes_max; ++size) {
        if (size == message.size()) continue;
        Text other = message;
        other.resize(size);
        Pair pair;
        pair.b.read(other);
        EXPECT_EQ(run(pair.b), NoiseKk::Progress::refused) << size << " bytes";
    }
}

TEST(NoiseKk, RefusesAnotherPrologueAnotherSharedKeyAndAnotherPeer)
{
    const auto refused = [](const StaticKeys& keys, const Text& about) {
        NoiseKk reader{Role::responder, keys, about, responder_ephemeral()};
        reader.read(from_hex(published[0].sealed));
        return run(reader) == NoiseKk::Progress::refused;
    };
    const StaticKeys right = responder_keys();
    EXPECT_FALSE(refused(right, prologue));
    EXPECT_TRUE(refused(right, from_hex("4a6f686e2047616c75")));
    const auto other_shared = StaticKeys::from(right.own().copy(), right.other(), Secret{});
    EXPECT_TRUE(refused(*other_shared, prologue));
    const auto other_peer = StaticKeys::from(
        right.own().copy(), public_key_of(initiator_ephemeral()), right.pre_shared().copy());
    EXPECT_TRUE(refused(*other_peer, prologue));
}

TEST(NoiseKk, HasNoKeysWithAPublicKeyOfLowOrder)
{
    EXPECT_FALSE(StaticKeys::from(initiator_ephemeral(), PublicKey{}, Secret{}));
}

} // namespace hapnet::secure
