// SPDX-FileCopyrightText: 2026 The Hapnet authors
// SPDX-License-Identifier: MIT
#include "proto/cli/schema_command.hpp"

#include <array>
#include <gtest/gtest.h>
#include <string>

namespace hapnet::cli {
namespace {

constexpr const char* written = R"({"title":"Numbers"})";

/// Returns the output of `program schema WORD`, or the error.
std::string said_to(std::string word)
{
    Command program{"program"};
    const SchemaCommand schema{
        program,
        {{.name = "numbers", .written = written}, {.name = "made", .written = {}, .make = [] {
                                                       return std::string{R"({"title":"Made"})"};
                                                   }}}};
    std::string name = "program", command = "schema";
    std::array words{name.data(), command.data(), word.data()};
    const auto parsed = program.parse(std::span{words}.first(word.empty() ? 2 : 3));
    if (!parsed) return parsed.error().message;
    EXPECT_TRUE(schema.is_chosen());
    return schema.text();
}

TEST(SchemaCommand, PrintsTheSchemaOfAName)
{
    EXPECT_EQ(said_to("numbers"), written);
    EXPECT_EQ(said_to("made"), R"({"title":"Made"})");
}

TEST(SchemaCommand, ListsNamesAndTitlesInTheirOrder)
{
    EXPECT_EQ(said_to("--list"), "made         Made\nnumbers      Numbers\n");
    EXPECT_EQ(said_to(""), said_to("--list"));
}

TEST(SchemaCommand, SaysWhichNameWasProbablyMeant)
{
    EXPECT_NE(said_to("number").find("did you mean 'numbers'?"), std::string::npos)
        << said_to("number");
}

} // namespace
} // namespace hapnet::cli
