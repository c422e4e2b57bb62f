// SPDX-FileCopyrightText: 2026 The Hapnet authors
// SPDX-License-Identifier: MIT
#include "proto/output/schema.hpp"

#include <cstdint>
#include <gtest/gtest.h>
#include <optional>
#include <string>
#include <vector>

namespace hapnet::output {
namespace schema_test {

enum class Gait : std::uint8_t { walk, trot };
constexpr auto names_of(base::Tag<Gait>) { return base::names("walk", "trot"); }

struct Saddle {
    int offset_mm = 0;
};
constexpr auto fields_of(base::Tag<Saddle>)
{
    return base::fields("saddle", base::member("offset_mm", &Saddle::offset_mm));
}

struct Horse {
    std::string name;
    std::optional<std::string> owner{};
    Gait gait = Gait::walk;
    std::uint32_t laps = 0;
    double best_s = 0.0;
    std::vector<Saddle> saddles{};
    std::optional<Saddle> spare{};
    std::optional<double> worst_s{};
};
constexpr auto fields_of(base::Tag<Horse>)
{
    return base::fields("horse", base::member("name", &Horse::name, "As it is called."),
                        base::member("owner", &Horse::owner), base::member("gait", &Horse::gait),
                        base::member("laps", &Horse::laps), base::member("best_s", &Horse::best_s),
                        base::member("saddles", &Horse::saddles),
                        base::member("spare", &Horse::spare),
                        base::member("worst_s", &Horse::worst_s));
}

namespace {

TEST(Schema, HasEveryKeyWithItsKindAndItsWords)
{
    const auto schema = nlohmann::json::parse(schema_text<Horse>("A horse"));
    EXPECT_EQ(schema.at("title"), "A horse");
    EXPECT_EQ(schema.at("required").size(), 8U);
    const auto& keys = schema.at("properties");
    EXPECT_EQ(keys.at("name").dump(), R"({"description":"As it is called.","type":"string"})");
    EXPECT_EQ(keys.at("owner").dump(), R"({"type":["string","null"]})");
    EXPECT_EQ(keys.at("gait").dump(), R"({"enum":["walk","trot"]})");
    EXPECT_EQ(keys.at("laps").dump(), R"({"minimum":0,"type":"integer"})");
    // What is not finite is null, so every number may be.
    EXPECT_EQ(keys.at("best_s").dump(), R"({"type":["number","null"]})");
    EXPECT_EQ(keys.at("worst_s").dump(), R"({"type":["number","null"]})");
    EXPECT_EQ(keys.at("saddles").dump(), R"({"items":{"$ref":"#/$defs/saddle"},"type":"array"})");
    EXPECT_EQ(keys.at("spare").dump(), R"({"anyOf":[{"$ref":"#/$defs/saddle"},{"type":"null"}]})");
    EXPECT_EQ(schema.at("$defs").dump(),
              R"({"saddle":{"properties":{"offset_mm":{"type":"integer"}},)"
              R"("required":["offset_mm"],"type":"object"}})");
}

} // namespace
} // namespace schema_test
} // namespace hapnet::output
