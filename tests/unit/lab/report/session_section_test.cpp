// SPDX-FileCopyrightText: 2026 The Hapnet authors
// SPDX-License-Identifier: MIT
#include "tests/unit/lab/records/recording.hpp"
#include "tests/unit/lab/report/sample.hpp"

namespace hapnet::lab::report {
namespace {

using namespace std::chrono_literals;
using Json = nlohmann::ordered_json;

/// A session of two peers: the copies are 25 mm apart for as long as it lasts.
struct TwoRecords {
    TwoRecords()
    {
        a.content().config.update({{"task", "T3"}, {"algorithm", "<base>"}});
        a.session(1s).ticks(0s, 1s, record::Phase::running, records::cube_at(0.010));
        b.session(1s).ticks(0s, 1s, record::Phase::running, records::cube_at(0.035));
    }

    records::Recording a{1};
    records::Recording b{2};
};

results::Results results_of(TwoRecords& records)
{
    results::Results results;
    const auto added = add_session(results, "", records.a.content(), records.b.content());
    EXPECT_TRUE(added) << added.error().message;
    return results;
}

std::string page_of(const results::Results& results)
{
    return text_of(report_of(results, "r"), "report.html");
}

TEST(SessionSection, ShowsThePlayerTheDistanceTheForcesAndTheAnalysisOfTwoRecords)
{
    TwoRecords records;
    const results::Results results = results_of(records);
    const std::string page = page_of(results);
    EXPECT_TRUE(holds(page, "<h1>A recorded session of task T3</h1>"));
    EXPECT_TRUE(holds(page, "<section id='replay'"));
    EXPECT_TRUE(holds(page, "<section id='sessions'"));
    EXPECT_TRUE(holds(page, "25.00 mm on average while both hands were on, 25.0 mm at most"));
    EXPECT_TRUE(holds(page, "<th scope='row'>the body |x_A - x_B|, mm</th><td>25.000</td>"));
    EXPECT_TRUE(holds(page, "<th scope='row'>ticks per second</th><td>1000.00</td>"));
    EXPECT_TRUE(holds(page, "algorithm &lt;base&gt;"));
    EXPECT_FALSE(holds(page, "<base>"));
    EXPECT_FALSE(holds(page, "<section id='missing'")) << "no experiment was to be here";
    const auto files = report_of(results, "r");
    for (const std::string name : {"apart", "cubes", "forces"}) {
        EXPECT_FALSE(text_of(files, "figures/session-T3-" + name + ".svg").empty()) << name;
        const std::string csv = "figures/session-T3-" + name + ".csv";
        EXPECT_TRUE(text_of(files, csv).starts_with("curve,x,y\n")) << name;
        EXPECT_TRUE(holds(page, "<a href='" + csv + "'>")) << name;
    }
    EXPECT_TRUE(holds(text_of(files, "figures/session-T3-apart.csv"), ",25.0\n"));
    EXPECT_EQ(page_subject(page), "session");
}

TEST(SessionSection, ShowsDistanceAndAngleOfEachBodyWhereTheyTurnOrAreSeveral)
{
    TwoRecords records;
    EXPECT_FALSE(holds(page_of(results_of(records)), "Angle between")) << "the cube cannot turn";
    records.a.bodies({0, 1}, [](record::BodyRow&, base::Duration) {});
    records.b.bodies({0, 1}, [](record::BodyRow& row, base::Duration) {
        row.position = {{0.003, 0.0, 0.004}};
        if (row.body == 1) row.orientation = glm::dquat{0.0, 1.0, 0.0, 0.0};
    });
    const results::Results results = results_of(records);
    const std::string page = page_of(results);
    EXPECT_TRUE(holds(page, "body 1 5.00 mm, body 2 5.00 mm"));
    EXPECT_TRUE(holds(page, "body 1 0.00 deg, body 2 180.00 deg"));
    EXPECT_TRUE(holds(page, "<th scope='row'>body 2</th><td>5.000</td>"));
    const auto files = report_of(results, "r");
    for (const char* name : {"bodies", "angles"}) {
        EXPECT_FALSE(text_of(files, "figures/session-T3-" + std::string{name} + ".svg").empty())
            << name;
    }
}

TEST(SessionSection, SaysWhetherTheSessionIsValidAndWhyNot)
{
    TwoRecords records;
    EXPECT_TRUE(holds(page_of(results_of(records)), "<b>Valid.</b>"));
    records::Recording late{2};
    late.session(1s).ticks(500ms, 1s, record::Phase::running, records::cube_at(0.0));
    results::Results results;
    ASSERT_TRUE(add_session(results, "late", records.a.content(), late.content()));
    const std::string page = page_of(results);
    EXPECT_TRUE(holds(page, "<b>Not valid.</b>"));
    EXPECT_TRUE(holds(page, "<li>the sessions overlap 50.0 %, less than 95 %</li>"));
}

TEST(SessionSection, IsThereWithoutAPlayerWhenTheTwoNeverPlayedTogether)
{
    records::Recording a{1};
    records::Recording b{2};
    a.session(1s).ticks(0s, 1s);
    b.session(1s);
    results::Results results;
    ASSERT_TRUE(add_session(results, "", a.content(), b.content()));
    const std::string page = page_of(results);
    EXPECT_FALSE(holds(page, "<section id='replay'"));
    EXPECT_TRUE(holds(page, "The two sides were never running together."));
}

TEST(SessionSection, RefusesRecordsThatDoNotBelongTogether)
{
    records::Recording a{1};
    records::Recording b{1};
    results::Results results;
    EXPECT_FALSE(add_session(results, "", a.content(), b.content()));
    EXPECT_TRUE(results.sessions.empty());
}

TEST(SessionSection, ThePlayerShowsTheSceneOfTheRecord)
{
    TwoRecords records;
    records.a.content().config["scene_toml"] = "[[body]]\nsize = \"60mm\"\nmass = \"0.1kg\"\n";
    EXPECT_TRUE(holds(page_of(results_of(records)), R"("half":[30.0,30.0,30.0])"));
}

TEST(DemoSection, PutsTheDemosTablesOnTopOfTheSessionsAndKeepsThemInTheirScrollingFrames)
{
    TwoRecords records;
    results::Results results = results_of(records);
    results::SessionFiles task{.analysis = {{"discrepancy_x_mm", {{"mean", 13.5}}}}};
    results.demo = results::DemoRun{task, task};
    results.runs.push_back(
        {"r", Json{{"kind", "demo"}, {"command", "demo.sh --out <here & there>"}}, std::nullopt});
    const std::string page = page_of(results);
    const auto demo = page.find("<section id='demo'"), sessions = page.find("<section id='session");
    ASSERT_NE(demo, std::string::npos);
    EXPECT_LT(demo, sessions);
    EXPECT_TRUE(holds(page, "<th scope='row'>paper</th><td>13.79</td><td>0.00</td>"));
    EXPECT_TRUE(holds(page, "mean within 15 % of the paper&#39;s: met"));
    EXPECT_TRUE(holds(page, "--out &lt;here &amp; there&gt;"));
    EXPECT_FALSE(holds(page, "<here"));
    EXPECT_FALSE(holds(page, "<section id='missing'"));
    EXPECT_EQ(page_subject(page), "demo");
    std::size_t tables = 0, frames = 0;
    for (auto at = page.find("<table"); at != std::string::npos; at = page.find("<table", at + 1)) {
        ++tables;
        frames += page.rfind("<div", at) == page.rfind("<div class='scroll'", at) ? 1U : 0U;
    }
    EXPECT_GE(tables, 6U);
    EXPECT_EQ(frames, tables) << "a narrow screen scrolls each table";
}

TEST(PageSubject, IsEmptyForAPageThatDoesNotSay)
{
    EXPECT_EQ(page_subject("<html></html>"), "");
    EXPECT_EQ(page_subject(report::page_of({sample_table1()})), "experiments");
}

} // namespace
} // namespace hapnet::lab::report
