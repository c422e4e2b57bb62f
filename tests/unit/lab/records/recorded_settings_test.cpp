// SPDX-FileCopyrightText: 2026 The Hapnet authors
// SPDX-License-Identifier: MIT
#include "lab/records/recorded_settings.hpp"

#include "proto/wire/message.hpp"

#include <gtest/gtest.h>
#include <string>

namespace hapnet::lab::records {
namespace {

std::string refusal_of(const nlohmann::json& config)
{
    const auto fine = check_wire(config);
    return fine ? "" : fine.error().message;
}

TEST(CheckWire, TakesRecordsOfThisVersionAndOfOtherPrograms)
{
    EXPECT_EQ(refusal_of({{"program", "hapnet-peer"}, {"wire", wire::protocol_version}}), "");
    EXPECT_EQ(refusal_of({{"program", "hapnet-lab"}}), "");
    EXPECT_EQ(refusal_of(nlohmann::json::object()), "");
}

TEST(CheckWire, RefusesAnotherVersionAndValuesOfAnotherType)
{
    EXPECT_EQ(refusal_of({{"program", "hapnet-peer"}, {"wire", 99}})
                  .rfind("its messages are of version 99 of the wire", 0),
              0U);
    EXPECT_EQ(refusal_of({{"program", "hapnet-peer"}})
                  .rfind("its messages are of version 1 of the wire", 0),
              0U);
    for (const auto& wrong : {nlohmann::json{}, nlohmann::json::array(), nlohmann::json{-1}})
        EXPECT_EQ(refusal_of({{"program", wrong}}), "its config: 'program' is not a text");
    for (const auto& wrong : {nlohmann::json{}, nlohmann::json::array(), nlohmann::json{"x"}})
        EXPECT_EQ(refusal_of({{"program", "hapnet-peer"}, {"wire", wrong}}),
                  "its config: 'wire' is not a whole number");
}

} // namespace
} // namespace hapnet::lab::records
