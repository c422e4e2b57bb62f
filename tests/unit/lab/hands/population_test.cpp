// SPDX-FileCopyrightText: 2026 The Hapnet authors
// SPDX-License-Identifier: MIT
#include "lab/hands/population.hpp"

#include "lab/hands/manifest.hpp"

#include <gtest/gtest.h>
#include <map>

namespace hapnet::lab::hands {
namespace {

ImportedTrial trial_of(const std::string& subject, const std::string& name, bool has_b = true)
{
    ImportedTrial trial;
    trial.subject = subject;
    trial.trial = name;
    trial.a.script = subject + "-" + name + "-a.csv";
    if (has_b) trial.b.emplace().script = subject + "-" + name + "-b.csv";
    return trial;
}

std::string refusal(const Manifest& manifest)
{
    const auto read = parse_manifest(to_text(manifest), "m.json");
    return read ? "" : read.error().message;
}

TEST(HandsManifest, ReadsBackAsTheSame)
{
    Manifest manifest;
    ImportedTrial trial = trial_of("01", "a");
    trial.scale = 0.25;
    trial.a.gaps = 3;
    put(manifest, trial);
    put(manifest, trial_of("01", "b", false));
    const auto read = parse_manifest(to_text(manifest), "m.json").value();
    EXPECT_EQ(to_text(read), to_text(manifest));
    EXPECT_EQ(read.trials[0].a.gaps, 3U);
    EXPECT_FALSE(read.trials[1].b);
}

TEST(HandsManifest, HasATrialOfASubjectOnce)
{
    Manifest manifest;
    put(manifest, trial_of("01", "a"));
    put(manifest, trial_of("02", "a"));
    ImportedTrial again = trial_of("01", "a");
    again.scale = 0.5;
    put(manifest, again);
    ASSERT_EQ(manifest.trials.size(), 2U);
    EXPECT_EQ(manifest.trials[0].scale, 0.5);
    manifest.trials.push_back(again);
    EXPECT_EQ(refusal(manifest), "m.json: trial a of subject 01 is there twice");
}

TEST(HandsManifest, NamesFilesOfItsFolderAlone)
{
    for (const char* wrong : {"../a.csv", "/etc/passwd", "a.txt", ".csv", "a/b.csv"}) {
        Manifest manifest;
        manifest.trials.push_back(trial_of("01", "a"));
        manifest.trials[0].a.script = wrong;
        EXPECT_EQ(refusal(manifest), "m.json: a script of subject 01 is not a file of this folder");
    }
    EXPECT_EQ(refusal({}), "m.json: there are no trials");
    EXPECT_EQ(parse_manifest("{\"kind\":\"table1\"}", "m.json").error().message,
              "m.json: not the manifest of recorded hands, which hapnet-lab import hands writes");
}

TEST(Population, HasTheWaysOfEveryTrial)
{
    Manifest manifest;
    put(manifest, trial_of("01", "a"));
    put(manifest, trial_of("01", "b", false));
    put(manifest, trial_of("02", "a"));
    std::map<std::string, std::string> files{{"in/people/manifest.json", to_text(manifest)}};
    for (const char* name : {"01-a-a", "01-a-b", "01-b-a", "02-a-a", "02-a-b"}) {
        files[std::string{"in/people/"} + name + ".csv"] =
            "time_s,x_m,y_m,z_m\n0,0,0,0\n2.5,0.01,0,0\n";
    }
    const base::Reading reading{"", [&](const std::string& name) -> base::Result<std::string> {
                                    const auto found = files.find(name);
                                    return found == files.end()
                                               ? base::Result<std::string>{base::fail("no " + name)}
                                               : found->second;
                                }};
    const auto people = read_population("in/people/", reading).value();
    EXPECT_EQ(people.name(), "people");
    EXPECT_EQ(people.subjects(), 2U);
    ASSERT_EQ(people.trials.size(), 3U);
    EXPECT_EQ(people.trials[0].end_s(), 2.5);
    EXPECT_TRUE(people.trials[0].ways[1]);
    EXPECT_FALSE(people.trials[1].ways[1]);
    files.erase("in/people/02-a-b.csv");
    EXPECT_EQ(read_population("in/people", reading).error().message, "no in/people/02-a-b.csv");
}

} // namespace
} // namespace hapnet::lab::hands
