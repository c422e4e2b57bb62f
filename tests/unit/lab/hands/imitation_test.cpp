// SPDX-FileCopyrightText: 2026 The Hapnet authors
// SPDX-License-Identifier: MIT
#include "lab/hands/imitation.hpp"

#include <cmath>
#include <gtest/gtest.h>
#include <map>
#include <spdlog/fmt/fmt.h>

namespace hapnet::lab::hands {
namespace {

/// Recorded hands as the import keeps them, made from models.
class People {
public:
    void add(const std::string& subject, const std::string& name, bool has_b = true)
    {
        ImportedTrial trial;
        trial.subject = subject;
        trial.trial = name;
        trial.smooth_hz = 6.0;
        trial.press_mm = 4.0;
        trial.speed_limit_mm_s = 1000.0;
        if (has_b) trial.b.emplace();
        MotionModel model;
        model.target_x_mm = 8.0;
        std::vector<Motion> motions;
        for (std::uint64_t hand = 0; hand < (has_b ? 2U : 1U); ++hand) {
            motions.push_back(simulated(model, 1201, motion_rate_hz, base::Seed{++seed_}));
            for (glm::dvec3& place : motions.back()) place.x += hand == 0 ? -1.0 : 1.0;
        }
        auto imported = fitted_trial(trial, motions, {}).value();
        for (const TextFile& file : imported.scripts) files_[file.name] = file.text;
        put(manifest, std::move(imported.trial));
    }

    [[nodiscard]] base::Result<Imitated> imitated(const ImitationRules& rules) const
    {
        auto files = files_;
        files["people/manifest.json"] = to_text(manifest);
        const base::Reading reading{"people", [&](const std::string& name) {
                                        const auto file = files.find(
                                            name == "people/manifest.json" ? name : name.substr(7));
                                        return file == files.end()
                                                   ? base::Result<std::string>{base::fail(name)}
                                                   : base::Result<std::string>{file->second};
                                    }};
        return imitate(manifest, read_population("people", reading).value(), rules);
    }
    [[nodiscard]] std::string refusal(const ImitationRules& rules) const
    {
        const auto result = imitated(rules);
        return result ? "" : result.error().message;
    }

    /// Keeps the header and so many rows of a script, each `step`-th one.
    void keep_rows(const std::string& script, std::size_t rows, std::size_t step = 1)
    {
        std::string& text = files_.at(script);
        std::string kept;
        std::size_t line = 0;
        for (std::size_t from = 0; from < text.size() && line <= rows * step; ++line) {
            const auto end = text.find('\n', from) + 1;
            if (line == 0 || (line - 1) % step == 0) kept += text.substr(from, end - from);
            from = end;
        }
        text = kept;
    }

    Manifest manifest;

private:
    std::map<std::string, std::string> files_;
    std::uint64_t seed_ = 0;
};

/// Two subjects, four trials of one and one of the other, and their fit: made once, as it takes
/// long.
const Imitated& imitation()
{
    static const Imitated made = [] {
        People people;
        for (const char* trial : {"a", "b", "c", "d"}) people.add("01", trial);
        ImitationRules rules;
        rules.trials = 10;
        return people.imitated(rules).value();
    }();
    return made;
}

TEST(Imitation, KeepsEachSecondTrialOfASubjectFromTheFit)
{
    const Imitated& made = imitation();
    ASSERT_EQ(made.unseen.trials.size(), 2U);
    EXPECT_EQ(made.unseen.trials[0].trial, "b");
    EXPECT_EQ(made.unseen.trials[1].trial, "d");
    EXPECT_EQ(made.seen.trials.size(), 2U);
    EXPECT_EQ(made.imitation.subjects.size(), 1U);
    EXPECT_EQ(made.simulated.trials.size(), 10U);
    EXPECT_EQ(made.scripts.size(), 20U);
    EXPECT_TRUE(parse_manifest(to_text(made.simulated), "m.json"));
    EXPECT_EQ(made.simulated.trials[0].a.source, "fit.json");
    EXPECT_NE(made.simulated.trials[0].a.script, made.simulated.trials[1].a.script);
}

TEST(Imitation, ComparesEveryFigureOfTheThreeKinds)
{
    const Imitated& made = imitation();
    ASSERT_EQ(made.imitation.figures.size(), 19U);
    EXPECT_EQ(made.imitation.figures.front().figure, "spread_x_mm");
    EXPECT_EQ(made.imitation.figures.back().motion, "both");
    for (const ComparedFigure& row : made.imitation.figures) {
        EXPECT_GE(row.unseen, row.unseen_min) << row.figure;
        EXPECT_LE(row.unseen, row.unseen_max) << row.figure;
        if (row.motion == "both") continue;
        // The people are drawn from the model that is fitted.
        EXPECT_NEAR(row.simulated, row.seen, 0.5 * row.seen + 0.05) << row.motion << row.figure;
    }
    const std::string text = told(made.imitation);
    EXPECT_NE(text.find("fitted to 2 trials of 1 subject; judged by 2 others"), std::string::npos)
        << text;
}

TEST(Imitation, KeepsItsSizeInTheScene)
{
    std::size_t scaled = 0;
    for (const ImportedTrial& trial : imitation().simulated.trials)
        scaled += trial.scale < 1.0 ? 1U : 0U;
    EXPECT_LE(scaled, 2U);
}

TEST(Imitation, OfASingleHandIsTheSameForTheSameSeed)
{
    People people;
    for (const char* trial : {"a", "b"}) people.add("01", trial, false);
    ImitationRules rules;
    rules.trials = 2;
    const auto once = people.imitated(rules).value();
    EXPECT_FALSE(once.imitation.subjects[0].apart);
    EXPECT_FALSE(once.simulated.trials[0].b);
    EXPECT_EQ(once.imitation.figures.size(), 10U);
    const auto again = people.imitated(rules).value();
    EXPECT_EQ(to_text(once.imitation), to_text(again.imitation));
    EXPECT_EQ(once.scripts[0].text, again.scripts[0].text);
    rules.seed = 2;
    EXPECT_NE(people.imitated(rules).value().scripts[0].text, once.scripts[0].text);
}

TEST(Imitation, SaysWhyNothingCanBeFittedOrJudged)
{
    People people;
    people.add("01", "a");
    people.add("02", "a");
    EXPECT_EQ(people.refusal({}),
              "no trial is left to judge the fitted hands by: every subject has a single one; "
              "import more, or keep subjects back by --unseen NAME");
    EXPECT_EQ(people.refusal({.unseen = parse_unseen("01,02").value()}),
              "no trial is left to fit a hand to: name fewer subjects for --unseen");
    EXPECT_EQ(people.refusal({.unseen = parse_unseen("03").value()}),
              "--unseen 03: the folder has no such subject: its subjects are 01, 02");
    EXPECT_EQ(people.refusal({.unseen = parse_unseen("02").value()}), "");
    people.add("01", "b", false);
    people.add("01", "c");
    people.add("01", "d");
    EXPECT_EQ(people.refusal({.unseen = parse_unseen("02").value()}),
              "trial b of subject 01: some trials are of one hand and some of two: import them "
              "into two folders");
}

TEST(Imitation, RefusesWhatNoImportWrites)
{
    const auto refusal_of = [](const auto& change) {
        People people;
        for (const char* trial : {"a", "b"}) people.add("01", trial);
        change(people);
        return people.refusal({});
    };
    EXPECT_EQ(refusal_of([](People& people) { people.manifest.trials[1].smooth_hz = 0.0; }),
              "trial b of subject 01: smooth_hz, speed_limit_mm_s, press_mm or touching_share is "
              "out of the range of import hands");
    EXPECT_EQ(refusal_of([](People& people) { people.keep_rows("01-a-b.csv", 1100); }),
              "trial a of subject 01: its two scripts are not equally long");
    EXPECT_EQ(refusal_of([](People& people) { people.keep_rows("01-a-a.csv", 12); }),
              "trial a of subject 01: its script lasts 0.011 s, less than 1 s");
    EXPECT_EQ(refusal_of([](People& people) { people.keep_rows("01-a-a.csv", 600, 2); }),
              "trial a of subject 01: its script does not have a row for each millisecond");
}

TEST(Unseen, IsHalfOrNamesOfSubjects)
{
    EXPECT_TRUE(parse_unseen("half").value().subjects.empty());
    EXPECT_EQ(parse_unseen("01, b-2").value().subjects, (std::vector<std::string>{"01", "b-2"}));
    EXPECT_EQ(parse_unseen("../a").error().message,
              "'../a' names no subject: write half, or names of subjects with commas between them");
    EXPECT_FALSE(parse_unseen(""));
    EXPECT_FALSE(parse_unseen("a,,b"));
}

} // namespace
} // namespace hapnet::lab::hands
