// SPDX-FileCopyrightText: 2026 The Hapnet authors
// SPDX-License-Identifier: MIT
#include "proto/control/core/request.hpp"

#include <gtest/gtest.h>
#include <string>

namespace hapnet::control {
namespace {

std::string refusal_of(const std::string& line)
{
    const auto json = parse_object(line);
    return json ? "" : json.error().message;
}

/// {"0":1,"1":1,...}
std::string object_of(std::size_t members)
{
    std::string text = "{";
    for (std::size_t i = 0; i < members; ++i) {
        text += (i > 0 ? ",\"" : "\"") + std::to_string(i) + "\":1";
    }
    return text + "}";
}

TEST(ControlRequest, HasABoundedNumberOfValues)
{
    EXPECT_EQ(refusal_of(object_of(values_max - 1)), ""); // the object counts as a value
    EXPECT_EQ(refusal_of(object_of(values_max)), "more than 512 values");
    EXPECT_EQ(refusal_of(object_of(90'000)), "more than 512 values");
    EXPECT_EQ(refusal_of("{\"a\":[" + std::string(2000, '1').replace(1, 1998, "") + "]}"), "");
    std::string list = "{\"a\":[1";
    for (int i = 0; i < 2000; ++i) list += ",1";
    EXPECT_EQ(refusal_of(list + "]}"), "more than 512 values");
}

TEST(ControlRequest, NestsABoundedDepth)
{
    const auto nested = [](std::size_t depth) {
        return "{\"a\":" + std::string(depth, '[') + std::string(depth, ']') + "}";
    };
    EXPECT_EQ(refusal_of(nested(nesting_max)), "");
    EXPECT_EQ(refusal_of(nested(nesting_max + 1)), "nested too deeply");
    EXPECT_EQ(refusal_of(nested(400'000)), "nested too deeply");
}

TEST(ControlRequest, SaysNothingTwice)
{
    EXPECT_EQ(refusal_of(R"({"a":1,"b":{"a":1},"a":2})"), "'a' stands twice");
}

} // namespace
} // namespace hapnet::control
