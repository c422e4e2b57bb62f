// SPDX-FileCopyrightText: 2026 The Hapnet authors
// SPDX-License-Identifier: MIT
#include "web/core/visitors.hpp"

#include <gtest/gtest.h>
#include <optional>
#include <string>
#include <vector>

namespace hapnet::web::visitors_test {

namespace {

/// The closed connections, in turn.
struct Door {
    std::vector<std::string> closed;

    Visitor visitor(const std::string& name, bool is_idle = true)
    {
        return {.is_idle = [is_idle] { return is_idle; },
                .close = [this, name] { closed.push_back(name); }};
    }
};

using Names = std::vector<std::string>;

} // namespace

TEST(WebVisitors, LeaveRoomWhenTheirVisitsEnd)
{
    Door door;
    Visitors visitors{2};
    const Visit one = visitors.admit(door.visitor("one"));
    {
        const Visit two = visitors.admit(door.visitor("two"));
        EXPECT_EQ(visitors.count(), 2U);
    }
    EXPECT_EQ(visitors.count(), 1U);
    const Visit three = visitors.admit(door.visitor("three"));
    EXPECT_EQ(door.closed, Names{});
}

TEST(WebVisitors, MakeRoomTheOldestIdleOneFirst)
{
    Door door;
    Visitors visitors{3};
    std::vector<Visit> visits;
    visits.push_back(visitors.admit(door.visitor("busy", false)));
    visits.push_back(visitors.admit(door.visitor("idle")));
    visits.push_back(visitors.admit(door.visitor("idle, too")));
    visits.push_back(visitors.admit(door.visitor("also busy", false)));
    EXPECT_EQ(door.closed, Names{"idle"});
    visits.push_back(visitors.admit(door.visitor("busy as well", false)));
    EXPECT_EQ(door.closed.back(), "idle, too");
    visits.push_back(visitors.admit(door.visitor("last")));
    EXPECT_EQ(door.closed.back(), "busy"); // none was idle
    EXPECT_EQ(visitors.count(), 3U);
}

TEST(WebVisitors, MayEndTheirVisitWhenTheyAreClosedAndOutliveTheOthers)
{
    std::optional<Visitors> visitors{1};
    std::optional<Visit> first;
    bool is_closed = false;
    first.emplace(visitors->admit({.is_idle = [] { return true; },
                                   .close =
                                       [&] {
                                           is_closed = true;
                                           first.reset();
                                       }}));
    const Visit second = visitors->admit({.is_idle = [] { return true; }, .close = [] {}});
    EXPECT_TRUE(is_closed);
    EXPECT_EQ(visitors->count(), 1U);
    visitors->close_all();
    EXPECT_EQ(visitors->count(), 0U);
    visitors.reset();
}

} // namespace hapnet::web::visitors_test
