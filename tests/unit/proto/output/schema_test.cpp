// SPDX-FileCopyrightText: 2026 The Hapnet authors
// SPDX-License-Identifier: MIT
#include "proto/output/schema.hpp"

#include <array>
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
    // A number that is not finite is null, so every number may be null.
    EXPECT_EQ(keys.at("best_s").dump(), R"({"type":["number","null"]})");
    EXPECT_EQ(keys.at("worst_s").dump(), R"({"type":["number","null"]})");
    EXPECT_EQ(keys.at("saddles").dump(), R"({"items":{"$ref":"#/$defs/saddle"},"type":"array"})");
    EXPECT_EQ(keys.at("spare").dump(), R"({"anyOf":[{"$ref":"#/$defs/saddle"},{"type":"null"}]})");
    EXPECT_EQ(schema.at("$defs").dump(),
              R"({"saddle":{"properties":{"offset_mm":{"type":"integer"}},)"
              R"("required":["offset_mm"],"type":"object"}})");
}

struct Race {
    base::Duration length{};
    std::vector<base::Duration> laps{};
    base::ByName<Gait, std::uint64_t> steps{};
    base::Entries<std::string> prizes{};
    std::optional<Saddle> lost{};
    std::array<double, 2> place{};
};
constexpr auto fields_of(base::Tag<Race>)
{
    return base::fields(
        "race", base::member("length_s", &Race::length, "From `start` to [end](end.md)."),
        base::computed<Race>("laps", [](const Race& race) { return race.laps.size(); }),
        base::member("steps", &Race::steps), base::member("prizes", &Race::prizes),
        base::member("lost", &Race::lost).left_out_if_none(), base::member("place", &Race::place));
}

TEST(Schema, KnowsTimesMapsAndWhatIsLeftOut)
{
    const auto schema = nlohmann::json::parse(schema_text<Race>("A race"));
    EXPECT_EQ(schema.at("required").dump(), R"(["length_s","laps","steps","prizes","place"])");
    const auto& keys = schema.at("properties");
    EXPECT_EQ(keys.at("length_s").dump(),
              R"({"description":"From start to end.","type":"number"})");
    EXPECT_EQ(keys.at("laps").dump(), R"({"minimum":0,"type":"integer"})");
    EXPECT_EQ(keys.at("steps").at("required").dump(), R"(["walk","trot"])");
    EXPECT_EQ(keys.at("prizes").dump(),
              R"({"additionalProperties":{"type":"string"},"type":"object"})");
    // The key is never null: it is present or absent.
    EXPECT_EQ(keys.at("lost").dump(), R"({"$ref":"#/$defs/saddle"})");
    EXPECT_EQ(keys.at("place").at("minItems"), 2);
    EXPECT_EQ(keys.at("place").at("maxItems"), 2);
}

} // namespace
} // namespace schema_test
} // namespace hapnet::output
