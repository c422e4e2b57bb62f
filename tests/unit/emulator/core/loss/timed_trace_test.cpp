// SPDX-FileCopyrightText: 2026 The Hapnet authors
// SPDX-License-Identifier: MIT
#include "emulator/core/loss/timed_trace.hpp"

#include "tests/unit/emulator/core/loss/running.hpp"

#include <algorithm>
#include <cmath>
#include <gtest/gtest.h>
#include <memory>
#include <string>

namespace hapnet::emulator {

namespace {

using namespace std::chrono_literals;
using test::losses;

TimedTraceLoss made(std::string_view text)
{
    return {"x.csv", std::make_shared<const LossSeries>(parse_loss_series(text).value())};
}

} // namespace

TEST(TimedTraceLoss, LosesWhatItsTimeSays)
{
    const auto law = made("t_ms,loss\n0,1\n3,0\n5,1\n");
    EXPECT_EQ(losses(law, 14), "11100111110011");
    auto once = law;
    once.timing.repeat = false;
    EXPECT_EQ(losses(once, 14), "11100111111111");
    auto later = law;
    later.timing.offset = 2ms;
    EXPECT_EQ(losses(later, 6), "100111");
}

TEST(TimedTraceLoss, TakesALostPingForALoss)
{
    EXPECT_EQ(losses(made("t_ms,delay_ms\n0,10\n1,\n2,12\n3,lost\n"), 5), "01010");
}

TEST(TimedTraceLoss, DrawsTheShareOnAStraightLine)
{
    auto law = made("t_s,loss_percent\n0,0\n10,100\n");
    law.interpolate = Interpolation::linear;
    const auto text = losses(law, 10'000);
    const auto lost = std::count(text.begin(), text.end(), '1');
    // Its variance is that of losses with the shares i / n: the sum of p (1 - p), n / 6.
    EXPECT_NEAR(static_cast<double>(lost), 5000.0, 5 * std::sqrt(10'000 / 6.0));
    EXPECT_GT(std::count(text.begin() + 5000, text.end(), '1'), 3500);
    const auto theory = law.theory({1ms, 10'000});
    EXPECT_NEAR(theory.share, 0.5, 1e-3);
    EXPECT_NEAR(theory.variance_inflation, 2.0 / 3.0, 1e-3);
}

TEST(TimedTraceLoss, NamesWhatItCannotRead)
{
    const auto error = [](std::string_view text) {
        return parse_loss_series(text).error().message;
    };
    EXPECT_EQ(error("loss\n0\n"), std::string{without_times});
    EXPECT_EQ(
        error("t_s,x\n0,1\n"),
        "line 1: no column is named loss or loss_percent: rename one, or say which it is, such as "
        "columns \"loss=x:share\"");
    EXPECT_NE(test::refusal(TimedTraceLoss{}), "");
}

TEST(TraceLoss, TakesALostPingForALoss)
{
    EXPECT_EQ(parse_loss_table("delay_ms,x\n10,1\n-,2\n12,3\n").value(),
              parse_loss_trace("010").value());
    EXPECT_EQ(parse_loss_table("rtt,gone\n10,1\n-,0\n", {*parse_columns("lost=gone")}).value(),
              parse_loss_trace("10").value());
    EXPECT_EQ(parse_loss_table("rtt,x\n10,1\n-,0\n", {*parse_columns("delay=rtt:ms")}).value(),
              parse_loss_trace("01").value());
}

} // namespace hapnet::emulator
