// SPDX-FileCopyrightText: 2026 The Hapnet authors
// SPDX-License-Identifier: MIT
// The bytes of FORMAT.md, written out: one field a line, its offset first.
#include "tests/unit/proto/wire/hex.hpp"
#include "tests/unit/proto/wire/samples.hpp"

#include <gtest/gtest.h>
#include <string>

namespace hapnet::wire {
namespace {

void expect_bytes(const Message& message, const std::string& hex)
{
    EXPECT_EQ(bytes_of(encode(message).bytes()), bytes_of(hex));
    const auto decoded = decode(bytes_of(hex));
    ASSERT_TRUE(decoded) << decoded.error().message;
    EXPECT_EQ(*decoded, message);
}

TEST(Format, OfAHello)
{
    expect_bytes(full_hello(), "48 4e"                    // 0 magic
                               " 01"                      // 2 version
                               " 01"                      // 3 type
                               " 00 00 00 00"             // 4 session
                               " 0f"                      // 8 flags
                               " 01 02 03 04"             // 9 nonce
                               " 11 12 13 14"             // 13 nonce heard
                               " 01 02"                   // 17 peer id
                               " e8 03"                   // 19 tick rate
                               " 01 02 03 04 05 06 07 08" // 21 scene hash
                               " 11 12 13 14 15 16 17 18" // 29 seed
                               " 02 01 00 00 00 00 00 00" // 37 sent
                               " ff ff ff ff ff ff ff ff" // 45 echo: of
                               " fc fd fe ff"             // 53 echo: age
                               " 03 02 00 00 00 00 00 00" // 57 start
                               " 04 03 00 00 00 00 00 00" // 65 start heard
                               " 50 31 00 00 00 00 00 00" // 73 task
                               " 00 00 00 00 00 00 00 00");
}

TEST(Format, OfAHelloThatHasHeardNothing)
{
    Hello hello;
    hello.nonce = 1;
    hello.peer_id = 2;
    hello.tick_rate_hz = 1000;
    hello.sent = at(3);
    hello.task = TaskName::from_text("0123456789abcdef").value();
    expect_bytes(hello, "48 4e 01 01 00 00 00 00"
                        " 00"                      // 8 flags
                        " 01 00 00 00"             // 9 nonce
                        " 00 00 00 00"             // 13 nonce heard
                        " 02 00 e8 03"             // 17 peer id, tick rate
                        " 00 00 00 00 00 00 00 00" // 21 scene hash
                        " 00 00 00 00 00 00 00 00" // 29 seed
                        " 03 00 00 00 00 00 00 00" // 37 sent
                        " 00 00 00 00 00 00 00 00" // 45 echo
                        " 00 00 00 00"             //
                        " 00 00 00 00 00 00 00 00" // 57 start
                        " 00 00 00 00 00 00 00 00" // 65 start heard
                        " 30 31 32 33 34 35 36 37" // 73 task, all 16 bytes of it
                        " 38 39 61 62 63 64 65 66");
}

TEST(Format, OfAStateWithABody)
{
    expect_bytes(full_state(), "48 4e"                    // 0 magic
                               " 01"                      // 2 version
                               " 02"                      // 3 type
                               " 21 22 23 24"             // 4 session
                               " 31 32 33 34"             // 8 sequence
                               " 02 01 00 00 00 00 00 00" // 12 sent
                               " 0f"                      // 20 flags
                               " 00"                      // 21 reserved
                               " 03 02 00 00 00 00 00 00" // 22 echo: of
                               " 05 00 00 00"             // 30 echo: age
                               " 00 00 80 3f"             // 34 HIP position: 1
                               " 00 00 00 c0"             //    -2
                               " 00 00 00 3f"             //    0.5
                               " 00 00 80 3e"             // 46 HIP velocity: 0.25
                               " 00 00 80 40"             //    4
                               " 00 00 00 be"             //    -0.125
                               " 00 00 00 41"             // 58 contact force: 8
                               " 00 00 80 41"             //    16
                               " 00 00 80 bf"             //    -1
                               " 01 02"                   // 70 body
                               " 00 00 00 3f"             // 72 position: 0.5
                               " 00 00 80 3f"             //    1
                               " 00 00 00 40"             //    2
                               " 00 00 80 c0"             // 84 velocity: -4
                               " 00 00 00 c1"             //    -8
                               " 00 00 80 c1"             //    -16
                               " 01 00 00 00 00 00 00 00" // 96 caused displacement
                               " ff ff ff ff ff ff ff ff" //
                               " 02 01 00 00 00 00 00 00" //
                               " 02 00 00 00 00 00 00 00" // 120 caused impulse
                               " fe ff ff ff ff ff ff ff" //
                               " 03 02 00 00 00 00 00 00");
}

TEST(Format, OfAStateThatTouchesNothing)
{
    State state;
    state.session = 7;
    state.sequence = 1;
    state.sent = at(9);
    expect_bytes(state, "48 4e 01 02"
                        " 07 00 00 00"                         // 4 session
                        " 01 00 00 00"                         // 8 sequence
                        " 09 00 00 00 00 00 00 00"             // 12 sent
                        " 00 00"                               // 20 flags, reserved
                        " 00 00 00 00 00 00 00 00"             // 22 echo
                        " 00 00 00 00"                         //
                        " 00 00 00 00 00 00 00 00 00 00 00 00" // 34 HIP position
                        " 00 00 00 00 00 00 00 00 00 00 00 00" // 46 HIP velocity
                        " 00 00 00 00 00 00 00 00 00 00 00 00");
}

TEST(Format, OfAByeForEachReason)
{
    expect_bytes(Bye{0x04030201, ByeReason::finished}, "48 4e 01 03 01 02 03 04 00");
    expect_bytes(Bye{1, ByeReason::interrupted}, "48 4e 01 03 01 00 00 00 01");
    expect_bytes(Bye{0, ByeReason::other_version}, "48 4e 01 03 00 00 00 00 02");
    expect_bytes(Bye{0, ByeReason::other_scene}, "48 4e 01 03 00 00 00 00 03");
    expect_bytes(Bye{0, ByeReason::other_task}, "48 4e 01 03 00 00 00 00 04");
    expect_bytes(Bye{0, ByeReason::other_tick_rate}, "48 4e 01 03 00 00 00 00 05");
    expect_bytes(Bye{0, ByeReason::same_id}, "48 4e 01 03 00 00 00 00 06");
}

TEST(Format, HasTheStatedSizesWithRoomForATagBelow160Bytes)
{
    State bare = full_state();
    bare.body.reset();
    EXPECT_EQ(encode(full_hello()).bytes().size(), 89U);
    EXPECT_EQ(encode(bare).bytes().size(), 70U);
    EXPECT_EQ(encode(full_state()).bytes().size(), 144U);
    EXPECT_EQ(encode(Bye{}).bytes().size(), 9U);
    EXPECT_EQ(message_bytes_max, 144U);
    EXPECT_LE(message_bytes_max + tag_bytes, 160U);
}

TEST(Format, RoundsAPlaceTenCentimetresOffByLessThanFourNanometres)
{
    State state;
    state.sequence = 1;
    state.hip = {{0.1, -0.1, 0.0999999}};
    const auto decoded = decode(encode(state).bytes());
    ASSERT_TRUE(decoded);
    const auto moved = std::get<State>(*decoded).hip - state.hip;
    EXPECT_LT(base::norm(moved), 3 * 4e-9);
    EXPECT_NEAR(moved.x(), 0.0, 4e-9);
}

} // namespace
} // namespace hapnet::wire
