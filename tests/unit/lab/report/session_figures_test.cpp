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

TEST(SessionFigures, ShowsThePlayerTheDistanceTheForcesAndTheAnalysisOfTwoRecords)
{
    TwoRecords records;
    const results::Results results = results_of(records);
    const std::string page = page_of(results);
    const auto data = test::data_of(page);
    const std::string words = test::words_of(page);
    EXPECT_EQ(data.at("title"), "A recorded session of task T3");
    EXPECT_EQ(data.at("sections")[0].at("id"), "replay");
    EXPECT_EQ(data.at("sections")[1].at("id"), "sessions");
    EXPECT_EQ(data.at("sections").size(), 2U) << "no experiment was to be here";
    EXPECT_TRUE(holds(page, "25.00 mm on average while both hands were on, 25.0 mm at most"));
    EXPECT_TRUE(holds(words, R"({"name":"the body |x_A - x_B|, mm","cells":["25.000")"));
    EXPECT_TRUE(holds(words, R"({"name":"ticks per second","cells":["1000.00")"));
    EXPECT_TRUE(holds(words, R"("algorithm":"<base>")"));
    EXPECT_FALSE(holds(page, "<base>"));
    const auto files = report_of(results, "r");
    for (const std::string name : {"apart", "cubes", "forces"}) {
        const std::string csv = "figures/session-T3-" + name + ".csv";
        EXPECT_TRUE(text_of(files, csv).starts_with("curve,x,y\n")) << name;
        EXPECT_EQ(test::figure_of(page, "session-T3-" + name).at("sources")[0], csv);
    }
    EXPECT_TRUE(holds(text_of(files, "figures/session-T3-apart.csv"), ",25.0\n"));
    EXPECT_EQ(page_subject(page), "session");
}

TEST(SessionFigures, ShowsDistanceAndAngleOfEachBodyWhereTheyTurnOrAreSeveral)
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
    EXPECT_TRUE(holds(test::words_of(page), R"({"name":"body 2","cells":["5.000")"));
    for (const std::string name : {"bodies", "angles"}) {
        const auto series = test::figure_of(page, "session-T3-" + name).at("series");
        EXPECT_EQ(series.size(), 2U) << name;
    }
}

TEST(SessionFigures, SaysWhetherTheSessionIsValidAndWhyNot)
{
    TwoRecords records;
    EXPECT_TRUE(holds(page_of(results_of(records)), R"("valid":true,"invalid_because":[])"));
    records::Recording late{2};
    late.session(1s).ticks(500ms, 1s, record::Phase::running, records::cube_at(0.0));
    results::Results results;
    ASSERT_TRUE(add_session(results, "late", records.a.content(), late.content()));
    const std::string page = page_of(results);
    EXPECT_TRUE(holds(page, R"("valid":false,"invalid_because":["the sessions overlap 50.0 %, )"
                            R"(less than 95 %"])"));
}

TEST(SessionFigures, IsThereWithoutAPlayerWhenTheTwoNeverPlayedTogether)
{
    records::Recording a{1};
    records::Recording b{2};
    a.session(1s).ticks(0s, 1s);
    b.session(1s);
    results::Results results;
    ASSERT_TRUE(add_session(results, "", a.content(), b.content()));
    const std::string page = page_of(results);
    EXPECT_FALSE(test::data_of(page).contains("replays"));
    EXPECT_FALSE(holds(test::words_of(page), R"("id":"replay")"));
    EXPECT_TRUE(holds(page, "The two sides were never running together."));
}

TEST(SessionFigures, RefusesRecordsThatDoNotBelongTogether)
{
    records::Recording a{1};
    records::Recording b{1};
    results::Results results;
    EXPECT_FALSE(add_session(results, "", a.content(), b.content()));
    EXPECT_TRUE(results.sessions.empty());
}

TEST(SessionFigures, ThePlayerShowsTheSceneOfTheRecord)
{
    TwoRecords records;
    records.a.content().config["scene_toml"] = "[[body]]\nsize = \"60mm\"\nmass = \"0.1kg\"\n";
    EXPECT_TRUE(holds(page_of(results_of(records)), R"("half":[30.0,30.0,30.0])"));
}

TEST(Report, PutsTheDemosTablesOnTopOfTheSessions)
{
    TwoRecords records;
    results::Results results = results_of(records);
    results::SessionFiles task{.analysis = {{"discrepancy_x_mm", {{"mean", 13.5}}}}};
    results.demo = results::DemoRun{task, task};
    results.runs.push_back(
        {"r", Json{{"kind", "demo"}, {"command", "demo.sh --out <here & there>"}}, std::nullopt});
    const std::string page = page_of(results);
    const auto data = test::data_of(page);
    const std::string words = test::words_of(page);
    std::vector<std::string> ids;
    for (const auto& section : data.at("sections")) ids.push_back(section.at("id"));
    EXPECT_EQ(ids, (std::vector<std::string>{"demo", "replay", "sessions", "runs"}));
    EXPECT_TRUE(holds(words, R"({"name":"paper","cells":["13.79","0.00")"));
    EXPECT_TRUE(holds(words, "mean within 15 % of the paper's: met"));
    EXPECT_TRUE(holds(words, "--out <here & there>"));
    EXPECT_FALSE(holds(page, "<here"));
    EXPECT_EQ(page_subject(page), "demo");
}

TEST(PageSubject, IsEmptyForAPageThatDoesNotSay)
{
    EXPECT_EQ(page_subject("<html></html>"), "");
    EXPECT_EQ(page_subject(report::page_of({sample_table1()})), "experiments");
}

} // namespace
} // namespace hapnet::lab::report
