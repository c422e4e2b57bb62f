// SPDX-FileCopyrightText: 2026 The Hapnet authors
// SPDX-License-Identifier: MIT
#include "proto/control/core/condition.hpp"

#include <gtest/gtest.h>
#include <nlohmann/json.hpp>
#include <optional>
#include <string>

namespace hapnet::control::condition_test {
namespace {

const nlohmann::ordered_json statistics{
    {"up", {{"received", 42}, {"lateness_us", {{"p99", nullptr}}}}},
    {"valid", true},
    {"program", "x"}};

std::optional<double> value(const std::string& condition)
{
    return value_in(statistics, base::parse_condition(condition).value()).value();
}

std::string trouble(const std::string& condition)
{
    const auto found = value_in(statistics, base::parse_condition(condition).value());
    return found ? "" : found.error().message;
}

TEST(Condition, FindsTheNumberThatItIsAbout)
{
    EXPECT_EQ(value("up.received>1"), 42.0);
    EXPECT_EQ(value("valid == true"), 1.0);
    EXPECT_EQ(value("up.lateness_us.p99<1"), std::nullopt);
}

TEST(Condition, IsMetByEqualityOnlyWhereItSaysSo)
{
    EXPECT_TRUE(is_met(base::parse_condition("up.received>=42").value(), statistics).value());
    EXPECT_FALSE(is_met(base::parse_condition("up.received>42").value(), statistics).value());
    EXPECT_FALSE(
        is_met(base::parse_condition("up.lateness_us.p99<=1").value(), statistics).value());
}

TEST(Condition, NamesTheKeysWhereItsOwnLeadsAstray)
{
    EXPECT_NE(trouble("up.recieved>1").find("received"), std::string::npos);
    EXPECT_NE(trouble("up>1").find("has parts"), std::string::npos);
    EXPECT_NE(trouble("program>1").find("not a number"), std::string::npos);
}

} // namespace
} // namespace hapnet::control::condition_test
