// SPDX-FileCopyrightText: 2026 The Hapnet authors
// SPDX-License-Identifier: MIT
#include "lab/report/assets.hpp"
#include "tests/unit/lab/report/sample.hpp"

#include <algorithm>
#include <nlohmann/json.hpp>
#include <spdlog/fmt/fmt.h>

namespace hapnet::lab::report {
namespace {

TEST(Report, HasASectionExactlyIfTheFolderHasItsData)
{
    struct Expected {
        results::File file;
        std::string section;
    };
    const std::vector<Expected> expected{
        {sample_table1(), "table1"},       {sample_tasks(), "tasks"},
        {sample_limits(), "fig6a"},        {sample_loss_limits(), "fig6b"},
        {sample_curves(), "curves"},       {sample_conventions(), "trust"},
        {sample_trajectories(), "fig7"},   {sample_qos(), "qos"},
        {sample_real_time(), "real-time"}, {sample_replay(), "replay"},
        {sample_claims(), "beyond"},       {sample_manifest(), "runs"},
        {sample_precision(), "precision"}};
    const auto opening = [](const std::string& id) { return R"({"id":")" + id + R"(","title")"; };
    const std::string whole = words_of(whole_sample());
    for (const Expected& one : expected) {
        const std::string page = words_of({one.file});
        for (const Expected& other : expected) {
            EXPECT_EQ(holds(page, opening(other.section)), other.section == one.section)
                << other.section << " from " << one.file.path;
        }
        EXPECT_TRUE(holds(whole, opening(one.section))) << one.section;
    }
    EXPECT_TRUE(holds(whole, opening("claims")));
    EXPECT_FALSE(holds(whole, opening("missing")));
}

TEST(Report, SaysInASentenceWhatWasPlayed)
{
    const auto played = [](const std::string& configuration) {
        const nlohmann::json manifest{{"title", "mine"}, {"configuration", configuration}};
        return test::data_of(page_of({{"r/manifest.json", manifest.dump()}})).at("played").dump();
    };
    const std::string plain = "kind = \"table1\"\nseeds = 3\nalgorithms = [\"base\", \"sep\"]\n"
                              "tasks = [\"T1\", \"T2\"]\nhands = \"firm\"\n";
    EXPECT_EQ(played("title = \"mine\"\n" + plain + "both.delay = \"160ms\"\n"),
              R"(["Simulated hands (firm) played tasks P1, T1 and T2 with the algorithms base and )"
              R"(sep, under delay 160 ms, in sessions of 30 s; 3 seeds."])");
    EXPECT_EQ(played("title = \"mine\"\n" + plain +
                     "axis = { key = \"both.delay\", values = [\"0ms\", \"40ms\"] }\n"),
              R"(["Simulated hands (firm) played tasks P1, T1 and T2 with the algorithms base and )"
              R"(sep, with delay of the path varied (0 ms and 40 ms), in sessions of )"
              R"(30 s; 3 seeds."])");
    EXPECT_EQ(played("of another version"), R"(["mine."])");
}

/// The data of the page for a run with this configuration.
nlohmann::json data_of_run(const std::string& configuration, const std::string& title)
{
    const nlohmann::json manifest{{"title", title}, {"configuration", configuration}};
    return test::data_of(page_of(
        {{"r/manifest.json", manifest.dump()},
         {"r/table1_by_axis.csv",
          "parameter,value,algorithm,mean_mm\nhands,firm,base,1\nhands,relaxed,base,2\n"}}));
}

TEST(Report, KeepsTheTitleOfOnesOwnExperimentWithAnAxis)
{
    const std::string body = "kind = \"table1\"\nseeds = 2\nalgorithms = [\"base\"]\n"
                             "tasks = [\"T3\"]\n"
                             "axis = { key = \"hands\", values = [\"relaxed\", \"firm\"] }\n";
    const auto own = data_of_run("title = \"My grip\"\n" + body, "My grip");
    EXPECT_EQ(own.at("title"), "My grip");
    EXPECT_EQ(own.at("runs")[0].at("amounts").at("built_in"), false);
    const std::string title = "Table 1: 160 ms of delay";
    const auto other = data_of_run("title = \"" + title + "\"\n" + body, title);
    EXPECT_NE(other.at("title"), title) << "an axis makes another experiment of it";
    EXPECT_EQ(other.at("runs")[0].at("amounts").at("built_in"), true);
    EXPECT_EQ(other.at("runs")[0].at("amounts").at("meant").at("seeds"), 10);
    EXPECT_EQ(other.at("interval_seeds_min"), 6);
}

TEST(Report, HoldsOnesOwnExperimentAgainstNothing)
{
    results::File own = sample_table1();
    own.text = "algorithm,mean_mm,min_mm,max_mm,std_mm,paper_mean_mm,paper_max_mm,paper_std_mm,"
               "verdict,class,max_class,max_low_mm,max_high_mm\nbase,0.19,0,0.7,0.1,,,,,,,,\n";
    const std::string page = page_of({own});
    const auto title = [](const std::string& of) {
        return test::data_of(of).at("sections")[0].at("title").get<std::string>();
    };
    EXPECT_EQ(title(page), "How far the two copies are apart");
    for (const char* id : {"table1-mean", "table1-std", "table1-max"}) {
        const auto figure = test::figure_of(page, id);
        EXPECT_EQ(figure.at("series").size(), 1U) << "no bars of the paper";
        EXPECT_FALSE(figure.at("series")[0].at("bars")[0].contains("missed"));
    }
    EXPECT_EQ(title(page_of({sample_table1()})),
              "How far the two copies are apart, beside the paper’s Table 1");
}

TEST(Report, DrawsEachMeasureAgainstTheAxisWithItsInterval)
{
    const std::string heads = "parameter,value,algorithm,task,seed,mean_mm,max_mm,vibration_mm,"
                              "stiffness_ratio,force_vibration_n\n";
    const std::string rows = "both.delay,20ms,base,T1,1,1,2,0.1,,0\n"
                             "both.delay,20ms,base,T1,2,3,4,0.1,,0\n"
                             "both.delay,0.1s,base,T1,1,8,9,0.1,,0\n";
    const results::File table1{"r/table1_by_axis.csv",
                               "parameter,value,algorithm,mean_mm,min_mm,max_mm,std_mm\n"
                               "both.delay,20ms,base,1,0,2,1\n"};
    const auto page = page_of({table1, {"r/sessions_by_axis.csv", heads + rows}});
    const auto figure = test::figure_of(page, "axis-both-delay-T1-mean-mm");
    EXPECT_EQ(figure.at("x").dump(), R"({"label":"delay of the path","unit":"ms"})");
    const auto curve = figure.at("series")[0];
    EXPECT_EQ(curve.at("points").dump(), "[[20.0,2.0],[100.0,8.0]]") << "means of the seeds";
    EXPECT_EQ(curve.at("band").dump(), "[[20.0,1.0,3.0]]") << "and none of one seed";
    EXPECT_EQ(figure.at("caption"),
              "Mean of 2 seeds; the band is from the least to the most of the 2 seeds.");
    const auto force = test::figure_of(page, "axis-both-delay-T1-force-vibration-n");
    EXPECT_EQ(force.at("y").at("label"), "force vibration added") << "what sessions have of it";
    EXPECT_EQ(test::data_of(page).at("sections")[0].at("id"), "axis");
    const std::string other = "both.delay,20ms,base,P1,1,1,2,0.1,,0\n";
    EXPECT_EQ(test::figure_of(page_of({table1, {"r/sessions_by_axis.csv", heads + rows + other}}),
                              "axis-both-delay-P1-mean-mm")
                  .at("caption"),
              "Every seed plays the same session here.");
}

TEST(Report, CallsWhatFewSeedsGiveNo95PercentIntervalAndOneSeedGivesNone)
{
    const auto caption_of = [](int seeds) {
        std::string rows = "algorithm,task,seed,mean_mm\nbase,P1,1,13.6\n";
        for (int seed = 1; seed <= seeds; ++seed) rows += fmt::format("base,T2,{0},{0}.5\n", seed);
        const auto figure =
            figure_of({sample_tasks(), {"r/table1/sessions.csv", rows}}, "seeds-T2");
        const auto dot = figure.at("series")[0].at("dots")[0];
        EXPECT_EQ(dot.contains("low"), seeds > 1) << seeds;
        if (seeds == 3) {
            EXPECT_EQ(dot.at("low"), 1.5) << "the least itself";
        }
        return figure.at("caption").get<std::string>();
    };
    EXPECT_EQ(caption_of(1), "One seed: there is no interval.");
    EXPECT_EQ(caption_of(3), "Large: the mean of the seeds; the line is from the least to the most "
                             "of the 3 seeds. Small: each seed.");
    EXPECT_EQ(caption_of(6),
              "Large: the mean of the seeds; the line is its 95 % interval. Small: each seed.");
    const auto limit = [](int seeds) {
        results::File limits = sample_limits();
        limits.text += fmt::format("sep,delay,worst,151,=,ms,,,,151,140,147,153,{}\n", seeds);
        const auto series = figure_of({limits}, "limit-delay").at("series");
        for (const auto& one : series)
            for (const auto& bar : one.at("bars"))
                if (bar.at("value") == 151.0) return bar.contains("low");
        return false;
    };
    EXPECT_TRUE(limit(2));
    EXPECT_FALSE(limit(1));
}

TEST(Report, CarriesHowMuchWasPlayedBesideHowMuchSettlesAClaim)
{
    const auto amounts = [](const std::string& configuration) {
        const nlohmann::json manifest{{"title", "mine"}, {"configuration", configuration}};
        return test::data_of(page_of({{"r/manifest.json", manifest.dump()}}))
            .at("runs")[0]
            .at("amounts")
            .dump();
    };
    const std::string head = "title = \"t\"\nseeds = 3\nduration = \"6s\"\n"
                             "algorithms = [\"remote-proxy\"]\n";
    const std::string played = R"({"played":{"seeds":3,"duration_s":6.0},"built_in":false)";
    EXPECT_EQ(amounts(head + "kind = \"claims\"\ntasks = [\"T1\"]\n"),
              played + R"(,"meant":{"seeds":200,"duration_s":30.0}})");
    EXPECT_EQ(amounts(head + "kind = \"table1\"\ntasks = [\"T1\"]\n"), played + "}");
    EXPECT_EQ(amounts("of another version"), "null");
}

TEST(Report, DrawsTheFittedCurveItsPointsAndTheIntervalOfTheLimit)
{
    results::File curves = sample_curves();
    curves.text.clear();
    curves.text = "algorithm,impairment,task,level,unit,seed,counts,mean_mm,vibration_mm,"
                  "stiffness_ratio,force_vibration_n,tier\n";
    for (const auto& [level, failed] : {std::pair{140, 0}, {150, 1}, {160, 2}, {170, 4}}) {
        for (int seed = 0; seed < 4; ++seed)
            curves.text += fmt::format("base,delay,T2,{},ms,{},true,1,1,,1,{}\n", level, seed,
                                       seed < failed ? "unusable" : "good");
    }
    results::File limits = sample_limits();
    limits.text += "base,delay,T2,158,=,ms,,,,158,148,151,165,4\n";
    const auto figure = figure_of({limits, curves}, "failing-delay");
    const auto curve = figure.at("series")[0];
    EXPECT_EQ(curve.at("name"), "base in T2");
    EXPECT_EQ(curve.at("scatter").dump(), "[[140.0,0.0],[150.0,25.0],[160.0,50.0],[170.0,100.0]]");
    EXPECT_EQ(curve.at("crossing").dump(), R"({"y":50.0,"low":151.0,"high":165.0})");
    double before = -1.0;
    for (const auto& point : curve.at("points")) {
        EXPECT_GE(point[1].get<double>(), before) << "it only rises";
        before = point[1].get<double>();
    }
    EXPECT_GT(before, 80.0);
}

TEST(Report, DrawsTheNumbersOfEachClaimAgainstWhatItAccepts)
{
    const results::File numbers{
        "r/beat/claims_numbers.csv",
        "claim,number,value,low,high,accept_low,accept_high,unit,judged_by,sessions,kept\n"
        "mean discrepancy,P1,5.97,5.5,6.3,,6,mm,mean,10,true\n"
        "stiffness,,1.46,0.98,1.46,0.75,1.25,,worst,10,false\n"};
    const auto page = page_of({sample_claims(), numbers});
    const auto distances = test::figure_of(page, "claims-mm");
    EXPECT_EQ(distances.at("kind"), "dots");
    EXPECT_EQ(distances.at("y").at("categories").dump(), R"(["mean discrepancy: P1"])");
    const auto row = distances.at("series")[0].at("dots")[0];
    EXPECT_EQ(row.at("value"), 5.97);
    EXPECT_EQ(row.at("high"), 6.3);
    EXPECT_EQ(row.at("to"), 6.0);
    EXPECT_FALSE(row.contains("from") || row.contains("missed"));
    EXPECT_EQ(test::figure_of(page, "claims-ratio").at("series")[0].at("dots")[0].at("missed"),
              true);
    results::File one = numbers;
    one.text = "claim,number,value,low,high,accept_low,accept_high,unit,judged_by,sessions,kept\n"
               "apart,,0.5,0.5,0.5,,6,mm,worst,1,true\n";
    EXPECT_FALSE(test::figure_of(page_of({sample_claims(), one}), "claims-mm")
                     .at("series")[0]
                     .at("dots")[0]
                     .contains("low"))
        << "one session has no interval";
}

TEST(Report, DrawsNumbersBesideThePapersAndMissesInRed)
{
    const auto of = [&](const char* id) {
        return figure_of({sample_table1()}, id).at("series")[1].at("bars")[2];
    };
    EXPECT_EQ(of("table1-max").at("text"), "66.6");
    EXPECT_TRUE(of("table1-max").contains("missed"));
    EXPECT_FALSE(of("table1-mean").contains("missed"));
}

TEST(Report, ShowsTheErrorOfEachFigureBesideItsCost)
{
    const auto figure = figure_of({sample_precision()}, "precision-base-T1-vibration-mm");
    EXPECT_EQ(figure.at("x").at("scale"), "log");
    EXPECT_EQ(figure.at("series")[0].at("points").dump(), "[[480000.0,0.2],[4800000.0,0.063]]");
}

TEST(Report, DrawsEachSeedOfEachTaskAndALineThroughTheMedians)
{
    results::File curves = sample_curves();
    constexpr std::string_view ratio = "stiffness_ratio";
    curves.text.replace(curves.text.find(ratio), ratio.size(), "slow_stiffness_error");
    curves.text += "base,delay,T2,120,ms,1,true,6.8,0.30,0.5,0.0200,usable\n"
                   "base,delay,T2,120,ms,2,true,6.8,0.30,0.7,0.0200,usable\n"
                   "base,delay,T2,240,ms,1,false,6.8,0.30,0.9,0.0200,usable\n";
    const auto vibration = figure_of({curves}, "curve-delay-T1-vibration");
    EXPECT_EQ(vibration.at("title"), "T1: vibration");
    EXPECT_EQ(vibration.at("y").dump(), R"({"label":"vibration","unit":"mm","scale":"log"})");
    const auto stiffness = figure_of({curves}, "curve-delay-T2-stiffness").at("series")[0];
    EXPECT_EQ(stiffness.at("scatter").dump(), "[[120.0,0.5],[120.0,0.7]]")
        << "not the one of the coarse scan";
    EXPECT_EQ(stiffness.at("points").dump(), "[[120.0,0.6]]");
}

TEST(Report, DrawsABoundOpen)
{
    const auto bar = figure_of({sample_limits()}, "limit-delay-by-task").at("series")[0];
    EXPECT_EQ(bar.at("bars")[0].at("text"), "> 320");
    EXPECT_EQ(bar.at("bars")[0].at("open"), true);
}

TEST(Report, DrawsIntervalsAndThePaperWhereItStatesANumber)
{
    results::File limits = sample_limits();
    limits.text +=
        "dead-reckoning,random-loss,worst,66,=,percent,80,selected-met,selected,66,64,65,"
        "67,40\n"
        "base,jitter,worst,20,>,ms,,,predicted,20,,20,,40\n";
    const auto delay = figure_of({limits}, "limit-delay");
    EXPECT_TRUE(holds(delay.at("caption").dump(), "40 seeds; the line is its 95 % interval"));
    EXPECT_EQ(delay.at("series")[1].at("bars")[0].at("high"), 163.0);
    const std::string jitter = figure_of({limits}, "limit-jitter").dump();
    EXPECT_FALSE(holds(jitter, "base, paper: 15 ms"))
        << "the paper states no limit of base's jitter";
    EXPECT_TRUE(
        holds(figure_of({limits}, "limit-random-loss").dump(), "dead-reckoning, paper: 80 %"));
}

TEST(Report, ShowsWhatWasNotChosenAndTheSeedsOfTwoAlgorithms)
{
    const std::string limit = "delay,worst,131,=,ms,,,,131,120,128,134,20\n";
    const std::string page = page_of(
        {{"r/velocity-rule/limits_by_axis.csv",
          "parameter,value,algorithm,impairment,task,limit,bound,unit,paper_limit,status,class,p50,"
          "p10,ci_low,ci_high,seeds\n"
          "algorithm.dead-reckoning.velocity,nominal,dead-reckoning," +
              limit + "algorithm.dead-reckoning.velocity,sender,dead-reckoning," + limit},
         {"r/table1/paired.csv", "algorithm,reference,task,measure,seeds,difference,ci_low,ci_high,"
                                 "sign_test_p\nsep,base,T3,mean_mm,10,0.27,0.2,0.3,0.002\n"}});
    EXPECT_TRUE(holds(page, "Limit of delay by the velocity of dead reckoning, 20 seeds"));
    const auto figure =
        test::figure_of(page, "axis-algorithm-dead-reckoning-velocity-delay").at("x");
    EXPECT_EQ(figure.at("categories").dump(), R"(["nominal","sender"])");
    EXPECT_EQ(test::data_of(page).at("tables").at("paired").at("rows").size(), 1U);
}

TEST(Report, CountsThePointsThatEachAlgorithmBears)
{
    const auto line = [](int point, const char* algorithm, const char* task, const char* tier) {
        return fmt::format("{0},{0}0ms,{1},{2},40,0,0,1,,,,{3}\n", point, algorithm, task, tier);
    };
    std::string csv = "point,plane.delay,algorithm,task,delay_ms,jitter_ms,loss_percent,mean_mm,"
                      "vibration_mm,stiffness_ratio,force_vibration_n,tier\n";
    for (const int point : {1, 2, 3, 4}) {
        csv += line(point, "base", "T1", point < 4 ? "good" : "unusable");
        csv += line(point, "base", "T3", point > 1 ? "usable" : "unusable");
    }
    const std::string page = page_of({{"r/any/qos_by_point.csv", csv}});
    EXPECT_TRUE(holds(page, "Conditions varied together"));
    EXPECT_TRUE(holds(page, "Share of 4 points"));
    const auto bars = test::figure_of(page, "points").at("series")[0].at("bars");
    EXPECT_EQ(bars[0].at("value"), 75.0) << "of each task";
    EXPECT_EQ(bars[1].at("value"), 75.0);
    EXPECT_EQ(bars[2].at("value"), 50.0) << "of both at once";
}

TEST(Report, EscapesWhatComesFromFiles)
{
    std::vector<results::File> files{
        {"r/<b>/manifest.json", R"({"title": "<img src=x>", "valid": false,
            "<img src=x>": "<img src=x>", "invalid_because": ["<img src=x>"],
            "configuration": "<img src=x>"})"}};
    for (results::File file : whole_sample()) {
        for (std::size_t at = 0; (at = file.text.find("T1", at)) != std::string::npos;) {
            file.text.replace(at, 2, "<img src=x>");
        }
        for (std::size_t at = 0; (at = file.text.find("\nbase", at)) != std::string::npos;) {
            file.text.replace(at + 1, 4, "<img src=x>");
        }
        if (!file.path.ends_with(".json")) files.push_back(std::move(file));
    }
    const auto out = report_files(files);
    const std::string page = text_of(out, "report.html");
    EXPECT_FALSE(holds(page, "<img"));
    const auto run = test::data_of(page).at("runs")[0];
    EXPECT_EQ(run.at("folder"), "r/<b>");
    EXPECT_EQ(run.at("manifest").at("title"), "<img src=x>") << "as data it is unchanged";
    for (const results::File& file : out) {
        EXPECT_FALSE(holds(file.path, "<") || holds(file.path, "..")) << file.path;
    }
}

TEST(Report, ExcludesARealTimeRunThatIsNotValid)
{
    EXPECT_FALSE(holds(figure_of({sample_real_time()}, "real-time").dump(), "9.99"));
}

TEST(Report, MarksTheWorstOfTheTasksInThePlane)
{
    const auto figure = figure_of({sample_qos()}, "qos-base-0");
    const auto& cells = figure.at("series")[0].at("cells");
    EXPECT_TRUE(cells[0].at("tip").get<std::string>().starts_with(
        "0 ms, ± 0 ms, 0 %\nT1: good, vibration 0.010 mm, stiffness –, force vibration 0.010 N\n"
        "T2: usable"));
    EXPECT_EQ(cells[0].at("colour"), "usable") << "T2 is only usable there";
    EXPECT_EQ(cells.size(), 2U) << "what was not tried has no field";
    results::File limited = sample_qos();
    limited.text = "algorithm,task,delay_ms,jitter_ms,loss_percent,mean_mm,vibration_mm,"
                   "stiffness_ratio,force_vibration_n,tier,limited_by\n"
                   "base,T1,0,0,0,0.1,1.31,,0.0100,unusable,vibration 1.31 mm > 1 mm\n";
    EXPECT_TRUE(figure_of({limited}, "qos-base-0")
                    .at("series")[0]
                    .at("cells")[0]
                    .at("tip")
                    .get<std::string>()
                    .ends_with("force vibration 0.010 N; vibration 1.31 mm > 1 mm"));
}

TEST(Report, CarriesTheReplayAsJsonThatCannotCloseItsElement)
{
    results::File replay = sample_replay();
    replay.path = "r/replay/<!--<script>-T3.csv";
    EXPECT_TRUE(holds(page_of({replay}), R"("algorithm":"\u003c!--\u003cscript>")"));
    EXPECT_TRUE(holds(page_of({sample_replay()}), R"("bodies":[{"x":{"step":)"));
    EXPECT_TRUE(holds(page_of({sample_replay()}), R"("y":0.0,)"));
    // 0 and -3 in 16 bits: 0000 and 0180, low byte first.
    EXPECT_TRUE(holds(page_of({sample_replay()}), R"("data":"AAABgA==")"));
}

TEST(Report, CarriesTheDataOfItsFigures)
{
    const std::string page = page_of({sample_limits(), sample_curves()});
    const auto bar = test::figure_of(page, "limit-delay").at("series")[1].at("bars")[0];
    EXPECT_EQ(bar.at("value"), 160.0);
    EXPECT_EQ(bar.at("low"), 157.0);
    EXPECT_EQ(bar.at("high"), 163.0);
    const std::string words = test::words_of(page);
    const auto data = test::data_of(page);
    for (const auto& figure : data.at("figures")) {
        const auto id = figure.at("id").get<std::string>();
        EXPECT_TRUE(holds(words, '"' + id + '"')) << id << " is in a section";
        for (const char* key : {"title", "x", "y", "series"}) EXPECT_TRUE(figure.contains(key));
        for (const char* key : {"label", "unit"}) EXPECT_TRUE(figure.at("x").contains(key));
        for (const auto& series : figure.at("series")) EXPECT_TRUE(series.contains("name"));
    }
}

TEST(Report, CarriesThePlayerOnlyWhereThereIsAReplay)
{
    const auto carries = [](const std::vector<results::File>& files, const char* name) {
        const auto modules = test::json_in(page_of(files), "modules");
        return modules.at("plain").contains(name) || modules.at("packed").contains(name);
    };
    EXPECT_TRUE(carries({sample_curves()}, "report/sections.js"));
    for (const char* name : {"report/player.js", "paint/space.js", "pane.js"}) {
        EXPECT_TRUE(carries({sample_replay()}, name)) << name;
        EXPECT_FALSE(carries({sample_curves()}, name)) << name;
    }
    const auto assets = lab_assets();
    const bool has_library = std::ranges::any_of(
        assets, [](const Asset& asset) { return asset.name == "three.module.min.js"; });
    EXPECT_EQ(carries({sample_replay()}, "three.module.min.js"), has_library);
    EXPECT_EQ(carries({sample_replay()}, "three-LICENSE.txt"), has_library);
    EXPECT_TRUE(holds(page_of({sample_curves()}), "import(\"hapnet/report/report.js\")"));
}

TEST(Report, LinksEachFigureToTheRowsBehindIt)
{
    const std::vector<results::File> rows{sample_limits(), sample_curves(), sample_trajectories()};
    auto results = read_results(as_written(rows));
    ASSERT_TRUE(results);
    results->files = {{"limits", "fig 6a/limits.csv"},
                      {"curves", "curves.csv"},
                      {"trajectories", "fig7/trajectories.csv"}};
    const auto files = report_of(*results);
    const std::string page = text_of(files, "report.html");
    const auto sources = [](std::string_view of, const char* id) {
        return test::figure_of(of, id).at("sources").dump();
    };
    EXPECT_EQ(sources(page, "limit-delay"), R"(["fig 6a/limits.csv"])");
    EXPECT_EQ(sources(page, "curve-delay-T1-vibration"), R"(["curves.csv"])");
    EXPECT_EQ(sources(page, "fig7-sep"), R"(["fig7/trajectories.csv"])");
    EXPECT_EQ(text_of(files, "figures/limit-delay.csv"), "");
    results->files.clear();
    const auto own = report_of(*results);
    EXPECT_EQ(sources(text_of(own, "report.html"), "limit-delay"),
              R"(["figures/limit-delay.csv"])");
    const std::string bars = text_of(own, "figures/limit-delay.csv");
    EXPECT_TRUE(bars.starts_with(
        "group,bar,value_ms,low_ms,high_ms\n\"base\",\"base, paper: 160 ms\",160.0,,"
        "\n"))
        << bars;
    EXPECT_TRUE(holds(bars, ",160.0,157.0,163.0\n")) << bars;
    const std::string curves = text_of(own, "figures/curve-delay-T1-vibration.csv");
    EXPECT_TRUE(holds(curves, "\n\"base\",80.0,1.2\n")) << curves;
}

TEST(Report, IsTheSameForTheSameFilesInAnyOrder)
{
    auto files = whole_sample();
    const auto first = report_files(files);
    std::reverse(files.begin(), files.end());
    const auto second = report_files(files);
    ASSERT_EQ(first.size(), second.size());
    for (std::size_t i = 0; i < first.size(); ++i) {
        EXPECT_EQ(first[i].path, second[i].path);
        EXPECT_EQ(first[i].text, second[i].text) << first[i].path;
    }
}

TEST(Report, FetchesNothing)
{
    const std::string page = page_of(whole_sample());
    for (const char* word : {"src=", "@import", "url(", "<link", "fetch(", "https:"})
        EXPECT_FALSE(holds(page, word)) << word;
}

} // namespace
} // namespace hapnet::lab::report
