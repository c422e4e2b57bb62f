// SPDX-FileCopyrightText: 2026 The Hapnet authors
// SPDX-License-Identifier: MIT
// The bytes of docs/formats/wire.md, written out: one field a line, its offset first.
#include "proto/base/random.hpp"
#include "tests/unit/proto/wire/hex.hpp"
#include "tests/unit/proto/wire/samples.hpp"

#include <cmath>
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
                               " 02"                      // 2 version
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
                               " 00 00 00 00 00 00 00 00" //
                               " 30 75 00 00"             // 89 length: 30 s
                               " 06 00 00 00"             // 93 heard: 1 and 2
                               " 21 22 23 24"             // 97 boot
                               " 00 00 00 3f"             // 101 mass: 0.5
                               " 00 00 80 3f"             // 105 damping: 1
                               " 00 00 00 40"             // 109 stiffness: 2
                               " 00 00 80 40");           // 113 friction: 4
}

TEST(Format, OfASessionsNumber)
{
    EXPECT_EQ(session_number(0x11111111, 0x22222222), 0x93eb5bd8U); // as in Python
    EXPECT_NE(session_number(0x22222222, 0x11111111), 0x93eb5bd8U);
}

TEST(Format, OfAHelloThatHasHeardNothing)
{
    Hello hello;
    hello.nonce = 1;
    hello.peer_id = 2;
    hello.tick_rate_hz = 1000;
    hello.sent = at(3);
    hello.task = TaskName::from_text("0123456789abcdef").value();
    expect_bytes(hello, "48 4e 02 01 00 00 00 00"
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
                        " 38 39 61 62 63 64 65 66" //
                        " 00 00 00 00"             // 89 length, heard, boot: not said
                        " 00 00 00 00 00 00 00 00" //
                        " 00 00 00 00 00 00 00 00" // 101 hand: not said
                        " 00 00 00 00 00 00 00 00");
}

TEST(Format, OfAStateWithABody)
{
    expect_bytes(full_state(), "48 4e"                    // 0 magic
                               " 02"                      // 2 version
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
                               " 01 00 fe ff 02 01"       // 70 intention: 1, -2, 258 steps
                               " 01 00 fd ff 03 02"       // 76 its velocity: 1, -3, 515 steps
                               " 41 42 43 44"             // 82 work
                               " 01 02"                   // 86 body
                               " 00 00 00 3f"             // 88 position: 0.5
                               " 00 00 80 3f"             //    1
                               " 00 00 00 40"             //    2
                               " 00 00 80 c0"             // 100 velocity: -4
                               " 00 00 00 c1"             //    -8
                               " 00 00 80 c1"             //    -16
                               " 01 00 00 00"             // 112 caused displacement
                               " ff ff ff ff"             //
                               " 02 01 00 00"             //
                               " 02 00 00 00"             // 124 caused impulse
                               " fe ff ff ff"             //
                               " 03 02 00 00");
}

TEST(Format, OfABodyThatCanTurn)
{
    State state = full_state();
    state.bodies.clear();
    state.bodies.add(turning_body());
    const Bytes bytes = bytes_of(encode(state).bytes());
    const Bytes body{bytes.begin() + 86, bytes.end()};
    EXPECT_EQ(body, bytes_of("02 82"                                // 0 body, and that it can turn
                             " 00 00 00 3f 00 00 80 3f 00 00 00 40" // 2 position
                             " 00 00 80 c0 00 00 00 c1 00 00 80 c1" // 14 velocity
                             " 01 00 00 00 ff ff ff ff 02 01 00 00" // 26 caused displacement
                             " 02 00 00 00 fe ff ff ff 03 02 00 00" // 38 caused impulse
                             " 00 00 08 00 80 00 00 18"             // 50 orientation: 1 about x
                             " 00 00 80 3f 00 00 00 40 00 00 80 40" // 58 angular velocity
                             " 03 00 00 00 04 00 00 00 05 00 00 00" // 70 caused rotation
                             " 06 00 00 00 07 00 00 00 08 00 00 00")); // 82 angular impulse
}

TEST(Format, OfAStateThatTouchesNothing)
{
    State state;
    state.session = 7;
    state.sequence = 1;
    state.sent = at(9);
    expect_bytes(state, "48 4e 02 02"
                        " 07 00 00 00"                         // 4 session
                        " 01 00 00 00"                         // 8 sequence
                        " 09 00 00 00 00 00 00 00"             // 12 sent
                        " 00 00"                               // 20 flags, reserved
                        " 00 00 00 00 00 00 00 00"             // 22 echo
                        " 00 00 00 00"                         //
                        " 00 00 00 00 00 00 00 00 00 00 00 00" // 34 HIP position
                        " 00 00 00 00 00 00 00 00 00 00 00 00" // 46 HIP velocity
                        " 00 00 00 00 00 00 00 00 00 00 00 00" // 58 contact force
                        " 00 00 00 00 00 00 00 00 00 00 00 00" // 70 intention
                        " 00 00 00 00");                       // 82 work
}

TEST(Format, OfAByeForEachReason)
{
    expect_bytes(Bye{0x04030201, ByeReason::finished}, "48 4e 02 03 01 02 03 04 00");
    expect_bytes(Bye{1, ByeReason::interrupted}, "48 4e 02 03 01 00 00 00 01");
    expect_bytes(Bye{0, ByeReason::other_version}, "48 4e 02 03 00 00 00 00 02");
    expect_bytes(Bye{0, ByeReason::other_scene}, "48 4e 02 03 00 00 00 00 03");
    expect_bytes(Bye{0, ByeReason::other_task}, "48 4e 02 03 00 00 00 00 04");
    expect_bytes(Bye{0, ByeReason::other_tick_rate}, "48 4e 02 03 00 00 00 00 05");
    expect_bytes(Bye{0, ByeReason::same_id}, "48 4e 02 03 00 00 00 00 06");
}

TEST(Format, HasTheStatedSizesAndIsAlwaysOneDatagram)
{
    State bare = full_state();
    bare.bodies.clear();
    State eight = bare;
    for (std::uint16_t id = 0; id < bodies_max; ++id) {
        BodyState body = turning_body();
        body.body = id;
        eight.bodies.add(body);
    }
    EXPECT_EQ(encode(full_hello()).bytes().size(), 117U);
    EXPECT_EQ(encode(bare).bytes().size(), 86U);
    EXPECT_EQ(encode(full_state()).bytes().size(), 136U);
    EXPECT_EQ(encode(eight).bytes().size(), 838U);
    EXPECT_EQ(encode(Bye{}).bytes().size(), 9U);
    EXPECT_EQ(message_bytes_max, 838U);
    EXPECT_EQ(*decode(encode(eight).bytes()), Message{eight});
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

TEST(Format, SaysAnIntentionAsFarAsItCan)
{
    State state;
    state.sequence = 1;
    state.intention = {{1.0, -1.0, 0.123456}};
    state.intention_velocity = {{100.0, -100.0, 0.12345}};
    const auto decoded = decode(encode(state).bytes());
    ASSERT_TRUE(decoded);
    const State& said = std::get<State>(*decoded);
    EXPECT_DOUBLE_EQ(said.intention.x(), 0.32767);
    EXPECT_DOUBLE_EQ(said.intention.y(), -0.32767);
    EXPECT_NEAR(said.intention.z(), 0.123456, 0.5e-5);
    EXPECT_DOUBLE_EQ(said.intention_velocity.x(), 6.5534);
    EXPECT_NEAR(said.intention_velocity.z(), 0.12345, 1e-4);
}

TEST(Boot, IsTheHashOfItsNameAndNeverZero)
{
    EXPECT_EQ(boot_of(""), 0U);
    EXPECT_NE(boot_of("a"), 0U);
    EXPECT_NE(boot_of("a"), boot_of("b"));
    EXPECT_EQ(boot_of("9f2c"), boot_of("9f2c"));
}

TEST(Sums, AreSubtractedModuloTwoToThe32)
{
    EXPECT_EQ(difference({5, 0, 0x8000'0000}, {3, 0xffff'ffff, 0x7fff'ffff}),
              (std::array<std::int32_t, 3>{2, 1, 1}));
    EXPECT_EQ(difference({0xffff'fff0, 0, 0}, {0, 1, 0}),
              (std::array<std::int32_t, 3>{-16, -1, 0}));
}

TEST(Orientation, IsWithinFourMicroradiansOfWhatWasSaid)
{
    const auto stream = base::Seed{5}.stream("orientation");
    for (std::uint64_t i = 0; i < 10'000; ++i) {
        const auto component = [&](std::uint32_t n) { return 2.0 * stream.uniform(i, n) - 1.0; };
        const glm::dquat q =
            glm::normalize(glm::dquat{component(0), component(1), component(2), component(3)});
        const Orientation said = Orientation::from(q);
        EXPECT_EQ(Orientation::from_code(said.code()), said);
        const glm::dquat apart = glm::conjugate(q) * said.quaternion();
        const double half = std::sqrt(apart.x * apart.x + apart.y * apart.y + apart.z * apart.z);
        ASSERT_LT(2.0 * half, 4e-6);
    }
    EXPECT_EQ(Orientation{}.quaternion(), (glm::dquat{1.0, 0.0, 0.0, 0.0}));
    EXPECT_EQ(Orientation::from({1.0, 0.0, 0.0, 0.0}), Orientation{});
}

TEST(Orientation, HasNoOtherCodes)
{
    const std::uint64_t upright = Orientation{}.code();
    EXPECT_TRUE(Orientation::from_code(upright));
    EXPECT_FALSE(Orientation::from_code(upright | std::uint64_t{1} << 62));
    EXPECT_FALSE(Orientation::from_code(upright & ~std::uint64_t{0xfffff}));
    EXPECT_FALSE(Orientation::from_code(0x0fff'ffff'ffff'ffffU)); // longer than 1
}

} // namespace
} // namespace hapnet::wire
