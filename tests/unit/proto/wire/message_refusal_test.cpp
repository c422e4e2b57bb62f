// SPDX-FileCopyrightText: 2026 The Hapnet authors
// SPDX-License-Identifier: MIT
// The messages that decode() refuses, byte by byte.
#include "tests/unit/proto/wire/hex.hpp"
#include "tests/unit/proto/wire/samples.hpp"

#include <algorithm>
#include <gtest/gtest.h>
#include <limits>
#include <string>

namespace hapnet::wire {
namespace {

constexpr std::size_t hello_flags = 8;
constexpr std::size_t hello_echo = 45;
constexpr std::size_t state_flags = 20;

Bytes bytes_of_message(const Message& message) { return bytes_of(encode(message).bytes()); }

Bytes with(Bytes bytes, std::size_t offset, int value)
{
    bytes.at(offset) = static_cast<std::byte>(value);
    return bytes;
}

Bytes with_float(Bytes bytes, std::size_t offset, float value)
{
    const auto raw = std::as_bytes(std::span{&value, 1}); // the tests run on little-endian machines
    std::copy(raw.begin(), raw.end(), bytes.begin() + static_cast<std::ptrdiff_t>(offset));
    return bytes;
}

std::string error_of(const Bytes& bytes)
{
    const auto message = decode(bytes);
    return message ? "accepted" : message.error().message;
}

TEST(Refusal, OfEveryTruncationAndEveryExtension)
{
    State bare = full_state();
    bare.bodies.clear();
    for (const Message& message :
         {Message{full_hello()}, Message{full_state()}, Message{bare}, Message{Bye{}}}) {
        Bytes bytes = bytes_of_message(message);
        for (std::size_t size = 0; size < bytes.size(); ++size) {
            EXPECT_FALSE(decode(std::span{bytes}.first(size))) << size;
        }
        while (bytes.size() < 2048) {
            bytes.push_back(std::byte{0}); // a second body 0 is not in order
            EXPECT_FALSE(decode(bytes)) << bytes.size();
        }
    }
}

TEST(Refusal, OfAnotherMagicVersionOrType)
{
    const Bytes hello = bytes_of_message(full_hello());
    EXPECT_EQ(error_of(with(hello, 0, 'h')), "not one of ours");
    EXPECT_EQ(error_of(with(hello, 1, 'n')), "not one of ours");
    EXPECT_EQ(error_of(with(hello, 2, 1)), "another protocol version");
    EXPECT_EQ(error_of(with(hello, 3, 0)), "unknown type");
    EXPECT_EQ(error_of(with(hello, 3, 4)), "unknown type");
    EXPECT_EQ(error_of(with(hello, 3, 2)), "state: wrong length");
}

TEST(Refusal, OfUnknownFlagsAndOfReservedBytes)
{
    const Bytes hello = bytes_of_message(full_hello());
    const Bytes state = bytes_of_message(full_state());
    for (const int unknown : {0x10, 0x20, 0x40, 0x80}) {
        EXPECT_EQ(error_of(with(hello, hello_flags, 0x0f | unknown)), "hello: not canonical");
        EXPECT_EQ(error_of(with(state, state_flags, 0x0f | unknown)), "state: not canonical");
    }
    EXPECT_EQ(error_of(with(state, 21, 1)), "state: not canonical");
    EXPECT_EQ(error_of(with(hello, 4, 1)), "hello: not canonical"); // a session in a hello
}

TEST(Refusal, OfAbsentFieldsThatAreNotZero)
{
    const Bytes hello = bytes_of_message(full_hello());
    for (const int absent : {1, 2, 4}) {
        EXPECT_EQ(error_of(with(hello, hello_flags, 0x0f & ~absent)), "hello: not canonical");
    }
    const Bytes state = bytes_of_message(full_state());
    EXPECT_EQ(error_of(with(state, state_flags, 0x0e)), "state: not canonical");
    EXPECT_EQ(error_of(with(state, state_flags, 0x07)),
              "state: not canonical"); // a body without its flag
    Hello silent = full_hello();
    silent.echo.reset();
    EXPECT_EQ(error_of(with(bytes_of_message(silent), hello_echo + 8, 1)), "hello: not canonical");
}

TEST(Refusal, OfWhatCannotBe)
{
    const Bytes hello = bytes_of_message(full_hello());
    Bytes nameless = hello;
    std::fill(nameless.begin() + 9, nameless.begin() + 13, std::byte{0});
    EXPECT_EQ(error_of(nameless), "hello: not canonical"); // nonce 0
    Bytes anonymous = hello;
    std::fill(anonymous.begin() + 17, anonymous.begin() + 19, std::byte{0});
    EXPECT_EQ(error_of(anonymous), "hello: not canonical"); // peer 0 cannot be answered
    Bytes unnumbered = bytes_of_message(full_state());
    std::fill(unnumbered.begin() + 8, unnumbered.begin() + 12, std::byte{0});
    EXPECT_EQ(error_of(unnumbered), "state: not canonical"); // sequence 0
    // Holding without touching.
    EXPECT_EQ(error_of(with(bytes_of_message(full_state()), state_flags, 0x0d)),
              "state: not canonical");
    EXPECT_EQ(error_of(with(bytes_of_message(Bye{}), 8, bye_reasons)), "bye: unknown reason");
    EXPECT_EQ(error_of(with(bytes_of_message(Bye{}), 8, 255)), "bye: unknown reason");
}

TEST(Refusal, OfTaskNamesThatAreNotPrintableAsciiPaddedWithZeros)
{
    const Bytes hello = bytes_of_message(full_hello());              // "P1" at 73
    EXPECT_EQ(error_of(with(hello, 73, 0)), "hello: not canonical"); // no name, then text
    EXPECT_EQ(error_of(with(hello, 74, ' ')), "hello: not canonical");
    EXPECT_EQ(error_of(with(hello, 74, 0x7f)), "hello: not canonical");
    EXPECT_EQ(error_of(with(hello, 74, 0xc3)), "hello: not canonical");
    EXPECT_EQ(error_of(with(hello, 88, 'x')), "hello: not canonical"); // after the padding
    EXPECT_EQ(error_of(with(with(hello, 73, 0), 74, 0)), "hello: not canonical");
}

TEST(Refusal, OfVectorsThatAreNotFinite)
{
    const Bytes state = bytes_of_message(full_state());
    constexpr float infinity = std::numeric_limits<float>::infinity();
    for (std::size_t offset = 34; offset < 112; offset += 4) {
        if (offset == 70) offset = 88; // the body's
        for (const float value : {infinity, -infinity, std::numeric_limits<float>::quiet_NaN()}) {
            EXPECT_EQ(error_of(with_float(state, offset, value)), "state: not finite") << offset;
        }
        EXPECT_NE(error_of(with_float(state, offset, std::numeric_limits<float>::max())),
                  "state: not finite")
            << offset;
    }
}

TEST(Refusal, OfBodiesThatDoNotAscendOrAreTooMany)
{
    State state = full_state();
    BodyState second = plain_body();
    second.body = 0x0301;
    state.bodies.add(second);
    const Bytes two = bytes_of_message(state);
    EXPECT_TRUE(decode(two));
    EXPECT_EQ(error_of(with(two, 86 + 50 + 1, 0x02)), "state: not canonical"); // the same id
    EXPECT_EQ(error_of(with(two, 86 + 50 + 1, 0x01)), "state: not canonical"); // a lower one
    Bytes nine = bytes_of_message(full_state());
    for (int i = 1; i < 9; ++i) {
        const Bytes body = bytes_of(std::span{nine}.subspan(86, 50));
        nine.insert(nine.end(), body.begin(), body.end());
        nine[nine.size() - 49] = static_cast<std::byte>(0x02 + i);
        EXPECT_EQ(error_of(nine), i < 8 ? "accepted" : "state: wrong length");
    }
}

TEST(Refusal, OfOrientationsAndIntentionsThatNobodySays)
{
    State state = full_state();
    state.bodies.clear();
    state.bodies.add(turning_body());
    const Bytes turning = bytes_of_message(state);
    EXPECT_EQ(error_of(with(turning, 86 + 57, 0x58)), "state: not canonical");            // bit 62
    EXPECT_EQ(error_of(with(with(turning, 70, 0x00), 71, 0x80)), "state: not canonical"); // -32768
    EXPECT_EQ(error_of(with(with(turning, 70, 0x01), 71, 0x80)), "accepted");             // -32767
}

TEST(Refusal, OfHellosThatHearPeerZeroOrHaveANegativeHand)
{
    const Bytes hello = bytes_of_message(full_hello());
    EXPECT_EQ(error_of(with(hello, 93, 0x07)), "hello: not canonical");
    EXPECT_EQ(error_of(with_float(hello, 101, -1.0F)), "hello: not canonical");
    EXPECT_EQ(error_of(with_float(hello, 105, -0.0F)), "hello: not canonical");
    EXPECT_EQ(error_of(with_float(hello, 113, std::numeric_limits<float>::infinity())),
              "hello: not canonical");
}

TEST(Refusal, OfTimesMoreThanTwoToTheSixtyNanosecondsFromZero)
{
    State state = full_state();
    for (const std::int64_t sign : {1, -1}) {
        state.sent = at(sign * (std::int64_t{1} << 60));
        const Bytes edge = bytes_of_message(state);
        EXPECT_TRUE(decode(edge));
        EXPECT_EQ(error_of(sign > 0 ? with(edge, 12, 1) : with(edge, 12 + 7, 0x80)),
                  "state: not canonical");
    }
    const Bytes hello = bytes_of_message(full_hello());
    for (const std::size_t time : {37U, 45U, 57U, 65U}) {
        EXPECT_EQ(error_of(with(hello, time + 7, 0x7f)), "hello: not canonical") << time;
    }
    EXPECT_EQ(error_of(with(bytes_of_message(full_state()), 22 + 7, 0x7f)), "state: not canonical");
}

TEST(Version, IsReadFromTheFirstThreeBytesWhateverFollows)
{
    EXPECT_EQ(version_of(encode(full_hello()).bytes()), protocol_version);
    EXPECT_EQ(version_of(bytes_of("48 4e 01")), 1);
    EXPECT_EQ(version_of(bytes_of("48 4e 00 ff ff ff")), 0);
    EXPECT_EQ(version_of(bytes_of("48 4e")), std::nullopt);
    EXPECT_EQ(version_of(bytes_of("48 4f 01")), std::nullopt);
    EXPECT_EQ(version_of({}), std::nullopt);
}

TEST(TaskName, IsOneToSixteenPrintableCharactersWithoutSpaces)
{
    EXPECT_EQ(TaskName::from_text("T3").value().text(), "T3");
    EXPECT_EQ(TaskName::from_text("0123456789abcdef").value().text(), "0123456789abcdef");
    for (const std::string text : {"", "0123456789abcdefg", "a b", "a\n", "\x7f", "\xc3\xa9"}) {
        EXPECT_FALSE(TaskName::from_text(text)) << text;
    }
}

TEST(EncodingDeathTest, StopsTheProgramThatSaysWhatNobodyMay)
{
    State state = full_state();
    state.hip.value.x = std::numeric_limits<double>::quiet_NaN();
    EXPECT_DEATH(std::ignore = encode(state), "must never happen");
    state.hip.value.x = 1e300; // beyond single precision
    EXPECT_DEATH(std::ignore = encode(state), "must never happen");
    EXPECT_DEATH(std::ignore = encode(State{}), "must never happen"); // sequence 0
    EXPECT_DEATH(std::ignore = encode(Hello{}), "must never happen"); // nonce 0
    Hello hello = full_hello();
    hello.echo->age = -1ns;
    EXPECT_DEATH(std::ignore = encode(hello), "must never happen");
}

} // namespace
} // namespace hapnet::wire
