// SPDX-FileCopyrightText: 2026 The Hapnet authors
// SPDX-License-Identifier: MIT
#include "emulator/core/path_name.hpp"

#include <gtest/gtest.h>

namespace hapnet::emulator::path_name_test {
namespace {

TEST(PathName, CallsItsWaysByTheirPeersOrByUpAndDown)
{
    EXPECT_EQ(way_name("", Direction::up), "up");
    EXPECT_EQ(way_name("1-2", Direction::up), "1-2");
    EXPECT_EQ(way_name("1-2", Direction::down), "2-1");
    EXPECT_EQ(way_name("wan", Direction::down), "wan.down");
    EXPECT_EQ(way_name("client.3", Direction::up), "client.3.up");
    EXPECT_EQ(stream_name("", Direction::down), "down");
    EXPECT_EQ(stream_name("1-12", Direction::down), "12-1");
    EXPECT_EQ(way_name("a-c", Direction::down), "a-c.down");
    EXPECT_EQ(stream_name("a-c", Direction::up), "a-c/up");
    EXPECT_EQ(way_between("c", "a"), (Way{"a-c", Direction::down}));
    EXPECT_EQ(way_between("a", "c"), (Way{"a-c", Direction::up}));
    EXPECT_EQ(way_between("12", "2"), (Way{"2-12", Direction::down}));
    EXPECT_EQ(stream_name("wan", Direction::up), "wan/up");
    EXPECT_EQ(stream_name("client.3", Direction::up), "client/3/up");
    EXPECT_EQ(stream_name(client_path("10.0.0.1:5000"), Direction::up), "client/10.0.0.1:5000/up");
}

TEST(PathName, SaysForPeopleFromWhereToWhereAWayLeads)
{
    EXPECT_EQ(way_in_words("", Direction::down), "down: from B to A");
    EXPECT_EQ(way_in_words("1-12", Direction::up), "1-12: from 1 to 12");
    EXPECT_EQ(way_in_words("1-12", Direction::down), "12-1: from 12 to 1");
    EXPECT_EQ(way_in_words("wan", Direction::up), "wan.up");
    EXPECT_EQ(way_in_words("client.3", Direction::down), "client.3.down: from the server");
}

TEST(PathName, IsReadFromTheBeginningOfAKeyWhichNamesItsWay)
{
    for (const std::string_view path : {"", "1-2", "wan", "client.3", "client.10.0.0.1:5000"}) {
        for (const Direction direction : {Direction::up, Direction::down}) {
            EXPECT_EQ(parse_way(way_name(path, direction)), (Way{std::string{path}, direction}));
        }
    }
    EXPECT_EQ(parse_way("all"), Way{});
    EXPECT_EQ(parse_way("wan.both"), (Way{"wan", std::nullopt}));
    for (const char* const wrong : {"1-1", "0-1", "01-2", "1-", "link", "client", "client.", "2wan",
                                    "wan.left", "loss", "1-2.up", "\xc3\xa4"}) {
        EXPECT_EQ(parse_way(wrong), std::nullopt) << wrong;
    }
}

TEST(PathName, CallsTheWaysOfFlowsByTheirPathsAndTheirNames)
{
    EXPECT_EQ(flow_path("", "voice"), "flow.voice");
    EXPECT_EQ(flow_path("client.3", "voice"), "client.3.flow.voice");
    EXPECT_EQ(flow_path("wan", ""), "wan");
    EXPECT_EQ(way_name("flow.voice", Direction::up), "flow.voice.up");
    EXPECT_EQ(way_name("1-2.flow.voice", Direction::up), "1-2.flow.voice");
    EXPECT_EQ(way_name("1-2.flow.voice", Direction::down), "2-1.flow.voice");
    EXPECT_EQ(stream_name("flow.voice", Direction::up), "flow/voice/up");
    EXPECT_EQ(stream_name("1-2.flow.voice", Direction::down), "2-1/flow/voice");
    EXPECT_EQ(stream_name("wan.flow.voice", Direction::up), "wan/flow/voice/up");
    EXPECT_EQ(stream_name("client.10.0.0.1:5000.flow.voice", Direction::up),
              "client/10.0.0.1:5000/flow/voice/up");
    EXPECT_EQ(way_in_words("flow.voice", Direction::up), "flow.voice.up: from A to B");
    EXPECT_EQ(way_in_words("1-2.flow.voice", Direction::down), "2-1.flow.voice: from 2 to 1");
    EXPECT_EQ(common_name("client.3.flow.voice"), "flow.voice");
    EXPECT_EQ(common_name("flow.voice"), "flow.voice");
    EXPECT_EQ(common_name("client.3"), "");
}

TEST(PathName, IsReadWithItsFlowBehindIt)
{
    for (const std::string_view path : {"flow.voice", "1-2.flow.voice", "wan.flow.a-1",
                                        "client.3.flow.voice", "client.10.0.0.1:5000.flow.x"}) {
        for (const Direction direction : {Direction::up, Direction::down}) {
            EXPECT_EQ(parse_way(way_name(path, direction)), (Way{std::string{path}, direction}));
        }
    }
    EXPECT_EQ(parse_way("flow.voice"), (Way{"flow.voice", std::nullopt}));
    EXPECT_EQ(parse_way("client.3.flow.voice.both"), (Way{"client.3.flow.voice", std::nullopt}));
    for (const char* const wrong :
         {"flow", "flow.", "flow.up", "flow.Voice", "flow.voice.left", "flow.voice.all",
          "1-2.flow.voice.up", "wan.up.flow.voice", "link.flow.voice", "flow.a.flow.b"}) {
        EXPECT_EQ(parse_way(wrong), std::nullopt) << wrong;
    }
}

TEST(PathName, OfAFlowThatIsNotThereIsRefusedWithTheNearest)
{
    const PathNames names{.links = {"1-2"}, .flows = {"voice", "ssh"}};
    EXPECT_TRUE(names.contains("flow.voice"));
    EXPECT_TRUE(names.contains("1-2.flow.ssh"));
    EXPECT_FALSE(names.contains("1-3.flow.ssh"));
    EXPECT_FALSE(names.contains("flow.voise"));
    EXPECT_EQ(names.refusal("flow.voise"), "there is no flow 'voise': did you mean 'voice'?");
    EXPECT_EQ(names.refusal("1-3.flow.ssh"), "there is no link 1-3: use one of 1-2");
    EXPECT_EQ(PathNames{}.refusal("flow.x"),
              "there is no flow 'x': a profile describes flows by [[flow]]");
}

} // namespace
} // namespace hapnet::emulator::path_name_test
