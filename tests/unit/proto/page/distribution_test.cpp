// SPDX-FileCopyrightText: 2026 The Hapnet authors
// SPDX-License-Identifier: MIT
#include "proto/page/distribution.hpp"

#include <array>
#include <cmath>
#include <gtest/gtest.h>

namespace hapnet::page {
namespace {

std::string text_of(const std::vector<Point>& points)
{
    return json_of(Figure{.id = "f",
                          .title = "",
                          .x = {},
                          .y = {},
                          .content = Curves{{{.name = "", .colour = "left", .points = points}}}})
        .at("series")[0]
        .at("points")
        .dump();
}

constexpr std::array bins{Bin{1.0, 2.0, 1.0}, Bin{2.0, 4.0, 6.0}, Bin{5.0, 6.0, 1.0}};

TEST(Bins, ThatAreWideEnoughStay)
{
    const std::vector<Bin> wide{{0.0, 1.0, 3.0}, {5.0, 6.0, 1.0}};
    const auto same = without_narrow(wide);
    ASSERT_EQ(same.size(), 2U);
    EXPECT_EQ(same[1].low, 5.0);
    EXPECT_EQ(same[1].count, 1.0);
    EXPECT_TRUE(without_narrow({}).empty());
}

TEST(Bins, ThatAreTooNarrowBecomeEvenOnesWithAllThatWasCounted)
{
    // A few values at zero would be a density of thousands.
    const auto even = without_narrow({{0.0, 1e-6, 4.0}, {10.0, 20.0, 96.0}});
    double all = 0.0;
    for (const Bin& bin : even) {
        EXPECT_NEAR(bin.high - bin.low, 0.1, 1e-9);
        all += bin.count;
    }
    EXPECT_NEAR(all, 100.0, 1e-9);
    EXPECT_EQ(even.front().low, 0.0);
    EXPECT_NEAR(even.front().count, 4.0, 1e-9);
    EXPECT_NEAR(even[1].low, 10.0, 1e-9) << "nothing between";
    EXPECT_NEAR(even[1].count, 0.96, 1e-9) << "96 in 100 bins";
}

TEST(Distribution, OfBinsIsADensityWhoseStairsEncloseOne)
{
    const auto stairs = density_of(bins);
    EXPECT_EQ(text_of(stairs), "[[1.0,0.0],[1.0,0.125],[2.0,0.125],[2.0,0.375],[4.0,0.375],"
                               "[4.0,0.0],[5.0,0.0],[5.0,0.125],[6.0,0.125],[6.0,0.0]]");
    double area = 0.0;
    for (std::size_t i = 1; i < stairs.size(); ++i)
        area += (stairs[i].x - stairs[i - 1].x) * (stairs[i].y + stairs[i - 1].y) / 2.0;
    EXPECT_DOUBLE_EQ(area, 1.0);
}

TEST(Distribution, SharesReachOneAtTheEndOfTheLastBin)
{
    EXPECT_EQ(text_of(shares_below(bins)), "[[2.0,0.125],[4.0,0.875],[6.0,1.0]]");
}

TEST(Distribution, OfValuesStepsAtEachOfThemByItsShare)
{
    EXPECT_EQ(text_of(shares_at_most({3.0, 1.0, 3.0, 2.0}, 100)),
              "[[1.0,0.0],[1.0,0.25],[2.0,0.5],[3.0,1.0]]");
    EXPECT_TRUE(shares_at_most({}, 100).empty());
}

TEST(Distribution, OfManyValuesKeepsTheSmallestAndTheLargest)
{
    std::vector<double> values;
    for (int i = 1; i <= 10'000; ++i) values.push_back(i);
    const auto shares = shares_at_most(values, 100);
    EXPECT_LE(shares.size(), 102U);
    EXPECT_EQ(shares.front().x, 1.0);
    EXPECT_EQ(shares.back().x, 10'000.0);
    for (const Point& point : shares) {
        if (point.y > 0.0) {
            EXPECT_DOUBLE_EQ(point.y, point.x / 10'000.0);
        }
    }
}

TEST(Distribution, LatenessStandsAgainstItsBudgetOnALogarithmicAxis)
{
    const Figure figure = lateness_figure(
        "late", "ticks", {{.name = "A", .colour = "left", .points = {{5.0, 1.0}}}}, 1000.0);
    const Json json = json_of(figure);
    EXPECT_EQ(json["x"].dump(), R"({"label":"lateness","unit":"µs","scale":"log"})");
    EXPECT_EQ(json["y"]["label"], "share of the ticks");
    EXPECT_EQ(json["series"][1]["points"].dump(), "[[1000.0,0.0],[1000.0,1.0]]");
    EXPECT_EQ(json["levels"].dump(), R"([{"y":0.99,"name":"99 %"}])");
}

TEST(Distribution, ACurveWithGapsBecomesPartsOfOneName)
{
    const double gap = std::nan("");
    const auto parts = parts_of({.name = "a",
                                 .colour = "left",
                                 .points = {{0, gap}, {1, 5}, {2, 6}, {3, gap}, {4, 7}, {5, gap}},
                                 .band = {{1, {4, 6}}, {2, {5, 7}}, {4, {6, 8}}}});
    ASSERT_EQ(parts.size(), 2U);
    EXPECT_EQ(parts[0].name, "a");
    EXPECT_EQ(parts[1].name, "a");
    EXPECT_EQ(text_of(parts[0].points), "[[1.0,5.0],[2.0,6.0]]");
    EXPECT_EQ(text_of(parts[1].points), "[[4.0,7.0]]");
    ASSERT_EQ(parts[0].band.size(), 2U);
    ASSERT_EQ(parts[1].band.size(), 1U);
    EXPECT_EQ(parts[1].band[0].y.low, 6.0);
    EXPECT_TRUE(parts_of({.name = "b", .colour = "left", .points = {{0, gap}}}).empty());
}

} // namespace
} // namespace hapnet::page
