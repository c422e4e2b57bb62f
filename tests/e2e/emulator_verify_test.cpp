// SPDX-FileCopyrightText: 2026 The Hapnet authors
// SPDX-License-Identifier: MIT
// The results and exit codes of hapnet-emulator verify.
#include "tests/e2e/process.hpp"

#include <fstream>
#include <gtest/gtest.h>
#include <iterator>
#include <nlohmann/json.hpp>
#include <string>

namespace hapnet::e2e {

namespace {

/// Writes a folder with four fates. The pattern lost the datagrams whose digit in `lost` is 1.
void write_run(const TemporaryFolder& folder, const std::string& lost)
{
    std::ofstream{folder.file("profile.toml")}
        << "name = \"every other\"\n[up]\nloss = { law = \"pattern\", pattern = \"01\" }\n";
    std::ofstream fates{folder.file("fates.csv")};
    fates << "direction,number,verdict,cause,states,delay_ns,copy_after_ns,flipped_bits,"
             "displaced_places,displaced_ns\n";
    for (std::size_t i = 0; i < lost.size(); ++i) {
        fates << "up," << i
              << (lost[i] == '1' ? ",drop,pattern_loss,,,,,,\n" : ",deliver,,,0,,,,\n");
    }
}

Outcome verify(const TemporaryFolder& folder, const std::vector<std::string>& options = {})
{
    std::vector<std::string> words{"verify", folder.file(".")};
    words.insert(words.end(), options.begin(), options.end());
    return run("hapnet-emulator", words);
}

} // namespace

TEST(EmulatorVerify, PassesARunThatKeptItsProfile)
{
    const TemporaryFolder folder;
    write_run(folder, "0101");
    const auto outcome = verify(folder);
    EXPECT_EQ(outcome.exit, 0) << outcome.err;
    EXPECT_NE(outcome.out.find("verdict  passed"), std::string::npos) << outcome.out;
}

TEST(EmulatorVerify, FailsARunThatDidNotAndSaysSoInJson)
{
    const TemporaryFolder folder;
    write_run(folder, "0111");
    const auto outcome = verify(folder, {"--json", "--seed", "1"});
    EXPECT_EQ(outcome.exit, 1) << outcome.err;
    const auto json = nlohmann::json::parse(outcome.out);
    EXPECT_FALSE(json.at("passed").get<bool>());
    EXPECT_EQ(json.at("up").at(0).at("test"), "seed");
    EXPECT_EQ(json.at("up").at(0).at("outcome"), "failed");
    EXPECT_EQ(json.at("up").at(1).at("says"), "1 of 4 datagrams deviate, first number 2");
}

TEST(EmulatorVerify, TakesOnlyTheFatesOfAllDatagramsThatTheStatisticsCount)
{
    const TemporaryFolder folder;
    write_run(folder, "0101");
    const std::string path = folder.file("run.json");
    nlohmann::json statistics{{"fates", folder.file("fates.csv")},
                              {"profile", "up.loss = { law = \"pattern\", pattern = \"01\" }"},
                              {"up", {{"received", 4}}},
                              {"down", {{"received", 0}}}};
    std::ofstream{path} << statistics;
    EXPECT_EQ(run("hapnet-emulator", {"verify", path}).exit, 0);
    const std::string other = folder.file("other.toml");
    std::ofstream{other} << "up.loss = { law = \"pattern\", pattern = \"011\" }\n";
    EXPECT_EQ(run("hapnet-emulator", {"verify", path, "--profile", other}).exit, 1);
    statistics["up"]["received"] = 5;
    std::ofstream{path} << statistics;
    const auto outcome = run("hapnet-emulator", {"verify", path});
    EXPECT_EQ(outcome.exit, 2);
    EXPECT_NE(outcome.err.find("5 datagrams up"), std::string::npos) << outcome.err;
}

TEST(EmulatorVerify, NamesTheFileThatItCannotUse)
{
    const TemporaryFolder folder;
    const auto outcome = verify(folder);
    EXPECT_EQ(outcome.exit, 2);
    EXPECT_NE(outcome.err.find("fates.csv"), std::string::npos) << outcome.err;
}

TEST(EmulatorReport, MakesAPageOfARunWithTheTestsOfItsFates)
{
    const TemporaryFolder folder;
    write_run(folder, "0101");
    const std::string path = folder.file("run.json");
    const std::string page = folder.file("run.html");
    std::ofstream{path} << nlohmann::json{
        {"fates", folder.file("fates.csv")},
        {"profile", "name = \"every other\"\nup.loss = { law = \"pattern\", pattern = \"01\" }"},
        {"valid", true},
        {"up", {{"received", 4}}},
        {"down", {{"received", 0}}}};
    const auto outcome = run("hapnet-emulator", {"report", path, "--out", page});
    EXPECT_EQ(outcome.exit, 0) << outcome.err;
    std::ifstream file{page};
    const std::string html{std::istreambuf_iterator<char>{file}, {}};
    EXPECT_NE(html.find("<title>every other</title>"), std::string::npos);
    EXPECT_NE(html.find("datagrams 1 to 1: 1 of 1 lost"), std::string::npos);
    EXPECT_NE(html.find("All tests of its laws passed"), std::string::npos);
    EXPECT_TRUE(html.ends_with("</html>\n"));
}

TEST(EmulatorReport, NamesTheFileThatItCannotUse)
{
    const TemporaryFolder folder;
    write_run(folder, "0101");
    const std::string page = folder.file("run.html");
    const auto missing = run("hapnet-emulator", {"report", folder.file("no.json"), "--out", page});
    EXPECT_EQ(missing.exit, 2);
    EXPECT_NE(missing.err.find("no.json"), std::string::npos) << missing.err;
    const auto other = run("hapnet-emulator", {"report", folder.file("fates.csv"), "--out", page});
    EXPECT_EQ(other.exit, 2);
    EXPECT_NE(other.err.find("--stats"), std::string::npos) << other.err;
}

TEST(EmulatorReport, NamesTheFileOfStatisticsWithAValueOfAnotherType)
{
    const TemporaryFolder folder;
    const std::string path = folder.file("run.json"), page = folder.file("run.html");
    const nlohmann::json whole{{"profile", ""},
                               {"valid", true},
                               {"duration_s", 1.0},
                               {"up", {{"received", 4}}},
                               {"down", {{"received", 0}}}};
    for (const auto& [key, value] : std::vector<std::pair<const char*, nlohmann::json>>{
             {"valid", "yes"},
             {"up", 5},
             {"down", {{"received", "none"}}},
             {"duration_s", "long"},
             {"changes", {{{"elapsed_s", "late"}}}}}) {
        auto wrong = whole;
        wrong[key] = value;
        std::ofstream{path} << wrong;
        const auto outcome = run("hapnet-emulator", {"report", path, "--out", page});
        EXPECT_EQ(outcome.exit, 2) << key << outcome.err;
        EXPECT_NE(outcome.err.find(path + ": a value has another type"), std::string::npos)
            << key << "\n"
            << outcome.err;
    }
}

} // namespace hapnet::e2e
