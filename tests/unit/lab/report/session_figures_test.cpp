// SPDX-FileCopyrightText: 2026 The Hapnet authors
// SPDX-License-Identifier: MIT
#include "tests/unit/lab/records/recording.hpp"
#include "tests/unit/lab/report/sample.hpp"

#include <array>

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
    return text_of(report_of(results), "report.html");
}

TEST(SessionFigures, ShowsThePlayerTheDistanceTheForcesAndTheAnalysisOfTwoRecords)
{
    TwoRecords records;
    const results::Results results = results_of(records);
    const std::string page = page_of(results);
    const auto data = test::data_of(page);
    const std::string words = test::words_of(page);
    EXPECT_EQ(data.at("title"), "A recorded session of task T3");
    EXPECT_EQ(data.at("sections")[0].at("id"), "sessions");
    EXPECT_EQ(data.at("sections")[1].at("id"), "replay");
    EXPECT_EQ(data.at("sections")[2].at("id"), "repeat");
    EXPECT_EQ(data.at("sections").size(), 3U) << "no experiment was to be here";
    EXPECT_TRUE(holds(page, "25.00 mm on average while both hands were on, 25.0 mm at most"));
    EXPECT_TRUE(holds(words, R"({"name":"the body |x_A - x_B|, mm","cells":["25.000")"));
    EXPECT_TRUE(holds(words, R"({"name":"ticks per second","cells":["1000.00")"));
    EXPECT_TRUE(holds(words, R"("algorithm":"<base>")"));
    EXPECT_FALSE(holds(page, "<base>"));
    const auto files = report_of(results);
    for (const std::string name : {"apart", "cubes", "forces"}) {
        const std::string csv = "figures/session-T3-" + name + ".csv";
        EXPECT_TRUE(text_of(files, csv).starts_with("curve,time_from_the_start_s,")) << name;
        EXPECT_EQ(test::figure_of(page, "session-T3-" + name).at("sources")[0], csv);
    }
    EXPECT_TRUE(holds(text_of(files, "figures/session-T3-apart.csv"), ",25.0\n"));
    EXPECT_EQ(page_subject(page), "session");
}

/// The points of the curve with this name.
std::string points_of(const Json& figure, std::string_view name)
{
    for (const Json& series : figure.at("series"))
        if (series.at("name").get<std::string>() == name) return series.at("points").dump();
    return "";
}

TEST(SessionFigures, DrawsDelayAndLossOfBothDirectionsAndTheLatenessOfBothLoops)
{
    TwoRecords records;
    // Every other message from A to B is lost; the others take 20 ms in the first half, then 40 ms.
    for (std::uint32_t k = 1; k < 1000; k += 2) {
        const auto sent = records::start + k * 1ms;
        records.b.message(k, sent, sent + (k < 500 ? 20ms : 40ms));
        records.a.message(k, sent, sent + 5ms).message(k + 1, sent + 1ms, sent + 6ms);
    }
    // The i-th tick of A is i / 2 us late.
    auto& ticks = records.a.content().ticks;
    for (std::size_t i = 0; i < ticks.size(); ++i)
        ticks[i].late = static_cast<std::int64_t>(i) * 500ns;
    const std::string page = page_of(results_of(records));
    const auto figure = [&](const char* name) {
        return test::figure_of(page, std::string{"session-T3-"} + name);
    };
    EXPECT_EQ(points_of(figure("delay"), "A to B").substr(0, 24), "[[0.05,20.0],[0.15,20.0]");
    EXPECT_TRUE(points_of(figure("delay"), "A to B").ends_with("[0.85,40.0],[0.95,40.0]]"));
    EXPECT_EQ(points_of(figure("delay"), "B to A").substr(0, 12), "[[0.05,5.0],");
    EXPECT_EQ(points_of(figure("loss"), "B to A").substr(0, 21), "[[0.0,0.0],[0.1,0.0],");
    EXPECT_TRUE(holds(points_of(figure("loss"), "A to B"), "[0.2,50.0],[0.3,50.0]"));
    EXPECT_EQ(points_of(figure("delays"), "A to B"), "[[20.0,0.0],[20.0,0.5],[40.0,1.0]]");
    const auto lateness = figure("lateness");
    EXPECT_TRUE(points_of(lateness, "A").ends_with("[499.5,1.0]]"));
    EXPECT_EQ(points_of(lateness, "B"), "") << "none of its ticks was late";
    EXPECT_EQ(points_of(lateness, "budget"), "[[1000.0,0.0],[1000.0,1.0]]");
    const auto range = figure("apart").at("x").at("range").dump();
    EXPECT_EQ(figure("delay").at("x").at("range").dump(), range) << "they zoom together";
}

TEST(SessionFigures, NamesItsRecordsAsSourcesAndTheLowerIdA)
{
    TwoRecords records;
    results::Results results;
    ASSERT_TRUE(add_session(results, "",
                            std::array{results::RecordFile{&records.b.content(), "b.rec"},
                                       results::RecordFile{&records.a.content(), "a.rec"}}));
    const std::string page = page_of(results);
    EXPECT_EQ(test::figure_of(page, "session-T3-apart").at("sources").dump(),
              R"(["figures/session-T3-apart.csv","a.rec","b.rec"])");
    EXPECT_EQ(test::data_of(page).at("sessions")[0].at("peers").dump(), "[1,2]");
    EXPECT_TRUE(holds(test::words_of(page), "hapnet-lab analyse a.rec b.rec"));
}

TEST(SessionFigures, SaysWhichRecordsCannotBeCompared)
{
    TwoRecords records;
    records::Recording other{3};
    results::Results results;
    const auto added = add_session(results, "",
                                   std::array{results::RecordFile{&records.a.content(), "a.rec"},
                                              results::RecordFile{&other.content(), "other.rec"}});
    ASSERT_FALSE(added);
    EXPECT_TRUE(added.error().message.starts_with("a.rec with other.rec: the records share no "))
        << added.error().message;
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
    EXPECT_EQ(ids, (std::vector<std::string>{"demo", "sessions", "replay", "runs"}));
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
