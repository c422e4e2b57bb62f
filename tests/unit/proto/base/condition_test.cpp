// SPDX-FileCopyrightText: 2026 The Hapnet authors
// SPDX-License-Identifier: MIT
#include "proto/base/condition.hpp"

#include <gtest/gtest.h>

namespace hapnet::base::condition_test {
namespace {

TEST(Condition, HoldsByEqualityOnlyWhereItSaysSo)
{
    EXPECT_TRUE(holds(parse_condition("a>=42").value(), 42.0));
    EXPECT_FALSE(holds(parse_condition("a>42").value(), 42.0));
    EXPECT_TRUE(holds(parse_condition("a != 41").value(), 42.0));
    EXPECT_TRUE(holds(parse_condition("a==true").value(), 1.0));
}

TEST(Condition, PrintsWhatItReads)
{
    for (const char* text : {"up.received>=1000", "a<0.25", "valid==1", "x!=-3"}) {
        EXPECT_EQ(to_text(parse_condition(text).value()), text);
    }
}

} // namespace
} // namespace hapnet::base::condition_test
