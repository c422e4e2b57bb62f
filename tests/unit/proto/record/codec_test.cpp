// SPDX-FileCopyrightText: 2026 The Hapnet authors
// SPDX-License-Identifier: MIT
#include "proto/record/codec.hpp"

#include <gtest/gtest.h>
#include <limits>

namespace hapnet::record {
namespace {

using namespace std::chrono_literals;

std::uint8_t at(const RowBytes& bytes, std::size_t index)
{
    return std::to_integer<std::uint8_t>(bytes.at(index));
}

TEST(RecordCodec, PutsFieldsLittleEndianAtTheOffsetsOfVersion3)
{
    TickRow row;
    row.tick = 0x0102030405060708;
    row.due = base::TimePoint{256ns};
    row.late = -1ns;
    row.sent_sequence = 7;
    row.phase = Phase::running;
    row.remote_fresh = true;
    row.hip = {{1.0, 0.0, 0.0}};
    row.sample_sequence = 0xfe;
    const RowBytes bytes = encode(row);
    EXPECT_EQ(at(bytes, 0), 1); // a tick row
    EXPECT_EQ(at(bytes, 1), 8); // tick
    EXPECT_EQ(at(bytes, 8), 1);
    EXPECT_EQ(at(bytes, 10), 1);    // due
    EXPECT_EQ(at(bytes, 17), 255);  // late
    EXPECT_EQ(at(bytes, 29), 7);    // sent_sequence
    EXPECT_EQ(at(bytes, 33), 2);    // phase
    EXPECT_EQ(at(bytes, 36), 1);    // remote_fresh
    EXPECT_EQ(at(bytes, 43), 0xf0); // hip: 1.0 is 0x3ff0000000000000
    EXPECT_EQ(at(bytes, 44), 0x3f);
    EXPECT_EQ(at(bytes, 207), 1);    // calibrated
    EXPECT_EQ(at(bytes, 212), 0xfe); // sample_sequence
    EXPECT_EQ(at(bytes, 215), 0);    // after the last field
}

TEST(RecordCodec, RefusesAnUnknownKindOfRow)
{
    RowBytes bytes(row_bytes);
    EXPECT_EQ(decode(bytes).error().message, "unknown kind of row 0");
    bytes[0] = std::byte{5};
    EXPECT_EQ(decode(bytes).error().message, "unknown kind of row 5");
    bytes[0] = std::byte{4}; // one that versions 4 and 5 have
    EXPECT_EQ(decode(bytes).error().message, "unknown kind of row 4");
}

TEST(RecordCodec, RefusesAPhaseThatDoesNotExist)
{
    RowBytes bytes = encode(TickRow{});
    bytes[33] = std::byte{6};
    EXPECT_EQ(decode(bytes).error().message, "impossible value of 'phase' in a tick row");
}

TEST(RecordCodec, RefusesATruthOtherThan0Or1)
{
    RowBytes bytes = encode(TickRow{});
    bytes[34] = std::byte{2};
    EXPECT_EQ(decode(bytes).error().message, "impossible value of 'touching' in a tick row");
}

TEST(RecordCodec, RefusesATimeThatNoClockReads)
{
    RowBytes bytes = encode(TickRow{});
    bytes[16] = std::byte{0x10}; // due: 2^60 ns
    EXPECT_TRUE(decode(bytes));
    bytes[9] = std::byte{1};
    EXPECT_EQ(decode(bytes).error().message, "impossible value of 'due' in a tick row");
    bytes[16] = std::byte{0x80};
    EXPECT_EQ(decode(bytes).error().message, "impossible value of 'due' in a tick row");
}

TEST(RecordCodec, RefusesPaddingThatIsNotZero)
{
    RowBytes bytes = encode(SessionRow{});
    bytes.back() = std::byte{1};
    EXPECT_EQ(decode(bytes).error().message, "padding of a session row is not zero");
}

TEST(RecordCodec, PutsAMessageBehindItsLength)
{
    MessageRow row;
    row.tick = 5;
    row.from = 0x0203;
    row.bytes = {std::byte{8}, std::byte{9}};
    const auto layout = Layout::for_messages_of(4);
    const RowBytes bytes = encode(row, layout);
    ASSERT_EQ(bytes.size(), 25U);
    EXPECT_EQ(at(bytes, 0), 2); // a message row
    EXPECT_EQ(at(bytes, 17), 3);
    EXPECT_EQ(at(bytes, 18), 2);
    EXPECT_EQ(at(bytes, 19), 2); // its length
    EXPECT_EQ(at(bytes, 21), 8);
    EXPECT_EQ(at(bytes, 22), 9);
    EXPECT_EQ(decode(bytes, layout).value(), Row{row});
}

TEST(RecordCodec, RefusesAMessageLongerThanItsRow)
{
    MessageRow row;
    row.bytes.resize(140);
    const auto layout = Layout::for_messages_of(140);
    RowBytes bytes = encode(row, layout);
    EXPECT_TRUE(decode(bytes, layout));
    bytes[19] = std::byte{141};
    EXPECT_EQ(decode(bytes, layout).error().message, "a message longer than its row");
}

TEST(RecordCodec, RefusesBytesBehindAMessageThatAreNotZero)
{
    MessageRow row;
    row.bytes.resize(3);
    RowBytes bytes = encode(row);
    bytes.back() = std::byte{1};
    EXPECT_EQ(decode(bytes).error().message, "padding of a message row is not zero");
}

TEST(RecordCodec, PutsABodyAtTheOffsetsOfVersion5AndNotInVersion3)
{
    const BodyRow row{.tick = 7,
                      .body = 0x0102,
                      .position = {{1.0, 0.0, 0.0}},
                      .orientation = {1.0, 0.0, 0.0, 0.0},
                      .angular_velocity = {{0.0, 0.0, -2.0}},
                      .owner = 0x0305};
    const auto layout = Layout{}.with_bodies();
    const RowBytes bytes = encode(row, layout);
    ASSERT_EQ(bytes.size(), body_row_bytes);
    EXPECT_EQ(at(bytes, 0), 4); // a body row
    EXPECT_EQ(at(bytes, 1), 7);
    EXPECT_EQ(at(bytes, 9), 2); // its number
    EXPECT_EQ(at(bytes, 10), 1);
    EXPECT_EQ(at(bytes, 18), 0x3f);  // x of its position
    EXPECT_EQ(at(bytes, 66), 0x3f);  // w of its orientation
    EXPECT_EQ(at(bytes, 114), 0xc0); // z of its angular velocity
    EXPECT_EQ(at(bytes, 115), 5);    // its owner
    EXPECT_EQ(at(bytes, 116), 3);
    EXPECT_EQ(decode(bytes, layout).value(), Row{row});
    EXPECT_FALSE(decode(bytes)) << "version 3 has no such row";
}

TEST(RecordCodec, ReadsTheBodiesOfVersion4AsOwnedByNobodyInParticular)
{
    const auto layout = Layout::of_version_4();
    const BodyRow row{.tick = 7, .body = 2, .angular_velocity = {{0.0, 0.0, -2.0}}};
    BodyRow owned = row;
    owned.owner = 3;
    const RowBytes bytes = encode(owned, layout);
    ASSERT_EQ(bytes.size(), 115U);
    EXPECT_EQ(at(bytes, 114), 0xc0);
    EXPECT_EQ(decode(bytes, layout).value(), Row{row});
    EXPECT_FALSE(decode(bytes, Layout{}.with_bodies()));
}

TEST(RecordCodec, ReadsTheRowsOfVersion2AsOfNobodyInParticular)
{
    const auto layout = Layout::of_version_2();
    MessageRow message;
    message.bytes.assign(160, std::byte{7});
    RowBytes bytes = encode(message, layout);
    ASSERT_EQ(bytes.size(), row_bytes);
    EXPECT_EQ(at(bytes, 17), 160); // its length: there was nothing before it
    EXPECT_EQ(at(bytes, 19), 7);
    EXPECT_EQ(decode(bytes, layout).value(), Row{message});
    SessionRow session;
    session.seed = 3;
    bytes = encode(session, layout);
    EXPECT_EQ(at(bytes, 37), 3);
    EXPECT_EQ(decode(bytes, layout).value(), Row{session});
    session.other = 2;
    EXPECT_EQ(std::get<SessionRow>(decode(encode(session, layout), layout).value()).other, 0);
    bytes[45] = std::byte{1}; // where `other` is now
    EXPECT_FALSE(decode(bytes, layout));
}

TEST(RecordCodec, RefusesBytesThatAreNotOneWholeRow)
{
    const RowBytes bytes = encode(TickRow{});
    EXPECT_FALSE(decode(std::span{bytes}.first(row_bytes - 1)));
    EXPECT_FALSE(decode({}));
}

TEST(RecordCodec, KeepsForcesThatAreNotFiniteBecauseTheyAreEvidence)
{
    TickRow row;
    row.contact = {{std::numeric_limits<double>::quiet_NaN(), 0.0, 0.0}};
    const auto again = decode(encode(row));
    ASSERT_TRUE(again);
    EXPECT_FALSE(base::is_finite(std::get<TickRow>(*again).contact));
}

} // namespace
} // namespace hapnet::record
