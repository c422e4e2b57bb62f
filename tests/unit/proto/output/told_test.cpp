// SPDX-FileCopyrightText: 2026 The Hapnet authors
// SPDX-License-Identifier: MIT
#include "proto/output/told.hpp"

#include "proto/base/fields_json.hpp"

#include <chrono>
#include <cstdint>
#include <gtest/gtest.h>
#include <optional>
#include <string>

namespace hapnet::output {
namespace told_test {

enum class Weather : std::uint8_t { sun, rain };
constexpr auto names_of(base::Tag<Weather>) { return base::names("sun", "rain"); }

struct Wait {
    base::Duration mean{};
    base::Duration max{};
};
constexpr auto fields_of(base::Tag<Wait>)
{
    return base::fields("wait", base::member("mean", &Wait::mean), base::member("max", &Wait::max));
}

/// A day of a ferry.
struct Day {
    std::uint64_t cars = 0;
    std::uint64_t trucks = 0;
    std::uint64_t aboard = 0;
    base::ByName<Weather, std::uint64_t> cancelled{};
    std::optional<Wait> wait{};
    std::optional<std::string> captain{};
};
constexpr auto fields_of(base::Tag<Day>)
{
    return base::fields(
        "day",
        base::member("cars", &Day::cars, "Cars that `crossed` ([more](cars.md)).")
            .always_told("cars")
            .counter("ferry_cars"),
        base::member("trucks", &Day::trucks, "Trucks that crossed.").told("trucks"),
        base::member("aboard", &Day::aboard, "Vehicles on the way now.").gauge("ferry_aboard"),
        base::member("cancelled", &Day::cancelled, "Crossings that were cancelled, by cause.")
            .told("")
            .counter("ferry_cancelled", "cause"),
        base::member("wait_ms", &Day::wait, "How long they waited | at the pier.")
            .told("wait")
            .gauge("ferry_wait"),
        base::member("captain", &Day::captain, "Who was in command.").left_out_if_none());
}

Day usual()
{
    using namespace std::chrono_literals;
    return {.cars = 3, .cancelled = {{0, 2}}, .wait = Wait{1500us, 4ms}};
}

namespace {

TEST(Told, SaysCountsWithTheirWordsAndLeavesOutZeros)
{
    EXPECT_EQ(told(usual()), "3 cars, 2 rain");
    EXPECT_EQ(told(Day{}), "0 cars");
    EXPECT_EQ(told(Day{.cars = 1, .trucks = 2}), "1 cars, 2 trucks");
}

TEST(Told, HasARowForEachFigureOfATable)
{
    const auto figures = told_figures(base::field_table<Day>(), base::json_of(usual()));
    std::string text;
    for (const ToldFigure& figure : figures)
        text += figure.words + ": " + figure.value.dump() + '\n';
    EXPECT_EQ(text, "cars: 3\ntrucks: 0\ncancelled: rain: 2\nwait, mean (ms): 1.5\n"
                    "wait, max (ms): 4.0\n");
}

} // namespace
} // namespace told_test
} // namespace hapnet::output
