// SPDX-FileCopyrightText: 2026 The Hapnet authors
// SPDX-License-Identifier: MIT
#include "proto/secure/primitives.hpp"

#include "tests/unit/proto/secure/hex.hpp"

#include <gtest/gtest.h>
#include <type_traits>
#include <utility>

namespace hapnet::secure {

static_assert(!std::is_copy_constructible_v<Secret> && !std::is_copy_assignable_v<Secret>);

TEST(Primitives, ShareASecretAsInRfc7748)
{
    // Section 6.1.
    const Secret alice =
        secret_from_hex("77076d0a7318a57d3c16c17251b26645df4c2f87ebc0992ab177fba51db92c2a");
    const Secret bob =
        secret_from_hex("5dab087e624a8a4b79e17f8b83800ee66f3bb1292618b6fd1c2f8b27ff88e0eb");
    EXPECT_EQ(to_hex(public_key_of(alice)),
              "8520f0098930a754748b7ddcb43ef75a0dbf3a0d26381af4eba4a98eaa9b4e6a");
    const auto one = diffie_hellman(alice, public_key_of(bob));
    const auto other = diffie_hellman(bob, public_key_of(alice));
    ASSERT_TRUE(one && other);
    EXPECT_EQ(to_hex(one->bytes()),
              "4a5d9d5ba4ce2de1728e3bf480350f25e07e21c947d19e3376f09b3c1e161742");
    EXPECT_EQ(to_hex(other->bytes()), to_hex(one->bytes()));
}

TEST(Primitives, ShareNothingWithAKeyOfLowOrder)
{
    const Secret own =
        secret_from_hex("77076d0a7318a57d3c16c17251b26645df4c2f87ebc0992ab177fba51db92c2a");
    EXPECT_FALSE(diffie_hellman(own, PublicKey{}));
    PublicKey one{};
    one[0] = std::byte{1};
    EXPECT_FALSE(diffie_hellman(own, one));
}

TEST(Primitives, ShareNothingWithAKeyThatIsNotCanonical)
{
    const Secret own =
        secret_from_hex("77076d0a7318a57d3c16c17251b26645df4c2f87ebc0992ab177fba51db92c2a");
    const Secret other =
        secret_from_hex("5dab087e624a8a4b79e17f8b83800ee66f3bb1292618b6fd1c2f8b27ff88e0eb");
    PublicKey key = public_key_of(other);
    EXPECT_TRUE(diffie_hellman(own, key));
    key.back() |= std::byte{0x80}; // the curve leaves this bit out
    EXPECT_FALSE(diffie_hellman(own, key));
    key.fill(std::byte{0xff});
    key.back() = std::byte{0x7f};
    for (int low = 0; low <= 0xff; ++low) { // around the prime, 2^255 - 19
        key.front() = static_cast<std::byte>(low);
        EXPECT_EQ(diffie_hellman(own, key).has_value(), low < 0xed - 1) << low; // -1: low order
    }
}

TEST(Primitives, HashAsPythonsHashlibDoes)
{
    EXPECT_EQ(to_hex(hash(bytes_of("abc"))),
              "ba80a53f981c4d0d6a2797b69f12f6e94c212f14685ac4b74b12bb6fdbffa2d17d87c5392aab"
              "792dc252d5de4533cc9518d38aa8dbf1925ab92386edd4009923");
    EXPECT_EQ(hash(bytes_of("ab"), bytes_of("c")), hash(bytes_of("abc")));
    const auto key =
        array_from_hex<32>("000102030405060708090a0b0c0d0e0f101112131415161718191a1b1c1d1e1f");
    EXPECT_EQ(to_hex(keyed_hash(key, bytes_of("a"), bytes_of("bc"))),
              "1a64be47e4729d951c302ee543f97cf3");
}

TEST(Primitives, AuthenticateAndExpandAsPythonsHmacDoes)
{
    SecretHash key;
    for (std::size_t i = 0; i < hash_bytes; ++i) key.bytes()[i] = static_cast<std::byte>(i);
    EXPECT_EQ(to_hex(authenticate(key.bytes(), bytes_of("hap"), bytes_of("net")).bytes()),
              "e53ad84c704842472e19d9580c1c131b7ecc6e3520f27330284e03ebef4aceae3b31dbe58d03"
              "9742712ec19c86c91036fb2e27b0275c7214d483c135cd6ef8dc");
    const Expanded outputs = expand(key, bytes_of("hapnet"));
    EXPECT_EQ(to_hex(outputs[0].bytes()),
              "2748cb469bccbc5a058765e83b8323a0a5fd41b6132434095107778d116a05b432e22f96c833"
              "472bae3a52806ee8d20f9be9c40c2ea638e23355993583610210");
    EXPECT_EQ(to_hex(outputs[1].bytes()),
              "61549eb55a86825d10cb0fbe0f651c4ae6b69a13f3f8a945c9779f3036f584681da888ecc149"
              "ae2e8c1561596ec50e89e9dae0d7da62a6aaee07bac83eeffbc8");
    EXPECT_EQ(to_hex(outputs[2].bytes()),
              "dbf8a679245cd0af931d29e5ca8006fcadf45e9e6a1514f07cf448f6b12a0c6fd442ae121006"
              "8f41f0b19b0aa764271ec8c219d97b8dfc601e303634c216ec1e");
}

TEST(Primitives, SealAndOpenAsInRfc8439)
{
    // Appendix A.5; its nonce is the number in Noise's form.
    const Secret key =
        secret_from_hex("1c9240a5eb55d38af333888604f6b5f0473917c1402b80099dca5cbc207075c0");
    const Text associated = from_hex("f33388860000000000004e91");
    constexpr std::uint64_t number = 0x0807060504030201;
    const Text plain =
        from_hex("496e7465726e65742d4472616674732061726520647261667420646f63756d656e7473207661"
                 "6c696420666f722061206d6178696d756d206f6620736978206d6f6e74687320616e64206d61"
                 "7920626520757064617465642c207265706c616365642c206f72206f62736f6c657465642062"
                 "79206f7468657220646f63756d656e747320617420616e792074696d652e2049742069732069"
                 "6e617070726f70726961746520746f2075736520496e7465726e65742d447261667473206173"
                 "207265666572656e6365206d6174657269616c206f7220746f2063697465207468656d206f74"
                 "686572207468616e206173202fe2809c776f726b20696e2070726f67726573732e2fe2809d");
    Text room = plain;
    room.resize(plain.size() + tag_bytes);
    seal(key, number, associated, room);
    EXPECT_EQ(to_hex(room),
              "64a0861575861af460f062c79be643bd5e805cfd345cf389f108670ac76c8cb24c6cfc18755d"
              "43eea09ee94e382d26b0bdb7b73c321b0100d4f03b7f355894cf332f830e710b97ce98c8a84a"
              "bd0b948114ad176e008d33bd60f982b1ff37c8559797a06ef4f0ef61c186324e2b3506383606"
              "907b6a7c02b0f9f6157b53c867e4b9166c767b804d46a59b5216cde7a4e99040c5a40433225e"
              "e282a1b0a06c523eaf4534d7f83fa1155b0047718cbc546a0d072b04b3564eea1b422273f548"
              "271a0bb2316053fa76991955ebd63159434ecebb4e466dae5a1073a6727627097a1049e617d9"
              "1d361094fa68f0ff77987130305beaba2eda04df997b714d6c6f2c29a6ad5cb4022b02709bee"
              "ad9d67890cbb22392336fea1851f38");
    ASSERT_TRUE(open(key, number, associated, room));
    room.resize(plain.size());
    EXPECT_EQ(room, plain);
}

TEST(Primitives, OpenNothingThatWasChangedInAnyBit)
{
    const Secret key{
        array_from_hex<32>("1c9240a5eb55d38af333888604f6b5f0473917c1402b80099dca5cbc207075c0")};
    WideNonce wide{};
    Text sealed(20 + tag_bytes), wide_sealed(20 + tag_bytes);
    Text associated(12);
    seal(key, 7, associated, sealed);
    seal(key, wide, associated, wide_sealed);
    for (std::size_t bit = 0; bit < 8 * sealed.size(); ++bit) {
        const std::byte flip = std::byte{1} << (bit % 8);
        Text copy = sealed, wide_copy = wide_sealed;
        copy[bit / 8] ^= flip;
        wide_copy[bit / 8] ^= flip;
        EXPECT_FALSE(open(key, 7, associated, copy)) << "bit " << bit;
        EXPECT_FALSE(open(key, wide, associated, wide_copy)) << "bit " << bit;
    }
    for (std::size_t bit = 0; bit < 8 * associated.size(); ++bit) {
        Text copy = sealed, other = associated;
        other[bit / 8] ^= std::byte{1} << (bit % 8);
        EXPECT_FALSE(open(key, 7, other, copy)) << "bit " << bit;
    }
    Text copy = sealed;
    EXPECT_FALSE(open(key, 8, associated, copy));
    copy = sealed;
    EXPECT_TRUE(open(key, 7, associated, copy));
    EXPECT_TRUE(open(key, wide, associated, wide_sealed));
}

TEST(Primitives, LeaveZerosWhereASecretMovedFrom)
{
    Secret from =
        secret_from_hex("1c9240a5eb55d38af333888604f6b5f0473917c1402b80099dca5cbc207075c0");
    const Secret to = std::move(from);
    EXPECT_EQ(to_hex(from.bytes()), std::string(64, '0')); // NOLINT(bugprone-use-after-move)
    EXPECT_NE(to_hex(to.bytes()), std::string(64, '0'));
}

TEST(Primitives, CompareLengthsToo)
{
    EXPECT_TRUE(are_equal(bytes_of("abc"), bytes_of("abc")));
    EXPECT_FALSE(are_equal(bytes_of("abc"), bytes_of("abd")));
    EXPECT_FALSE(are_equal(bytes_of("abc"), bytes_of("ab")));
}

} // namespace hapnet::secure
