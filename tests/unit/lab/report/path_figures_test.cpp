// SPDX-FileCopyrightText: 2026 The Hapnet authors
// SPDX-License-Identifier: MIT
#include "lab/report/path_figures.hpp"

#include <gtest/gtest.h>

namespace hapnet::lab::report {
namespace {

using records::DelaySpan;
using records::PathsOverTime;

/// A to B: half is lost in the first second, all in the second. B to A: nothing arrived.
PathsOverTime half_then_all()
{
    return {.stretch_s = 1.0,
            .a_to_b = {.stretches = {{.from_s = 0.0,
                                      .to_s = 1.0,
                                      .sent = 4,
                                      .received = 2,
                                      .delay_ms = DelaySpan{10.0, 10.0, 30.0}},
                                     {.from_s = 1.0, .to_s = 2.0, .sent = 3, .received = 0},
                                     {.from_s = 2.0, .to_s = 3.0, .sent = 0, .received = 0},
                                     {.from_s = 3.0,
                                      .to_s = 4.0,
                                      .sent = 2,
                                      .received = 2,
                                      .delay_ms = DelaySpan{20.0, 20.0, 20.0}}},
                       .delays_ms = {10.0, 30.0, 20.0, 20.0}},
            .b_to_a = {}};
}

TEST(PathFigures, DrawTheMedianWithItsBandAndNothingWhereNoMessageCame)
{
    const auto figures = path_figures(half_then_all(), "the end of it");
    ASSERT_EQ(figures.size(), 2U);
    const auto delay = page::json_of(figures[0]);
    EXPECT_EQ(delay["id"], "delay");
    EXPECT_EQ(delay["y"].dump(), R"({"label":"delay","unit":"ms","range":[0.0,0.0]})");
    ASSERT_EQ(delay["series"].size(), 2U) << "a part before the gap and one behind it";
    EXPECT_EQ(delay["series"][0]["name"], "A to B");
    EXPECT_EQ(delay["series"][0]["points"].dump(), "[[0.5,10.0]]");
    EXPECT_EQ(delay["series"][0]["band"].dump(), "[[0.5,10.0,30.0]]");
    EXPECT_EQ(delay["series"][1]["points"].dump(), "[[3.5,20.0]]");
    EXPECT_TRUE(delay["caption"].get<std::string>().starts_with(
        "From the sender’s stamp to the end of it, "));
}

TEST(PathFigures, DrawTheLossOfEachStretchAsAStair)
{
    const auto loss = page::json_of(path_figures(half_then_all(), "it").at(1));
    EXPECT_EQ(loss["id"], "loss");
    ASSERT_EQ(loss["series"].size(), 2U);
    EXPECT_EQ(loss["series"][0]["points"].dump(),
              "[[0.0,50.0],[1.0,50.0],[1.0,100.0],[2.0,100.0]]");
    EXPECT_EQ(loss["series"][1]["points"].dump(), "[[3.0,0.0],[4.0,0.0]]");
}

TEST(PathFigures, ShowTheShareOfTheMessagesThatTookAtMostSoLong)
{
    const auto figures = delay_distribution(half_then_all());
    ASSERT_EQ(figures.size(), 1U);
    const auto series = page::json_of(figures[0])["series"];
    ASSERT_EQ(series.size(), 1U) << "nothing came from B to A";
    EXPECT_EQ(series[0]["points"].dump(), "[[10.0,0.0],[10.0,0.25],[20.0,0.75],[30.0,1.0]]");
}

TEST(PathFigures, AreNotThereWhereNoMessageCame)
{
    EXPECT_TRUE(path_figures({}, "it").empty());
    EXPECT_TRUE(delay_distribution({}).empty());
}

TEST(PathFigures, SayHowManyMessagesSeemToComeBeforeTheyWereSent)
{
    const auto caption_of = [](const PathsOverTime& paths) {
        return page::json_of(path_figures(paths, "it").at(0)).at("caption").get<std::string>();
    };
    PathsOverTime paths = half_then_all();
    EXPECT_EQ(caption_of(paths).find("before they were sent"), std::string::npos);
    paths.b_to_a.delays_ms = {-0.1, 0.1, -0.2};
    EXPECT_NE(caption_of(paths).find(" 2 messages seem to have come before they were sent"),
              std::string::npos);
}

} // namespace
} // namespace hapnet::lab::report
