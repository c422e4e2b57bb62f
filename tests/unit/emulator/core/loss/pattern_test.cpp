// SPDX-FileCopyrightText: 2026 The Hapnet authors
// SPDX-License-Identifier: MIT
#include "emulator/core/loss/pattern.hpp"

#include "tests/unit/emulator/core/loss/running.hpp"

#include <gtest/gtest.h>
#include <vector>

namespace hapnet::emulator {

namespace {

using test::losses;
using test::refusal;

} // namespace

TEST(PatternLoss, RepeatsItsPattern)
{
    EXPECT_EQ(losses(PatternLoss{parse_pattern("0010").value()}, 10), "0010001000");
}

TEST(PatternLoss, WantsAPattern) { EXPECT_NE(refusal(PatternLoss{}), ""); }

TEST(Pattern, IsReadAndPrintedAsDigits)
{
    EXPECT_EQ(parse_pattern("0010").value(), (std::vector<bool>{false, false, true, false}));
    EXPECT_EQ(to_text(parse_pattern("0010").value()), "0010");
    for (const char* wrong : {"", "012", "0 1"}) EXPECT_FALSE(parse_pattern(wrong)) << wrong;
}

} // namespace hapnet::emulator
