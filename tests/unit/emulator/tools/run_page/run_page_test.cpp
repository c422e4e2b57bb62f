// SPDX-FileCopyrightText: 2026 The Hapnet authors
// SPDX-License-Identifier: MIT
#include "emulator/tools/run_page/run_page.hpp"

#include "emulator/tools/run_page/figures.hpp"
#include "tests/support/page_data.hpp"

#include <chrono>
#include <gtest/gtest.h>
#include <string>

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

TEST(RunPage, ListsTheChangesAndPlotsThem)
{
    auto changed = statistics();
    EXPECT_FALSE(has(page_of(changed), "What changed"));
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
    // Half of all are lost: so is half of the runs' continuations.
    EXPECT_EQ(series()[1]["points"].dump(), "[[1.0,1.0],[2.0,0.5],[3.0,0.25]]");
    run.conditions = nullptr;
    EXPECT_EQ(series().size(), 1U);
    run.fates = {};
    EXPECT_FALSE(loss_runs_figure(run));
}

} // namespace
} // namespace hapnet::emulator::tools::run_page_test
