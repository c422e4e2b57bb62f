// SPDX-FileCopyrightText: 2026 The Hapnet authors
// SPDX-License-Identifier: MIT
#include "proto/base/fields.hpp"

#include "proto/base/csv.hpp"
#include "proto/base/fields_json.hpp"

#include <array>
#include <chrono>
#include <gtest/gtest.h>

namespace hapnet::base {
namespace fields_test {

using namespace std::chrono_literals;
using namespace literals;

enum class Gait : std::uint8_t { walk, trot, gallop };
constexpr auto names_of(Tag<Gait>) { return names("walk", "trot", "gallop"); }

struct Rider {
    double mass_kg = 70.0;
    std::optional<Duration> reaction{};

    friend bool operator==(const Rider&, const Rider&) = default;
};
constexpr auto fields_of(Tag<Rider>)
{
    return fields("rider", field("mass", &Rider::mass_kg, Quantity{mass_kind, 1.0, 200.0}, "of it"),
                  field("reaction", &Rider::reaction, Time{1ms, 10s}).absent_as("never"));
}

struct Saddle {
    std::uint32_t straps = 2;

    friend bool operator==(const Saddle&, const Saddle&) = default;
};
constexpr auto fields_of(Tag<Saddle>)
{
    return fields("saddle", field("straps", &Saddle::straps, Count{1, 4}, "that hold it"));
}

struct Horse {
    std::string name;
    Gait gait = Gait::walk;
    Probability risk{};
    std::vector<double> laps{};
    bool shod = true;
    std::optional<double> best_s{};
    Rider rider{};
    Saddle saddle{};

    friend bool operator==(const Horse&, const Horse&) = default;
};
constexpr auto fields_of(Tag<Horse>)
{
    return fields("horse", field("name", &Horse::name).required(), field("gait", &Horse::gait),
                  field("risk", &Horse::risk), field("laps", &Horse::laps),
                  field("shod", &Horse::shod), field("best_s", &Horse::best_s),
                  field("rider", &Horse::rider), part(&Horse::saddle));
}

struct Finish {
    std::string horse;
    double time_s = 0.0;
    std::optional<double> best_s{};
    Gait gait{};
    bool valid = false;
    std::uint32_t laps = 0;

    friend bool operator==(const Finish&, const Finish&) = default;
};
constexpr auto fields_of(Tag<Finish>)
{
    return fields("finish", field("horse", &Finish::horse),
                  field("time_s", &Finish::time_s, Decimals{2}), field("best_s", &Finish::best_s),
                  field("gait", &Finish::gait), field("valid", &Finish::valid),
                  field("laps", &Finish::laps));
}

/// A whole number of one byte, a list that may be missing, a list of fixed length, a struct.
struct Lane {
    std::uint8_t laps = 0;
    std::optional<std::vector<double>> strides{};
    std::array<int, 2> offset{};
    Saddle rider{};

    friend bool operator==(const Lane&, const Lane&) = default;
};
constexpr auto fields_of(Tag<Lane>)
{
    return fields("lane", member("laps", &Lane::laps), member("strides", &Lane::strides),
                  member("offset", &Lane::offset), member("rider", &Lane::rider));
}

namespace {

/// The struct that a text describes, or the complaint about it.
template <typename T>
Result<T> read(const std::string& text)
{
    Reading reading{"f.toml"};
    const auto document = parse_document(text);
    T value;
    read_table(document.value(), value, reading);
    if (!reading.is_good()) return fail(*reading.complaint());
    return value;
}

template <typename T>
std::string complaint(const std::string& text)
{
    const auto value = read<T>(text);
    return value ? "none" : value.error().message;
}

TEST(Fields, AreReadByTheirKeysAndKeepTheirDefaults)
{
    const auto horse = read<Horse>("name = \"Bess\"\ngait = \"trot\"\nrisk = \"5%\"\nstraps = 3\n"
                                   "laps = [1.5, 2]\nrider = { mass = \"60kg\" }\n");
    ASSERT_TRUE(horse) << horse.error().message;
    EXPECT_EQ(horse->gait, Gait::trot);
    EXPECT_EQ(horse->risk, 5_percent);
    EXPECT_EQ(horse->laps, (std::vector{1.5, 2.0}));
    EXPECT_EQ(horse->rider.mass_kg, 60.0);
    EXPECT_EQ(horse->saddle.straps, 3U); // the fields of a part are among those of the whole
    EXPECT_TRUE(horse->shod);
    EXPECT_FALSE(horse->rider.reaction);
}

TEST(Fields, PrintWhatReadsBackAsTheSameValue)
{
    Horse horse{.name = "a \"b\"", .gait = Gait::gallop, .laps = {0.1, 3.0}, .best_s = 0.25};
    horse.rider.reaction = 250ms;
    EXPECT_EQ(read<Horse>(field_lines(horse)).value(), horse);
    EXPECT_NE(field_lines(horse).find("rider.reaction = \"250ms\"\n"), std::string::npos);
    horse.rider.reaction.reset();
    EXPECT_EQ(read<Horse>(field_lines(horse)).value(), horse);
    EXPECT_NE(field_lines(horse).find("rider.reaction = \"never\"\n"), std::string::npos);
}

TEST(Fields, PrintOnlyWhatIsNeededIfAsked)
{
    EXPECT_EQ(field_texts(Horse{.name = "Bess", .shod = false}, Print::needed),
              (std::vector<std::string>{"name = \"Bess\"", "shod = false"}));
}

TEST(Fields, ComplainWithThePlaceAndTheCure)
{
    EXPECT_EQ(complaint<Horse>("gait = \"trot\""),
              R"(f.toml:1:1: missing key 'name': write name = "...")");
    EXPECT_EQ(complaint<Horse>("name = \"B\"\ngait = \"trott\""),
              "f.toml:2:8: unknown name 'trott': did you mean 'trot'?");
    EXPECT_EQ(complaint<Horse>("name = \"B\"\ngait = \"fly\""),
              "f.toml:2:8: unknown name 'fly': use one of walk, trot, gallop");
    EXPECT_EQ(complaint<Horse>("name = \"B\"\nshode = true"),
              "f.toml:2:1: unknown key 'shode': did you mean 'shod'?");
    EXPECT_EQ(complaint<Horse>("nam = \"B\""),
              "f.toml:1:1: unknown key 'nam': did you mean 'name'?");
    EXPECT_EQ(complaint<Horse>("name = \"B\"\nstraps = 3.0"),
              "f.toml:2:10: expected a whole number from 1 to 4 in digits: write 3");
    EXPECT_EQ(complaint<Horse>("name = \"B\"\nstraps = 2.5"),
              "f.toml:2:10: expected a whole number from 1 to 4, not 2.5");
    EXPECT_EQ(complaint<Horse>("name = 5"), "f.toml:1:8: expected a text in quotes, not 5");
    EXPECT_EQ(complaint<Horse>("name = \"B\"\nrider = { mass = \"500kg\" }"),
              "f.toml:2:18: '500kg' is out of range: use 1kg to 200kg");
    EXPECT_EQ(complaint<Horse>("name = \"B\"\nstraps = 9"),
              "f.toml:2:10: expected a whole number from 1 to 4, not 9");
    EXPECT_EQ(complaint<Rider>("reaction = \"11s\""),
              "f.toml:1:12: '11s' is out of range: use 1ms to 10s");
}

TEST(Fields, TellPeopleTheirKeys)
{
    EXPECT_EQ(markdown(key_rows<Rider>()),
              "| key | value | default | meaning |\n"
              "|---|---|---|---|\n"
              "| `mass` | a mass from 1kg to 200kg | `\"70kg\"` | of it |\n"
              "| `reaction` | a time from 1ms to 10s, or `\"never\"` | `\"never\"` |  |\n");
    const auto rows = key_rows<Horse>();
    EXPECT_EQ(rows[0].by_default, KeyRow::required);
    EXPECT_EQ(rows[1].values, "`\"walk\"`, `\"trot\"`, `\"gallop\"`");
    EXPECT_EQ(rows[6].key, "rider.mass");
    EXPECT_EQ(markdown({{"a", "b", "c|d", "two\nlines"}}).substr(54),
              "| `a` | b | `c\\|d` | two lines |\n");
}

TEST(Fields, AreTheObjectOfJson)
{
    const Finish finish{"Bess", 2.0, std::nullopt, Gait::trot, true, 3};
    const auto json = json_of(finish);
    EXPECT_EQ(json.dump(), R"({"horse":"Bess","time_s":2.0,"best_s":null,"gait":"trot",)"
                           R"("valid":true,"laps":3})");
    EXPECT_EQ(from_json<Finish>(nlohmann::json::parse(json.dump()), "x").value(), finish);
    EXPECT_EQ(from_json<Finish>(nlohmann::json::parse("{\"horse\":1}"), "x").error().message,
              "x: missing or wrong key 'horse'");
    EXPECT_EQ(json_of(std::numeric_limits<double>::quiet_NaN()).dump(), "null");
}

/// A struct with output descriptions: times in the unit of the key above them, and computed values.
struct Times {
    Duration best{};
    std::optional<Duration> worst;
};
constexpr auto fields_of(Tag<Times>)
{
    return fields("times", member("best", &Times::best), member("worst", &Times::worst));
}
struct Told {
    Times times;
    Entries<std::uint64_t> falls;
    const Times* of_others = nullptr;
    double mean_speed = 0.0;
};
constexpr auto fields_of(Tag<Told>)
{
    return fields("told", member("times_ms", &Told::times),
                  computed<Told>("best_us", [](const Told& told) { return told.times.best; }),
                  member("falls", &Told::falls), member("others_s", &Told::of_others),
                  computed<Told>("others", [](const Told& told) { return told.of_others; })
                      .left_out_if_none(),
                  member("mean_speed", &Told::mean_speed).rounded(2),
                  computed_part<Told>([](const Told& told) -> const Times& { return told.times; }));
}

TEST(Fields, TellTimesInTheUnitOfTheKey)
{
    using namespace std::chrono_literals;
    Told told{.times = {1500us, {}}, .falls = {{"b", 2}, {"a", 0}}, .mean_speed = 1.23456};
    auto object = nlohmann::ordered_json::object();
    add_json(object, field_table<Told>(), &told, {.ns_per_unit = 1e9});
    EXPECT_EQ(object.dump(), R"({"times_ms":{"best":1.5,"worst":null},"best_us":1500.0,)"
                             R"("falls":{"b":2,"a":0},"others_s":null,"mean_speed":1.23,)"
                             R"("best":0.0015,"worst":null})");
    const Times others{2s, 3s};
    told.of_others = &others;
    object = nlohmann::ordered_json::object();
    add_json(object, field_table<Told>(), &told, {.ns_per_unit = 1e9});
    EXPECT_EQ(object["others_s"].dump(), R"({"best":2.0,"worst":3.0})");
    EXPECT_EQ(object["others"].dump(), R"({"best":2.0,"worst":3.0})");
}

TEST(Fields, AreReadFromJsonOnlyWhereTheirTypesHaveTheValue)
{
    const auto read = [](const std::string& laps, const std::string& strides) {
        Lane lane;
        const auto json = nlohmann::json::parse(R"({"laps":)" + laps + R"(,"strides":)" + strides +
                                                R"(,"offset":[-1,2],"rider":{"straps":3}})");
        return read_json(json, lane) ? std::optional{lane} : std::nullopt;
    };
    const auto lane = read("255", "[1, 2.5]");
    ASSERT_TRUE(lane);
    EXPECT_EQ(*lane, (Lane{255, {{1.0, 2.5}}, {-1, 2}, {3}}));
    EXPECT_EQ(json_of(*lane).dump(),
              R"({"laps":255,"strides":[1.0,2.5],"offset":[-1,2],"rider":{"straps":3}})");
    EXPECT_FALSE(read("256", "[]"));
    EXPECT_FALSE(read("-1", "[]"));
    EXPECT_FALSE(read("1.0", "[]"));
    EXPECT_FALSE(read("1", R"(["x"])"));
    EXPECT_FALSE(read("1", "5"));
    Lane lane_of_three;
    EXPECT_FALSE(read_json(nlohmann::json::parse(R"({"laps":1,"strides":[],"offset":[1,2,3],)"
                                                 R"("rider":{"straps":3}})"),
                           lane_of_three));
    EXPECT_FALSE(read("true", "[]"));
    EXPECT_EQ(read("1", "null"), (Lane{1, std::nullopt, {-1, 2}, {3}}));
}

TEST(Fields, AreTheColumnsOfATable)
{
    const std::vector<Finish> results{{"a,b", 2.005, 0.5, Gait::walk, true, 1},
                                      {"c", 1.0, std::nullopt, Gait::gallop, false, 0}};
    const auto text = csv_text(results);
    EXPECT_EQ(text, "horse,time_s,best_s,gait,valid,laps\n\"a,b\",2.00,0.5,walk,true,1\n"
                    "c,1.00,,gallop,false,0\n");
}

} // namespace
} // namespace fields_test
} // namespace hapnet::base
