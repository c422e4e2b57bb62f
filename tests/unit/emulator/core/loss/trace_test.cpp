// SPDX-FileCopyrightText: 2026 The Hapnet authors
// SPDX-License-Identifier: MIT
#include "emulator/core/loss/trace.hpp"

#include "tests/unit/emulator/core/loss/running.hpp"

#include <gtest/gtest.h>
#include <memory>
#include <string>

namespace hapnet::emulator {

namespace {

using test::losses;
using test::refusal;

} // namespace

TEST(LossTrace, IsReadFromLinesOrFromARow)
{
    const auto rows = parse_loss_trace("# a walk\n0\n1\r\n 1\n\n0 # the last\n").value();
    EXPECT_EQ(rows, parse_loss_trace("01 10").value());
    EXPECT_EQ(rows.size(), 4U);
    EXPECT_EQ(rows.losses(), 2U);
}

TEST(LossTrace, NamesTheLineThatItCannotRead)
{
    EXPECT_EQ(parse_loss_trace("0\n1\n2\n").error().message,
              "line 3: a trace of losses holds 0 (arrived) and 1 (lost) only");
    EXPECT_EQ(parse_loss_trace(" # nothing\n").error().message,
              "a trace of losses with no datagram in it");
}

TEST(LossTrace, IsReadFromTheColumnOfATable)
{
    EXPECT_EQ(parse_loss_table("number,lost,delay\n0,1,2\n1,0,3\r\n2,0,4\n").value(),
              parse_loss_trace("100").value());
    EXPECT_EQ(parse_loss_table("\"number\";\"lost\"\n\"0\";\"1\"\n\"1\";\"0\"\n").value(),
              parse_loss_trace("10").value());
    EXPECT_EQ(parse_loss_table("a,b\n").error().message,
              "line 1: no column is named lost: rename one, or say which it is, such as columns "
              "\"lost=b\"");
    EXPECT_EQ(parse_loss_table("a,lost\n0,1\n1\n").error().message,
              "line 3: 1 cell where the header has 2");
    EXPECT_EQ(parse_loss_table("a,lost\n0,0.5\n").error().message,
              "line 2: lost 0.5 is neither 0 (arrived) nor 1 (lost)");
}

TEST(LossTrace, HasABound)
{
    const std::string text(LossTrace::datagrams_max, '0');
    EXPECT_TRUE(parse_loss_trace(text));
    EXPECT_EQ(parse_loss_trace(text + "\n1").error().message,
              "line 2: more than 10000000 datagrams in a trace of losses");
}

TEST(TraceLoss, BeginsAgainAtItsEnd)
{
    const auto trace = std::make_shared<const LossTrace>(parse_loss_trace("110").value());
    EXPECT_EQ(losses(TraceLoss{"", trace}, 8), "11011011");
}

TEST(TraceLoss, IsEqualWhenItsFileAndItsContentsAre)
{
    const auto made = [](const char* text) {
        return std::make_shared<const LossTrace>(parse_loss_trace(text).value());
    };
    EXPECT_EQ((TraceLoss{"a", made("110")}), (TraceLoss{"a", made("1 1\n0")}));
    EXPECT_NE((TraceLoss{"a", made("110")}), (TraceLoss{"a", made("111")}));
    EXPECT_NE((TraceLoss{"a", made("110")}), (TraceLoss{"b", made("110")}));
}

TEST(TraceLoss, WantsItsTrace) { EXPECT_NE(refusal(TraceLoss{}), ""); }

} // namespace hapnet::emulator
