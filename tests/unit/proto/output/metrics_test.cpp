// SPDX-FileCopyrightText: 2026 The Hapnet authors
// SPDX-License-Identifier: MIT
#include "proto/output/metrics.hpp"

#include "proto/base/fields_json.hpp"

#include <chrono>
#include <cstdint>
#include <gtest/gtest.h>
#include <nlohmann/json.hpp>
#include <optional>
#include <string>

namespace hapnet::output {
namespace metrics_test {

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

constexpr const char* expected = R"(# HELP ferry_cars_total Cars that crossed (more).
# TYPE ferry_cars_total counter
ferry_cars_total{pier="east \"1\""} 3
# HELP ferry_aboard Vehicles on the way now.
# TYPE ferry_aboard gauge
ferry_aboard{pier="east \"1\""} 0
# HELP ferry_cancelled_total Crossings that were cancelled, by cause.
# TYPE ferry_cancelled_total counter
ferry_cancelled_total{cause="sun",pier="east \"1\""} 0
ferry_cancelled_total{cause="rain",pier="east \"1\""} 2
# HELP ferry_wait_mean_seconds How long they waited | at the pier.
# TYPE ferry_wait_mean_seconds gauge
ferry_wait_mean_seconds{pier="east \"1\""} 0.0015
# HELP ferry_wait_max_seconds How long they waited | at the pier.
# TYPE ferry_wait_max_seconds gauge
ferry_wait_max_seconds{pier="east \"1\""} 0.004
)";

Metrics metrics_of(const Day& day)
{
    Metrics metrics;
    metrics.add(base::field_table<Day>(), base::json_of(day), {{"pier", "east \"1\""}});
    return metrics;
}

TEST(Metrics, AreWhatTheDescriptionSays) { EXPECT_EQ(metrics_of(usual()).text(), expected); }

TEST(Metrics, OfSeveralProgramsStandTogetherByTheirNames)
{
    Metrics both;
    both.add(metrics_of(usual()).json());
    EXPECT_EQ(both.text(), expected);
    Metrics west;
    west.add(base::field_table<Day>(), base::json_of(Day{.cars = 7}), {{"pier", "west"}});
    both.add(west.json());
    const std::string text = both.text();
    EXPECT_NE(text.find("} 3\nferry_cars_total{pier=\"west\"} 7\n"), std::string::npos);
    EXPECT_EQ(text.find("# TYPE ferry_cars_total"), text.rfind("# TYPE ferry_cars_total"));
}

TEST(Metrics, PassOverWhatIsNone)
{
    using Json = nlohmann::ordered_json;
    Metrics metrics;
    metrics.add(Json(7));
    metrics.add(Json::parse(R"([7, {"name": 3}, {"name": "a", "samples": [1, {"value": "x"},
                               {"value": 2, "labels": {"b": 5, "c d": "e"}}, {"value": null}]},
                               {"name": "b 1\nc", "samples": [{"value": 1}]},
                               {"name": "d", "help": "e\nf", "samples": []}])"));
    EXPECT_EQ(metrics.text(), "# HELP a \n# TYPE a gauge\na 2\n# HELP d e f\n# TYPE d gauge\n");
    metrics.add(base::field_table<Day>(), Json{{"cars", "many"}, {"cancelled", 4}});
    EXPECT_EQ(metrics.text().find("ferry"), std::string::npos);
}

} // namespace
} // namespace metrics_test
} // namespace hapnet::output
