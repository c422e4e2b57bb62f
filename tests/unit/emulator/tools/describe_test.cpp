// SPDX-FileCopyrightText: 2026 The Hapnet authors
// SPDX-License-Identifier: MIT
#include "emulator/tools/describe.hpp"

#include "emulator/core/profile/profile.hpp"

#include <gtest/gtest.h>

namespace hapnet::emulator::tools {
namespace {

using namespace std::chrono_literals;

Conditions traced(const char* csv)
{
    Conditions conditions;
    conditions.delay.law = TraceLaw{"x.csv", *parse_delay_trace(csv)};
    return conditions;
}

std::string words_for(const Conditions& conditions)
{
    const Stream stream{.packets = 20'000};
    std::string text;
    for (const auto& line : describe(conditions, stream)) text += line + "\n";
    const auto prediction =
        predict({"", base::Seed{1}, {conditions, conditions}, {}}, stream, base::Seed{1});
    for (const auto& line : warnings(conditions, stream, prediction.up)) text += line + "\n";
    return text;
}

TEST(Describe, SaysOfADelayTraceHowItsValuesAreFoundAndNotThatEachDatagramIsOnItsOwn)
{
    const auto by_time = words_for(traced("time_s,delay_ms\n0,140\n0.5,160\n1,120\n1.5,150\n"));
    EXPECT_NE(by_time.find("each datagram as its time in the file says"), std::string::npos);
    EXPECT_EQ(by_time.find("on its own"), std::string::npos);
    const auto by_number = words_for(traced("delay_ms\n140\n160\n120\n"));
    EXPECT_NE(by_number.find("the n-th datagram as the n-th value says"), std::string::npos);
}

TEST(Describe, AdvisesACorrelationTimeWhereOneIsTakenAndNotForATrace)
{
    Conditions jitter;
    jitter.delay = constant(40ms);
    jitter.jitter = uniform(15ms);
    EXPECT_NE(words_for(jitter).find("a correlation_time (100ms, say)"), std::string::npos);
    const auto words = words_for(traced("time_s,delay_ms\n0,140\n0.5,160\n1,120\n1.5,150\n"));
    EXPECT_NE(words.find("keeping the order makes the mean"), std::string::npos) << words;
    EXPECT_EQ(words.find("correlation_time"), std::string::npos) << words;
}

} // namespace
} // namespace hapnet::emulator::tools
