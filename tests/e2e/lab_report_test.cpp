// SPDX-FileCopyrightText: 2026 The Hapnet authors
// SPDX-License-Identifier: MIT
// The output of hapnet-lab report about folders, and about arguments that are no folders.
#include "proto/record/writer.hpp"
#include "tests/e2e/process.hpp"
#include "tests/support/page_data.hpp"

#include <chrono>
#include <filesystem>
#include <fstream>
#include <gtest/gtest.h>
#include <nlohmann/json.hpp>
#include <string>
#include <vector>

namespace hapnet::e2e {

namespace {

namespace fs = std::filesystem;
using Json = nlohmann::json;

/// A results.json with one table of one row.
std::string results_of(const std::string& name, const Json& row)
{
    Json columns = Json::array(), cells = Json::array();
    for (const auto& [key, cell] : row.items()) {
        columns.push_back({{"key", key}});
        cells.push_back(cell);
    }
    const Json table{{"columns", columns}, {"rows", Json::array({cells})}};
    return Json{{"version", 1}, {"tables", {{name, table}}}}.dump();
}

const std::string table1 = results_of("table1", {{"algorithm", "base"},
                                                 {"mean_mm", 13.611},
                                                 {"min_mm", 0},
                                                 {"max_mm", 47.251},
                                                 {"std_mm", 10.683},
                                                 {"paper_mean_mm", 13.789},
                                                 {"paper_max_mm", 46.01},
                                                 {"paper_std_mm", 10.986},
                                                 {"verdict", "calibrated"},
                                                 {"class", "calibrated"},
                                                 {"max_class", "calibrated"}});

void write_file(const fs::path& path, const std::string& text)
{
    fs::create_directories(path.parent_path());
    std::ofstream{path} << text;
}

TEST(LabReport, WritesThePageAndItsFiguresOfAFolderAndItsSubfolders)
{
    const TemporaryFolder temporary;
    const fs::path folder = temporary.file("results");
    write_file(folder / "table1/results.json", table1);
    write_file(folder / "results.json", results_of("qos", {{"algorithm", "base"},
                                                           {"task", "T1"},
                                                           {"delay_ms", 0},
                                                           {"jitter_ms", 0},
                                                           {"loss_percent", 0},
                                                           {"mean_mm", 0.1},
                                                           {"vibration_mm", 0.01},
                                                           {"stiffness_ratio", nullptr},
                                                           {"force_vibration_n", 0.01},
                                                           {"tier", "good"}}));
    write_file(folder / "notes.txt", "not ours");
    const auto outcome = run("hapnet-lab", {"report", folder.string()});
    EXPECT_EQ(outcome.exit, 0) << outcome.err;
    EXPECT_EQ(outcome.out, (folder / "report.html").string() + "\n");
    const auto page = text_of((folder / "report.html").string());
    const auto data = test::data_of(page);
    std::vector<std::string> sections;
    for (const auto& section : data.at("sections")) sections.push_back(section.at("id"));
    EXPECT_EQ(sections, (std::vector<std::string>{"table1", "qos", "claims"}));
    EXPECT_EQ(test::figure_of(page, "table1-mean").at("sources")[0], "table1/table1.csv");
    EXPECT_EQ(test::figure_of(page, "qos-base-0").at("sources")[0], "qos.csv");
    EXPECT_EQ(run("hapnet-lab", {"report", folder.string()}).exit, 0);
    EXPECT_EQ(text_of((folder / "report.html").string()), page) << "made again, it is the same";
}

TEST(LabReport, WritesThePageWhereOutSaysAndNamesItsSourcesFromThere)
{
    const TemporaryFolder temporary;
    const fs::path folder = temporary.file("results");
    const fs::path page = fs::path{temporary.file("pages")} / "mine.html";
    write_file(folder / "table1/results.json", table1);
    const auto outcome = run("hapnet-lab", {"report", folder.string(), "--out", page.string()});
    EXPECT_EQ(outcome.exit, 0) << outcome.err;
    EXPECT_EQ(outcome.out, page.string() + "\n");
    EXPECT_FALSE(fs::exists(folder / "report.html"));
    EXPECT_EQ(test::figure_of(text_of(page.string()), "table1-mean").at("sources")[0],
              "../results/table1/table1.csv");
    const auto refused = run("hapnet-lab", {"report", folder.string(), "--out", folder.string()});
    EXPECT_EQ(refused.exit, 2);
    EXPECT_NE(refused.err.find("is a folder: name the page, such as " + folder.string()),
              std::string::npos)
        << refused.err;
}

TEST(LabReport, WritesTheManifestOfAFolderOfResultsAndAgainWhenOneHasChanged)
{
    const TemporaryFolder temporary;
    const fs::path folder = temporary.file("all");
    const auto part = [](const std::string& start, bool is_valid) {
        return Json{{"command", "hapnet-lab run"},
                    {"title", "a title"},
                    {"seeds", {1, 2}},
                    {"configuration", "kind = \"plane\"\n"},
                    {"start", start},
                    {"wall_time_s", 1.5},
                    {"valid", is_valid}}
            .dump();
    };
    write_file(folder / "qos/manifest.json", part("2026-11-25T10:00:00Z", true));
    write_file(folder / "table1/manifest.json", part("2026-11-25T09:00:00Z", true));
    write_file(folder / "table1/results.json", table1);
    ASSERT_EQ(run("hapnet-lab", {"report", folder.string()}).exit, 0);
    auto manifest = Json::parse(text_of((folder / "manifest.json").string()));
    EXPECT_EQ(manifest["kind"], "several");
    EXPECT_EQ(manifest["start"], "2026-11-25T09:00:00Z");
    EXPECT_EQ(manifest["wall_time_s"], 3.0);
    EXPECT_EQ(manifest["valid"], true);
    ASSERT_EQ(manifest["results"].size(), 2U);
    EXPECT_EQ(manifest["results"][0]["folder"], "qos");
    EXPECT_EQ(manifest["results"][1]["folder"], "table1");
    EXPECT_EQ(manifest["seeds"]["qos"], (Json{1, 2}));
    const auto page = text_of((folder / "report.html").string());

    write_file(folder / "qos/manifest.json", part("2026-11-25T10:00:00Z", false));
    ASSERT_EQ(run("hapnet-lab", {"report", folder.string()}).exit, 0);
    manifest = Json::parse(text_of((folder / "manifest.json").string()));
    EXPECT_EQ(manifest["results"].size(), 2U) << "it does not name itself";
    EXPECT_EQ(manifest["valid"], false);
    EXPECT_EQ(manifest["invalid_because"][0], "qos is not valid");

    write_file(folder / "manifest.json", part("2026-11-25T11:00:00Z", true));
    ASSERT_EQ(run("hapnet-lab", {"report", folder.string() + "/"}).exit, 0);
    EXPECT_EQ(text_of((folder / "manifest.json").string()), part("2026-11-25T11:00:00Z", true))
        << "that of a run stays";
}

/// The record of a peer that moved the cube to x and took part for a second.
void write_record(const fs::path& path, int peer_id, double x_m)
{
    fs::create_directories(path.parent_path());
    record::Writer writer{
        path.string(),
        {{"peer_id", peer_id}, {"boot_id", "one boot"}, {"tick_ns", 1'000'000}, {"task", "T3"}}};
    const base::TimePoint start{std::chrono::seconds{5}};
    writer.write(
        record::SessionRow{.start = start, .length = std::chrono::seconds{1}, .session = 1});
    for (int tick = 0; tick < 1000; ++tick) {
        record::TickRow row;
        row.due = start + tick * std::chrono::milliseconds{1};
        row.phase = record::Phase::running;
        row.cube = {{x_m, 0.0, 0.0}};
        writer.write(row);
    }
    writer.flush();
}

TEST(LabReport, MakesAPageOfAnybodysTwoRecordsBesideTheFirst)
{
    const TemporaryFolder temporary;
    const fs::path folder = temporary.file("session");
    write_record(folder / "a.rec", 1, 0.010);
    write_record(folder / "b.rec", 2, 0.035);
    const auto a = (folder / "a.rec").string(), b = (folder / "b.rec").string();
    const auto outcome = run("hapnet-lab", {"report", a, b});
    EXPECT_EQ(outcome.exit, 0) << outcome.err;
    EXPECT_EQ(outcome.out, (folder / "report.html").string() + "\n");
    const auto page = text_of((folder / "report.html").string());
    EXPECT_EQ(test::data_of(page).at("sections")[0].at("id"), "sessions");
    EXPECT_NE(page.find("25.00 mm on average while both hands were on"), std::string::npos);
    EXPECT_TRUE(
        text_of((folder / "figures/session-T3-apart.csv").string())
            .starts_with("curve,time_from_the_start_s,x_a_x_b_mm\n\"|x_A − x_B|\",0.0,25.0\n"));
    EXPECT_EQ(run("hapnet-lab", {"report", folder.string()}).exit, 0);
    EXPECT_EQ(text_of((folder / "report.html").string()), page)
        << "the folder that holds the two records gives the same page";
}

TEST(LabReport, SaysThatItReplacesAPageAboutSomethingElse)
{
    const TemporaryFolder temporary;
    const fs::path folder = temporary.file("mixed");
    write_file(folder / "results.json", table1);
    EXPECT_EQ(run("hapnet-lab", {"report", folder.string()}).err, "");
    EXPECT_EQ(run("hapnet-lab", {"report", folder.string()}).err, "") << "the same page again";
    write_record(folder / "a.rec", 1, 0.010);
    write_record(folder / "b.rec", 2, 0.035);
    const auto a = (folder / "a.rec").string(), b = (folder / "b.rec").string();
    const auto outcome = run("hapnet-lab", {"report", a, b});
    EXPECT_NE(outcome.err.find("it was a page about experiments, not session"), std::string::npos)
        << outcome.err;
}

TEST(LabReport, ShowsEveryTwoOfThreePeersNamedOrInAFolder)
{
    const TemporaryFolder temporary;
    const fs::path folder = temporary.file("three");
    std::vector<std::string> words{"report"};
    for (const int id : {1, 2, 3}) {
        const fs::path path = folder / (std::to_string(id) + ".rec");
        write_record(path, id, 0.001 * id);
        words.push_back(path.string());
    }
    const auto named = run("hapnet-lab", words);
    EXPECT_EQ(named.exit, 0) << named.err;
    const auto page = text_of((folder / "report.html").string());
    for (const char* pair : {R"("peers":[1,2])", R"("peers":[1,3])", R"("peers":[2,3])"})
        EXPECT_NE(page.find(pair), std::string::npos) << pair;
    const auto found = run("hapnet-lab", {"report", folder.string()});
    EXPECT_EQ(found.exit, 0) << found.err;
    EXPECT_NE(text_of((folder / "report.html").string()).find(R"("peers":[2,3])"),
              std::string::npos);
}

TEST(LabReport, RefusesOneRecordAloneAndTwoThatDoNotBelongTogether)
{
    const TemporaryFolder temporary;
    const fs::path folder = temporary.file("wrong");
    write_record(folder / "a.rec", 1, 0.0);
    write_record(folder / "again.rec", 1, 0.0);
    const auto a = (folder / "a.rec").string(), again = (folder / "again.rec").string();
    const auto alone = run("hapnet-lab", {"report", a});
    EXPECT_EQ(alone.exit, 2);
    EXPECT_NE(alone.err.find("name those of both peers"), std::string::npos) << alone.err;
    fs::create_directories(folder / "one");
    fs::copy_file(a, folder / "one" / "a.rec");
    const auto one = run("hapnet-lab", {"report", (folder / "one").string()});
    EXPECT_EQ(one.exit, 2);
    EXPECT_NE(one.err.find("one has 1 record (a.rec): name those of one session"),
              std::string::npos)
        << one.err;
    const auto twice = run("hapnet-lab", {"report", a, again});
    EXPECT_EQ(twice.exit, 2);
    EXPECT_NE(twice.err.find("both records were written by peer 1"), std::string::npos)
        << twice.err;
    EXPECT_FALSE(fs::exists(folder / "report.html"));
}

TEST(LabReport, RefusesWhatIsNoResultWithItsFile)
{
    const TemporaryFolder temporary;
    const fs::path folder = temporary.file("results");
    fs::create_directories(folder);
    const auto refusal = [&] {
        const auto outcome = run("hapnet-lab", {"report", folder.string()});
        EXPECT_EQ(outcome.exit, 2) << outcome.err;
        EXPECT_FALSE(fs::exists(folder / "report.html"));
        return outcome.err;
    };
    EXPECT_NE(refusal().find("holds no results: expected manifest.json"), std::string::npos);
    auto short_row = Json::parse(table1);
    short_row["tables"]["table1"]["rows"][0].erase(10);
    write_file(folder / "results.json", short_row.dump());
    const auto broken = refusal();
    EXPECT_NE(broken.find("results.json: not what this version of hapnet-lab writes: a row of "
                          "'table1' has not a cell for each column"),
              std::string::npos)
        << broken;
    const auto none = run("hapnet-lab", {"report", temporary.file("none")});
    EXPECT_EQ(none.exit, 2);
    EXPECT_NE(none.err.find("none does not exist: name a folder"), std::string::npos) << none.err;
}

TEST(LabReport, AsksToRunAgainWhatAnOlderVersionWrote)
{
    const TemporaryFolder temporary;
    const fs::path all = temporary.file("all"), old = all / "table1";
    write_file(old / "table1.csv", "algorithm,mean_mm\nbase,13.611\n");
    write_file(old / "sessions.csv", "algorithm,task,seed\nbase,P1,1\n");
    const auto expect_refusal = [&](const std::vector<std::string>& words, const char* csv,
                                    const char* json) {
        const auto outcome = run("hapnet-lab", words);
        EXPECT_EQ(outcome.exit, 2) << outcome.err;
        const auto why = old.string() + " has " + csv + " and no " + json +
                         ", as an older version of hapnet-lab wrote it: run it again: its sessions "
                         "are reused";
        EXPECT_NE(outcome.err.find(why), std::string::npos) << outcome.err;
    };
    expect_refusal({"report", old.string()}, "table1.csv", "results.json");
    expect_refusal({"report", all.string()}, "table1.csv", "results.json");
    expect_refusal({"compare", old.string(), old.string()}, "sessions.csv", "sessions.json");
    EXPECT_FALSE(fs::exists(old / "report.html"));
}

} // namespace

} // namespace hapnet::e2e
