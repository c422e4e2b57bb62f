// SPDX-FileCopyrightText: 2026 The Hapnet authors
// SPDX-License-Identifier: MIT
#include "emulator/tools/run_page/run_page.hpp"

#include "emulator/core/profile/text.hpp"
#include "emulator/tools/run_page/figures.hpp"
#include "tests/support/page_data.hpp"

#include <chrono>
#include <gtest/gtest.h>
#include <string>
#include <string_view>

namespace hapnet::emulator::tools::run_page_test {
namespace {

using namespace std::chrono_literals;
using Json = nlohmann::ordered_json;

/// Statistics of a run with one change and a check that was not met.
Json statistics()
{
    return Json::parse(R"({
        "program": "hapnet-emulator", "version": "1", "commit": "abc", "seed": 42,
        "timing": "precise", "budget_us": 1000.0, "duration_s": 4.0, "generation": 1,
        "valid": true, "invalid_because": [], "changes": [],
        "up": {"received": 4, "delivered": 2, "dropped": {"random_loss": 2, "outage": 0},
               "lateness_us": {"p50": 9.0, "p99": 11.0, "max": 12.0,
                               "distribution": [[8.0, 9.0, 1], [9.0, 10.0, 3]]},
               "lens": {"delay_ms": {"mean": 20.0, "sd": 1.0,
                                     "distribution": [[19.0, 20.0, 1], [20.0, 21.0, 1]]}}},
        "down": {"received": 0}})");
}

Fates two_lost_of_four()
{
    Fates fates;
    for (const bool is_lost : {false, true, true, false}) {
        Fate fate;
        if (is_lost) fate.drop = DropCause::random_loss;
        if (!is_lost) fate.delay = 20ms;
        fates.up.push_back(fate);
    }
    return fates;
}

std::string page_of(const Json& of, std::optional<Fates> fates = std::nullopt)
{
    Profile profile;
    profile.name = "a <b> & c";
    return run_page({of, profile, std::move(fates), {}, "there are no fates"});
}

bool has(const std::string& page, std::string_view words)
{
    return page.find(words) != std::string::npos;
}

TEST(RunPage, EscapesWhatIsNotItsOwn)
{
    const auto page = page_of(statistics());
    EXPECT_TRUE(has(page, "<title>a &lt;b&gt; &amp; c</title>"));
    EXPECT_FALSE(has(page, "<b> & c"));
    EXPECT_EQ(test::data_of(page)["title"], "a <b> & c");
}

TEST(RunPage, SaysWhetherTheRunIsValidAndWhyNot)
{
    const auto banner_of = [](const Json& of) { return test::data_of(page_of(of))["head"][0]; };
    EXPECT_EQ(banner_of(statistics())["style"], "met");
    auto invalid = statistics();
    invalid["valid"] = false;
    invalid["invalid_because"] = {"up: p99 of 3 ms"};
    EXPECT_EQ(banner_of(invalid)["style"], "missed");
    EXPECT_EQ(banner_of(invalid)["list"][0], "up: p99 of 3 ms");
    auto unmet = statistics();
    unmet["checks"] = {{{"require", "up.received>=9"}, {"value", 4.0}, {"met", false}}};
    EXPECT_EQ(banner_of(unmet)["style"], "missed");
    EXPECT_EQ(banner_of(unmet)["list"][0], "not met: up.received>=9, it is 4");
}

TEST(RunPage, ShowsTheCausesThatOccurredAndNoOthers)
{
    const auto page = page_of(statistics());
    EXPECT_TRUE(has(page, "dropped: random_loss"));
    EXPECT_FALSE(has(page, "dropped: outage"));
}

TEST(RunPage, SaysWhyNothingWasTested)
{
    EXPECT_TRUE(has(page_of(statistics()), "Not tested: there are no fates"));
}

TEST(RunPage, ListsTheChangesAndDrawsTheConditionsOverTime)
{
    auto changed = statistics();
    EXPECT_FALSE(has(page_of(changed), "What happened over time"));
    changed["generation"] = 2;
    changed["changes"] = {{{"generation", 2},
                           {"elapsed_s", 1.5},
                           {"effective_at", {{"up", 1500}, {"down", 1499}}},
                           {"by", "hand"},
                           {"settings", {{"up.delay", "80ms"}}}}};
    const auto page = page_of(changed);
    EXPECT_TRUE(has(page, "Changes of the conditions"));
    EXPECT_TRUE(has(page, "up.delay 80ms"));
    EXPECT_TRUE(has(page, "1499"));
    const auto delay = test::figure_of(page, "delay-over-time");
    EXPECT_EQ(delay["series"][0]["name"], "up (A to B), asked");
    EXPECT_EQ(delay["moments"].dump(), "[1.5]");
    EXPECT_EQ(delay["series"][0]["points"].dump(), "[[0.0,0.0],[1.5,0.0],[1.5,80.0],[4.0,80.0]]");
    EXPECT_EQ(delay["series"][1]["points"].dump(), "[[0.0,0.0],[1.5,0.0],[1.5,0.0],[4.0,0.0]]");
}

TEST(RunPage, BeginsWithTheConditionsThatHoldFromTheStartOn)
{
    auto changed = statistics();
    changed["generation"] = 3;
    const auto change = [](int generation, double at, const char* delay) {
        return Json{{"generation", generation},
                    {"elapsed_s", at},
                    {"by", "timeline"},
                    {"settings", {{"up.delay", delay}}}};
    };
    changed["changes"] = Json::array({change(2, 0.0000004, "20ms"), change(3, 3.0, "60ms")});
    const auto page = page_of(changed);
    const auto delay = test::figure_of(page, "delay-over-time");
    EXPECT_EQ(delay["series"][0]["points"].dump(), "[[0.0,20.0],[3.0,20.0],[3.0,60.0],[4.0,60.0]]");
    EXPECT_EQ(delay["moments"].dump(), "[3.0]") << "the start is no change";
    EXPECT_EQ(delay["x"].dump(),
              R"({"label":"time since the emulator started","unit":"s","range":[0.0,4.0]})");
    EXPECT_TRUE(has(page, "a step of the delay adds to sd and quantiles, and is no jitter"));
    EXPECT_FALSE(has(page_of(statistics()), "a step of the delay adds"));
}

TEST(RunPage, DrawsARampAsASlope)
{
    auto ramped = statistics();
    const auto step = [](int generation, double at, const char* delay) {
        return Json{{"generation", generation},
                    {"elapsed_s", at},
                    {"by", "timeline"},
                    {"settings", {{"up.delay", delay}}}};
    };
    ramped["changes"] = Json::array({step(2, 1.0, "0ms"), step(1002, 2.0, "50ms")});
    EXPECT_TRUE(has(page_of(ramped), R"("1 to 2")"));
    EXPECT_EQ(test::figure_of(page_of(ramped), "delay-over-time")["series"][0]["points"].dump(),
              "[[0.0,0.0],[1.0,0.0],[1.0,0.0],[2.0,50.0],[4.0,50.0]]");
}

TEST(RunPage, DrawsNoRateWhereThereIsNoLimit)
{
    auto limited = statistics();
    const auto change = [](int generation, double at, const char* rate) {
        return Json{{"generation", generation},
                    {"elapsed_s", at},
                    {"by", "hand"},
                    {"settings", {{"up.rate", rate}}}};
    };
    limited["changes"] =
        Json::array({change(2, 1.0, "5Mbit/s"), change(3, 2.0, "none"), change(4, 3.0, "2Mbit/s")});
    const auto series = test::figure_of(page_of(limited), "rate-over-time")["series"];
    ASSERT_EQ(series.size(), 2U);
    EXPECT_EQ(series[0]["name"], "up (A to B), asked");
    EXPECT_EQ(series[0]["points"].dump(), "[[1.0,5.0],[2.0,5.0]]");
    EXPECT_EQ(series[1]["points"].dump(), "[[3.0,2.0],[4.0,2.0]]");
}

/// A run of 3 s in stretches of 2 s.
Json with_stretches()
{
    auto measured = statistics();
    measured["duration_s"] = 3.0;
    const auto stretch = [](double from, int received, int dropped, const Json& delay) {
        return Json{{"from_s", from},     {"length_s", 2.0},    {"received", received},
                    {"dropped", dropped}, {"delivered", 50},    {"bytes_out", 250'000},
                    {"delay_ms", delay},  {"late_us", nullptr}, {"queue_max_ms", 4.0}};
    };
    const Json delay{{"min", 10.0}, {"mean", 20.0}, {"max", 40.0}};
    measured["up"]["lens"]["over_time"] =
        Json::array({stretch(0.0, 100, 25, delay), stretch(2.0, 0, 0, nullptr)});
    return measured;
}

TEST(RunPage, DrawsWhatWasMeasuredOverTimeInTheMiddleOfEachStretch)
{
    const auto page = page_of(with_stretches());
    const auto measured = [&](const char* id) {
        const auto series = test::figure_of(page, id)["series"];
        for (const auto& one : series)
            if (one["name"] == "up (A to B), measured") return one;
        return Json{};
    };
    EXPECT_EQ(measured("delay-over-time")["points"].dump(), "[[1.0,20.0]]");
    EXPECT_EQ(measured("delay-over-time")["band"].dump(), "[[1.0,10.0,40.0]]");
    EXPECT_EQ(measured("loss-over-time")["points"].dump(), "[[1.0,25.0]]");
    // 2 Mbit in 2 s, and in the one second of the second stretch before the run's end.
    EXPECT_EQ(measured("rate-over-time")["points"].dump(), "[[1.0,1.0],[2.5,2.0]]");
    EXPECT_EQ(measured("queue-over-time")["points"].dump(), "[[1.0,4.0],[2.5,4.0]]");
}

TEST(RunPage, LeavesAGapWhereNothingWasMeasured)
{
    auto measured = with_stretches();
    auto& stretches = measured["up"]["lens"]["over_time"];
    measured["duration_s"] = 6.0;
    stretches.push_back(stretches[0]);
    stretches[2]["from_s"] = 4.0;
    const auto series = test::figure_of(page_of(measured), "delay-over-time")["series"];
    const auto parts = [&] {
        std::vector<std::string> points;
        for (const auto& one : series)
            if (one.contains("band")) points.push_back(one["points"].dump());
        return points;
    }();
    EXPECT_EQ(parts, (std::vector<std::string>{"[[1.0,20.0]]", "[[5.0,20.0]]"}));
}

TEST(RunPage, DrawsWhatWasMeasuredWhereAChangeCannotBeRead)
{
    auto of_file = with_stretches();
    of_file["changes"] = {{{"elapsed_s", 1.5}, {"settings", {{"up.loss", "no law"}}}}};
    const auto page = page_of(of_file);
    EXPECT_TRUE(has(page, "The conditions over time are not drawn: "));
    EXPECT_EQ(test::figure_of(page, "delay-over-time")["series"][0]["name"],
              "up (A to B), measured");
}

TEST(RunPage, SaysWhyTheConditionsAreNotDrawn)
{
    auto of_file = statistics();
    of_file["changes"] = {{{"generation", 2},
                           {"elapsed_s", 1.5},
                           {"by", "hand"},
                           {"settings", {{"up.loss", "no law"}}}}};
    EXPECT_TRUE(has(page_of(of_file), "The conditions over time are not drawn: "));
}

TEST(RunPage, EndsTheConditionsWhereTheListOfChangesIsFull)
{
    auto full = statistics();
    full["changes"] = {{{"generation", 2},
                        {"elapsed_s", 1.5},
                        {"by", "hand"},
                        {"settings", {{"up.delay", "80ms"}}}}};
    full["changes_omitted"] = 3;
    const auto page = page_of(full);
    EXPECT_EQ(test::figure_of(page, "delay-over-time")["series"][0]["points"].dump(),
              "[[0.0,0.0],[1.5,0.0],[1.5,80.0],[1.5,80.0]]");
    EXPECT_TRUE(has(page, "3 later changes are not in it"));
}

TEST(RunPage, SaysOfATestThatCannotTellWhatVerifySays)
{
    tools::Verification verification;
    verification.up.push_back(unable("losses", "too few"));
    const auto page = run_page({statistics(), {}, {}, verification, ""});
    EXPECT_TRUE(has(page, R"("cannot tell")"));
    EXPECT_FALSE(has(page, R"("unable")"));
}

TEST(RunPage, SaysInItsLeadWhatWasAsked)
{
    const auto lead_of = [](std::string_view text) {
        const auto profile = parse_profile(text, "asked.toml", {});
        EXPECT_TRUE(profile.has_value());
        return test::data_of(run_page({statistics(), *profile, {}, {}, ""}))["lead"].dump();
    };
    EXPECT_EQ(lead_of("[both]\ndelay = \"30ms\"\nloss = \"2%\"\n"),
              R"("A run of hapnet-emulator: 4 s, seed 42, timing precise. Asked: both ways: )"
              R"(loss 2%, delay 30ms.")");
    const auto changing =
        lead_of("up.delay = \"30ms\"\n[[at]]\ntime = \"1s\"\nup.delay = \"9ms\"\n");
    EXPECT_NE(changing.find("Asked at the start: up: delay 30ms."), std::string::npos) << changing;
    EXPECT_NE(lead_of("").find("Asked: nothing."), std::string::npos);
}

TEST(RunPage, HasFiguresWhereThereAreDistributionsAndFates)
{
    const auto page = page_of(statistics(), two_lost_of_four());
    const auto data = test::data_of(page);
    std::vector<std::string> ids;
    for (const auto& figure : data["figures"]) ids.push_back(figure["id"]);
    EXPECT_EQ(ids,
              (std::vector<std::string>{"delay-up", "lateness-up", "loss-runs-up", "losses-up"}));
    const auto delay = test::figure_of(page, "delay-up");
    EXPECT_EQ(delay["x"].dump(), R"({"label":"delay","unit":"ms"})");
    EXPECT_EQ(delay["series"].back()["name"], "as it came out");
    EXPECT_EQ(delay["title"], "Delay, up (A to B)");
    const auto cells = test::figure_of(page, "losses-up")["series"][0]["cells"];
    EXPECT_EQ(cells[1]["tip"], "datagrams 1 to 1: 1 of 1 lost");
    EXPECT_FALSE(cells[1].contains("opacity")) << "all of it was lost";
    EXPECT_EQ(cells[3]["tip"], "datagrams 3 to 3: 0 of 1 lost");
    EXPECT_EQ(cells[3]["opacity"], 0.04);
}

TEST(RunPage, NeedsNoOtherFile)
{
    const auto page = page_of(statistics(), two_lost_of_four());
    for (const char* link : {"src=", "href=\"", "@import", "url("}) EXPECT_FALSE(has(page, link));
}

TEST(RunPage, SurvivesStatisticsThatLackEverything)
{
    EXPECT_TRUE(has(page_of(Json::object()), "Not valid."));
}

TEST(LossRuns, FallAsAGeometricDistributionWithTheLawsMean)
{
    const auto fates = two_lost_of_four();
    Conditions conditions;
    conditions.loss = {RandomLoss{base::Probability::from_fraction(0.5).value()}};
    const Json none = Json::object();
    RunDirection run{.direction = Direction::up,
                     .statistics = none,
                     .conditions = &conditions,
                     .fates = fates.up,
                     .spacing_s = 1e-3};
    const auto series = [&] { return page::json_of(*loss_runs_figure(run))["series"]; };
    ASSERT_EQ(series().size(), 2U);
    // Half of all are lost, so half of the runs continue.
    EXPECT_EQ(series()[1]["points"].dump(), "[[1.0,1.0],[2.0,0.5],[3.0,0.25]]");
    run.conditions = nullptr;
    EXPECT_EQ(series().size(), 1U);
    run.fates = {};
    EXPECT_FALSE(loss_runs_figure(run));
}

} // namespace
} // namespace hapnet::emulator::tools::run_page_test
