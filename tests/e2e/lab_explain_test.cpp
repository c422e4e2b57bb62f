// SPDX-FileCopyrightText: 2026 The Hapnet authors
// SPDX-License-Identifier: MIT
// The output of hapnet-lab explain about scenes, and about files that are no scenes.
#include "tests/e2e/process.hpp"

#include <fstream>
#include <gtest/gtest.h>
#include <nlohmann/json.hpp>
#include <string>
#include <vector>

namespace hapnet::e2e {

namespace {

Outcome explain(std::vector<std::string> words)
{
    words.insert(words.begin(), "explain");
    return run("hapnet-lab", words);
}

} // namespace

TEST(LabExplain, PrintsHelpWithEveryOptionAndTheBuiltInScenes)
{
    const auto outcome = explain({"--help"});
    EXPECT_EQ(outcome.exit, 0);
    for (const char* word : {"SCENE", "--tick", "--no-sleeping", "--json", "paper", "rolling",
                             "stack-of-three", "mass-ratio-1000", "Exit codes"}) {
        EXPECT_NE(outcome.out.find(word), std::string::npos) << word;
    }
}

TEST(LabExplain, ExplainsABuiltInSceneAndAFile)
{
    const auto paper = explain({"paper"});
    EXPECT_EQ(paper.exit, 0) << paper.err;
    EXPECT_NE(paper.out.find("Its stepper: sliding\n"), std::string::npos) << paper.out;
    const TemporaryFolder folder;
    const auto file = folder.file("mine.toml");
    std::ofstream{file} << "hips.count = 0\n[[body]]\nsize = \"40mm\"\nmass = \"1kg\"\n";
    const auto mine = explain({file, "--json", "--tick", "4ms", "--no-sleeping"});
    EXPECT_EQ(mine.exit, 0) << mine.err;
    const auto json = nlohmann::json::parse(mine.out);
    EXPECT_EQ(json["profile"], "flight");
    EXPECT_EQ(json["tick_s"], 0.004);
}

TEST(LabExplain, NamesFileLineAndCureOfABadScene)
{
    const TemporaryFolder folder;
    const auto file = folder.file("bad.toml");
    std::ofstream{file} << "[[body]]\nmass = \"1kg\"\nsize = \"40\"\n";
    expect_refusal(explain({file}), 2, {file + ":3:8: ", "'40' has no unit", "40mm"});
    expect_refusal(explain({"papr"}), 2, {"'papr'", "did you mean 'paper'?"});
    expect_refusal(explain({folder.file("none.toml")}), 2, {"none.toml", "No such file"});
    expect_refusal(explain({"paper", "--tick", "1"}), 2, {"--tick", "'1'", "write 1ms"});
    expect_refusal(explain({"paper", "--tick", "1s"}), 2, {"--tick", "'1s'", "100ms"});
    expect_refusal(explain({}), 2, {"SCENE"});
}

} // namespace hapnet::e2e
