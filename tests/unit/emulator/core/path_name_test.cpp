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

} // namespace
} // namespace hapnet::emulator::path_name_test
