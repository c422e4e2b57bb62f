// SPDX-FileCopyrightText: 2026 The Hapnet authors
// SPDX-License-Identifier: MIT
#include "lab/report/section.hpp"
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
    const auto opening = [](const std::string& id) { return "<section id='" + id + "'"; };
    const std::string whole = page_of(whole_sample());
    for (const Expected& one : expected) {
        const std::string page = page_of({one.file});
        for (const Expected& other : expected) {
            EXPECT_EQ(holds(page, opening(other.section)), other.section == one.section)
                << other.section << " from " << one.file.path;
        }
        EXPECT_TRUE(holds(whole, opening(one.section))) << one.section;
    }
    EXPECT_TRUE(holds(whole, opening("claims")));
    EXPECT_FALSE(holds(whole, opening("missing")));
}

TEST(Report, SaysWhichCommandMakesWhatIsMissing)
{
    const std::string page = page_of({sample_table1()});
    EXPECT_TRUE(holds(page, "<code>scripts/fig6b.sh --out r/fig6b</code>"));
    EXPECT_TRUE(holds(page, "<code>scripts/table1.sh --real-time --out r/table1</code>"));
    EXPECT_FALSE(holds(page, "<code>scripts/table1.sh --out r/table1</code></li>\n<li>Table 1"));
}

TEST(Report, ShowsNumbersBesideThePapersWithTheirBandsAndMissesInRed)
{
    const std::string page = page_of({sample_table1()});
    EXPECT_TRUE(holds(page, "<td class='ours'>13.61</td><td class='paper'>13.79</td>"
                            "<td class='band'>12.41 to 15.17</td>"));
    EXPECT_TRUE(holds(page, "<td class='ours missed'>66.61</td><td class='paper'>58.85</td>"
                            "<td class='band'>40.00 to 65.00</td>"));
    EXPECT_TRUE(holds(page, "<span class='badge calibrated'>calibrated</span>"));
    EXPECT_TRUE(holds(page, "fill='var(--missed)' font-weight='bold'>66.6</text>"));
    EXPECT_FALSE(holds(page, "fill='var(--missed)' font-weight='bold'>3.4</text>"));
}

TEST(Report, ShowsWhatIsClaimedBeyondThePaperAndWhatOfItIsMissed)
{
    const std::string page = page_of({sample_claims(), sample_claims_quantiles()});
    EXPECT_TRUE(holds(page, "2 claims, made before the first run; 1 missed"));
    EXPECT_TRUE(holds(page, "<td class='ours'>5.97, 5.42</td><td class='ours'>5.96, 5.41</td>"));
    EXPECT_TRUE(
        holds(page, "<td class='ours missed'>0.98 to 1.46</td><td class='ours'>0.98 to 1.32</td>"));
    EXPECT_FALSE(holds(page_of({sample_claims()}), "0.98 to 1.32")) << "one file alone is shown";
    EXPECT_TRUE(holds(page, "<span class='badge missed'>missed</span>"));
}

TEST(Report, ShowsTheSlowForceThatNoClaimIsAboutOfTheFirstAlgorithm)
{
    const std::string page = page_of({sample_claims(), sample_claim_sessions()});
    EXPECT_TRUE(holds(page, "<th scope='row'>100ms</th><td>0.070 (0.090)</td>"));
    EXPECT_FALSE(holds(page_of({sample_claims()}), "above 2 Hz")) << "without the sessions";
}

TEST(Report, ShowsTheErrorOfEachFigureBesideItsCost)
{
    const std::string page = page_of({sample_precision()});
    EXPECT_TRUE(holds(page, "<section id='precision'"));
    // 0.7 and 0.3 mm beyond that of 0.5 ms: the order is 1.
    EXPECT_TRUE(holds(page, "<td class='words'>mean, mm</td><td>13.2</td><td>0.7</td><td>0.3</td>"
                            "<td>reference</td><td>1.0</td>"));
    EXPECT_TRUE(holds(page, "<td>0.1<br>(0.08 … 0.12)</td><td>reference</td><td>–</td>"
                            "<td>0.2</td><td>0.063</td><td>0.063</td>"));
    results::File swaying = sample_precision();
    const std::string above = "2ms,0.5ms,1,120000,13.500000,0.300000";
    swaying.text.replace(swaying.text.find(above), above.size(),
                         "2ms,0.5ms,1,120000,12.900000,-0.300000");
    EXPECT_TRUE(holds(page_of({swaying}), "<td>-0.3</td><td>reference</td><td>–</td>"));
    const auto files = report_files({sample_precision()});
    EXPECT_TRUE(std::ranges::any_of(files, [](const results::File& file) {
        return file.path == "figures/precision-base-T1-vibration-mm.svg";
    }));
}

TEST(Report, DrawsEachSeedOfEachTaskAndALineThroughTheMedians)
{
    results::File curves = sample_curves();
    curves.text += "base,delay,T2,120,ms,1,true,6.8,0.30,0.5,0.0200,usable\n"
                   "base,delay,T2,120,ms,2,true,6.8,0.30,0.7,0.0200,usable\n"
                   "base,delay,T2,240,ms,1,false,6.8,0.30,0.9,0.0200,usable\n";
    const std::string page = page_of({curves});
    EXPECT_TRUE(holds(page, "T1: vibration"));
    EXPECT_TRUE(holds(page, ">mm, log scale</text>"));
    const auto begin = page.find("aria-label='T2: stiffness'");
    ASSERT_NE(begin, std::string::npos);
    const std::string plot = page.substr(begin, page.find("</figure>", begin) - begin);
    std::size_t points = 0;
    for (std::size_t at = 0; (at = plot.find("<circle", at)) != std::string::npos; ++at) ++points;
    EXPECT_EQ(points, 2U) << "not the one of the coarse scan";
    const std::string_view unmeasured = "no session can have failed by it: stiffness.</p>";
    EXPECT_FALSE(holds(page, unmeasured));
    EXPECT_TRUE(holds(page_of({sample_curves()}), unmeasured));
}

TEST(Report, DrawsABoundOpenAndWritesIt)
{
    const std::string page = page_of({sample_limits()});
    EXPECT_TRUE(holds(page, "&gt; 320 ms"));
    EXPECT_TRUE(holds(page, ">&gt; 320</text>"));
    EXPECT_TRUE(holds(page, "<td class='ours'>145 ms</td><td>143.0 … 147.0</td><td>140.0</td>"
                            "<td>40</td><td class='paper'>150 ms</td>"
                            "<td class='band'>130 to 155, less than base</td>"));
    EXPECT_TRUE(holds(page_of({sample_loss_limits()}), "&gt; 95 of 100"));
}

TEST(Report, IsGreenForPredictionsAloneAndDrawsIntervals)
{
    results::File limits = sample_limits();
    limits.text +=
        "dead-reckoning,random-loss,worst,66,=,percent,80,selected-met,selected,66,64,65,"
        "67,40\n"
        "base,jitter,worst,20,>,ms,,,predicted,20,,20,,40\n";
    const std::string page = page_of({limits});
    EXPECT_TRUE(holds(page, "<span class='badge met'>predicted-met</span>"));
    EXPECT_TRUE(holds(page, "<span class='badge seen'>selected-met</span>"));
    EXPECT_TRUE(holds(page, "40 seeds; the line is the 95 % interval"));
    EXPECT_TRUE(holds(page, "h8M")) << "the ends of an interval";
    EXPECT_FALSE(holds(page, "base, paper: 15 ms")) << "the paper states no limit of base's jitter";
    EXPECT_TRUE(holds(page, "dead-reckoning, paper: 80 %"));
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
    EXPECT_TRUE(holds(page, ">sender</text>"));
    EXPECT_TRUE(holds(page, "<td>0.270</td><td>0.200 … 0.300</td><td>0.002</td>"));
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
    EXPECT_TRUE(holds(page, ">75</text>")) << "of each task";
    EXPECT_TRUE(holds(page, ">50</text>")) << "of both at once";
}

TEST(Report, SortsWhatStandsAgainstThePaperByTheFilesAlone)
{
    const auto results = read_results(whole_sample());
    ASSERT_TRUE(results);
    const Claims main = main_claims(*results);
    EXPECT_EQ(main.calibrated.size(), 2U); // Table 1 and the delay of base
    EXPECT_EQ(main.by_construction.size(), 1U);
    EXPECT_EQ(main.met.size(), 1U);
    ASSERT_EQ(main.missed.size(), 3U);
    EXPECT_EQ(main.missed[2], "Limit of jitter, <b>dead-reckoning</b>, worst of the tasks: 2.5 ms "
                              "(paper: 5 ms), 95 %: 2.4 … 2.6, selected");
    EXPECT_TRUE(holds(page_of(whole_sample()), "<b>3</b> missed</a>"));
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
    EXPECT_TRUE(holds(page, "&lt;img src=x&gt;"));
    for (const results::File& file : out) {
        EXPECT_FALSE(holds(file.path, "<") || holds(file.path, "..")) << file.path;
        EXPECT_FALSE(file.path.ends_with(".svg") && holds(file.text, "<img")) << file.path;
    }
}

TEST(Report, SaysWhetherItIsValidAndWhyNot)
{
    EXPECT_TRUE(holds(page_of({sample_manifest()}), "<b>Valid.</b>"));
    EXPECT_TRUE(holds(page_of({sample_table1()}), "There is no manifest.json"));
    const std::string page =
        page_of({{"r/fig7/manifest.json", R"({"valid": false, "invalid_because": ["stopped"]})"}});
    EXPECT_TRUE(holds(page, "<b>Not valid.</b>"));
    EXPECT_TRUE(holds(page, "<li>r/fig7: stopped</li>"));
    EXPECT_TRUE(holds(page_of({{"r/manifest.json", "{}"}}), "r: does not say why"));
    EXPECT_TRUE(holds(page_of({{"r/manifest.json", R"({"kind": "real-time", "valid": false})"}}),
                      "r: not every session over real UDP kept its timing"));
}

TEST(Report, ExcludesARealTimeRunThatIsNotValid)
{
    const std::string page = page_of({sample_real_time()});
    EXPECT_TRUE(holds(page, "<td class='ours'>-4.5 %</td>"));
    EXPECT_TRUE(holds(page, "<td class='excluded'>9.99</td>"));
    EXPECT_TRUE(holds(page, "excluded: late ticks"));
    EXPECT_FALSE(holds(page, "-26.6"));
    EXPECT_FALSE(holds(page, ">9.99</text>")); // no bar
}

TEST(Report, SaysHowFarCopiesAreTurnedApartWhereABodyTurns)
{
    EXPECT_FALSE(holds(page_of({sample_tasks()}), "turned<br>apart"));
    results::File tasks = sample_tasks();
    tasks.text.insert(tasks.text.find('\n'), ",turned_apart_deg");
    tasks.text.insert(tasks.text.size() - 1, ",12.345");
    const std::string page = page_of({tasks});
    EXPECT_TRUE(holds(page, "turned<br>apart, max deg"));
    EXPECT_TRUE(holds(page, "<td>12.35</td>") || holds(page, "<td>12.34</td>"));
}

TEST(Report, MarksTheWorstOfTheTasksInThePlane)
{
    const std::string page = page_of({sample_qos()});
    EXPECT_TRUE(holds(page, "0 ms, ± 0 ms, 0 %\nT1: good, vibration 0.010 mm, stiffness –, force "
                            "vibration 0.010 N\nT2: usable"));
    EXPECT_FALSE(holds(page, "fill='var(--good)'")); // T2 is only usable there
    EXPECT_TRUE(holds(page, "fill='var(--usable)'"));
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

/// The data of the figures that a page carries.
nlohmann::json figures_of(std::string_view page)
{
    constexpr std::string_view opening = "<script type='application/json' id='figures'>";
    const auto begin = page.find(opening);
    EXPECT_NE(begin, std::string_view::npos);
    const auto end = page.find("</script>", begin);
    return nlohmann::json::parse(page.substr(begin + opening.size(), end - begin - opening.size()));
}

TEST(Report, CarriesTheDataOfItsFiguresInOneElementThatItsScriptDraws)
{
    const auto files = report_files({sample_limits(), sample_curves()});
    const std::string page = text_of(files, "report.html");
    const auto data = figures_of(page);
    const auto& bar = data["limit-delay"]["groups"][0]["bars"][1];
    EXPECT_EQ(bar["value"], 160.0);
    EXPECT_EQ(bar["low"], 157.0);
    EXPECT_EQ(bar["high"], 163.0);
    EXPECT_EQ(data["curve-delay-T1-vibration"]["log_y"], true);
    for (const auto& [name, figure] : data.items()) {
        EXPECT_TRUE(holds(page, "<figure data-figure='" + name + "'>")) << name;
        EXPECT_FALSE(text_of(files, "figures/" + name + ".svg").empty()) << name;
    }
}

TEST(Report, CarriesThePaintersOfWhatItShowsAndStartsThem)
{
    const std::string page = page_of({sample_curves(), sample_replay()});
    EXPECT_TRUE(holds(page, "<script type='application/json' id='modules'>{\"plain\":{"));
    EXPECT_TRUE(holds(page, "import(\"hapnet/report/report.js\")"));
    EXPECT_FALSE(holds(page_of({sample_qos()}), "id='modules'")) << "its maps stand still";
}

TEST(Report, LinksEachFigureToTheRowsBehindIt)
{
    const std::vector<results::File> rows{sample_limits(), sample_curves(), sample_trajectories()};
    auto results = read_results(rows);
    ASSERT_TRUE(results);
    results->files = {"fig 6a/limits.csv", "curves.csv", "fig7/trajectories.csv"};
    const auto files = report_of(*results, "r");
    const std::string page = text_of(files, "report.html");
    EXPECT_TRUE(holds(page, "Data: <a href='fig%206a/limits.csv'>fig 6a/limits.csv</a>"));
    EXPECT_TRUE(holds(page, "Data: <a href='curves.csv'>curves.csv</a>"));
    EXPECT_TRUE(holds(page, "Data: <a href='fig7/trajectories.csv'>fig7/trajectories.csv</a>"));
    EXPECT_EQ(text_of(files, "figures/limit-delay.csv"), "");
    results->files.clear();
    const auto own = report_of(*results, "r");
    EXPECT_TRUE(holds(text_of(own, "report.html"), "<a href='figures/limit-delay.csv'>"));
    const std::string bars = text_of(own, "figures/limit-delay.csv");
    EXPECT_TRUE(
        bars.starts_with("group,bar,value,low,high\n\"base\",\"base, paper: 160 ms\",160.0,,"
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
    std::string page = page_of(whole_sample());
    constexpr std::string_view name_of_svg = "http://www.w3.org/2000/svg";
    for (std::size_t at = 0; (at = page.find(name_of_svg)) != std::string::npos;) {
        page.erase(at, name_of_svg.size());
    }
    for (const char* word : {"http", "src=", "@import", "url(", "<link", "fetch("}) {
        EXPECT_FALSE(holds(page, word)) << word;
    }
}

TEST(Figures, StandAloneInLightColours)
{
    const auto files = report_files(whole_sample());
    const std::string svg = text_of(files, "figures/limit-delay.svg");
    EXPECT_TRUE(svg.starts_with("<svg font-family="));
    EXPECT_FALSE(holds(svg, "var("));
    EXPECT_TRUE(holds(svg, "fill='#0072b2'")); // base
    EXPECT_FALSE(text_of(files, "figures/fig7-sep.svg").empty());
    EXPECT_FALSE(text_of(files, "figures/qos-base-0.svg").empty());
}

} // namespace
} // namespace hapnet::lab::report
