// SPDX-FileCopyrightText: 2026 The Hapnet authors
// SPDX-License-Identifier: MIT
#include "lab/experiment/criteria_text.hpp"
#include "lab/metrics/calibration.hpp"
#include "lab/metrics/criteria.hpp"
#include "lab/metrics/verdict.hpp"

#include <gtest/gtest.h>
#include <string>
#include <string_view>
#include <vector>

namespace hapnet::lab {
namespace {

/// Of a press, all of it as on the perfect network.
Scores perfect()
{
    Scores scores{.task = device::Task::t2, .scored_share = 1.0};
    scores.vibration_m = ByOrder{};
    scores.stiffness_ratio = {1.0, 1.0, 1.0};
    scores.force_discrepancy = 0.04;
    scores.force_vibration_added_n = ByOrder{};
    scores.contact_lost = 0.0;
    scores.drag_n = 0.0;
    return scores;
}

Criteria criteria()
{
    Criteria criteria;
    criteria.usable.vibration_max_m = {.first = 1.0e-3, .second = 0.9e-3, .fourth = 0.8e-3};
    criteria.usable.stiffness_ratio_min = 0.11;
    return criteria;
}

TEST(Verdict, OfAPerfectSessionIsGood)
{
    const Judgement judgement = judge(perfect(), criteria());
    EXPECT_EQ(judgement.tier, Tier::good);
    EXPECT_TRUE(judgement.failures.empty());
    EXPECT_TRUE(judgement.shortcomings.empty());
}

TEST(Verdict, SaysInWordsWhatKeepsASessionFromUsable)
{
    Scores scores = perfect();
    scores.vibration_m->first = 1.31e-3;
    scores.stiffness_ratio[judged_press] = 0.0346;
    scores.force_vibration_added_n->first = 0.134;
    scores.scored_share = 0.5;
    const Judgement judgement = judge(scores, criteria());
    EXPECT_EQ(judgement.tier, Tier::unusable);
    EXPECT_EQ(judgement.failures,
              (std::vector<std::string>{"time together 50 % < 95 %", "vibration 1.31 mm > 1 mm",
                                        "stiffness ratio 0.0346 < 0.11",
                                        "force vibration added 0.134 N > 0.1 N"}));
}

TEST(Verdict, IsUsableWhereItIsNotGoodAndSaysWhyNot)
{
    Scores scores = perfect();
    scores.stiffness_ratio[judged_press] = 0.5;
    scores.force_discrepancy = 0.12;
    scores.contact_lost = 0.07;
    scores.drag_n = 0.4;
    const Judgement judgement = judge(scores, criteria());
    EXPECT_EQ(judgement.tier, Tier::usable);
    EXPECT_EQ(
        judgement.shortcomings,
        (std::vector<std::string>{"stiffness ratio 0.5 < 0.77", "force discrepancy 12 % > 10 %",
                                  "contact lost 7 % > 5 %", "drag 0.4 N > 0.3 N"}));
}

TEST(Verdict, KeepsALimitThatIsMetExactly)
{
    Scores scores = perfect();
    scores.vibration_m->first = 1.0e-3;
    scores.stiffness_ratio[judged_press] = 0.11;
    scores.force_vibration_added_n->first = 0.1;
    EXPECT_EQ(judge(scores, criteria()).tier, Tier::usable);
}

TEST(Verdict, JudgesVibrationByTheChosenFilter)
{
    Scores scores = perfect();
    scores.vibration_m = ByOrder{.first = 0.5e-3, .second = 0.95e-3, .fourth = 0.5e-3};
    Criteria chosen = criteria();
    EXPECT_EQ(judge(scores, chosen).tier, Tier::good);
    chosen.filter_order = FilterOrder::second;
    EXPECT_EQ(judge(scores, chosen).failures,
              std::vector<std::string>{"vibration 0.95 mm > 0.9 mm"});
    chosen.filter_order = FilterOrder::fourth;
    EXPECT_EQ(judge(scores, chosen).tier, Tier::good);
}

TEST(Verdict, TakesWhatTheTaskDoesNotExerciseAsKept)
{
    EXPECT_EQ(judge(Scores{.scored_share = 1.0}, criteria()).tier, Tier::good);
    EXPECT_EQ(judge(Scores{}, criteria()).tier, Tier::unusable); // but a session has to take place
}

TEST(Criteria, ReadBackAsTheyWerePrinted)
{
    Criteria unusual;
    unusual.filter_order = FilterOrder::fourth;
    unusual.usable.vibration_max_m = {.first = 1.234e-3, .second = 0.1, .fourth = 3e-7};
    unusual.usable.stiffness_ratio_min = 0.04321;
    unusual.usable.force_vibration_max_n = 0.25;
    unusual.usable.scored_share_min = 0.5;
    unusual.good.stiffness_ratio_min = 0.9;
    unusual.good.force_discrepancy_max = 0.07;
    unusual.good.contact_lost_max = 0.0;
    unusual.good.drag_max_n = 0.001;
    for (const Criteria& printed : {Criteria{}, unusual}) {
        const auto read = parse_criteria(print_criteria(printed), "criteria.toml");
        ASSERT_TRUE(read) << read.error().message;
        EXPECT_EQ(*read, printed);
    }
}

TEST(Criteria, OfThePaperAreWhatIsBuiltIn)
{
    const auto read = load_criteria("paper", {});
    ASSERT_TRUE(read) << read.error().message;
    EXPECT_EQ(*read, Criteria{});
    // Under the line that says which run wrote it.
    const std::string_view text = built_in_criteria().front().text;
    EXPECT_EQ(print_criteria(*read), text.substr(text.find('\n') + 1));
}

TEST(Criteria, HaveTheirDefaultsWhereATextSaysNothing)
{
    EXPECT_EQ(parse_criteria("", "c").value(), Criteria{});
    const auto read = parse_criteria("[usable]\nvibration_max = { first = \"2mm\" }\n", "c");
    ASSERT_TRUE(read) << read.error().message;
    EXPECT_EQ(read->usable.vibration_max_m.first, 0.002);
    EXPECT_EQ(read->usable.vibration_max_m.second, Criteria{}.usable.vibration_max_m.second);
}

std::string complaint(const std::string& text)
{
    const auto read = parse_criteria(text, "c.toml");
    return read ? "none" : read.error().message;
}

TEST(Criteria, AreRefusedWithThePlaceOfWhatIsWrong)
{
    EXPECT_EQ(complaint("filter_order = 3"),
              "c.toml:1:16: expected the filter order 1, 2 or 4, not 3");
    EXPECT_EQ(complaint("[good]\nstiffness_ratio_min = 77\n"),
              "c.toml:2:23: 77 is out of range: use 0 to 1");
    EXPECT_TRUE(complaint("[usable]\nforce_vibration_max = \"-0.1N\"\n")
                    .starts_with("c.toml:2:23: '-0.1N' is too small: use 0"));
    EXPECT_TRUE(complaint("[usable]\nforce_vibration_max = 0.1\n").starts_with("c.toml:2:23: "));
    EXPECT_TRUE(complaint("[usable]\nvibration = \"1mm\"\n").starts_with("c.toml:2:1: "));
    EXPECT_TRUE(complaint("usable = 1\n").starts_with("c.toml:1:10: "));
    EXPECT_TRUE(complaint("[usable\n").starts_with("c.toml:1:"));
}

TEST(Calibration, LetsTheWorstSessionJustPass)
{
    std::vector<Scores> delayed{perfect(), perfect(), perfect()};
    delayed[0].stiffness_ratio[judged_press] = 0.0611;
    delayed[1].stiffness_ratio[judged_press] = 0.0524;
    delayed[2].stiffness_ratio[judged_press].reset(); // another task
    std::vector<Scores> lossy{perfect(), perfect()};
    lossy[0].vibration_m = ByOrder{.first = 1.034e-3, .second = 0.9e-3, .fourth = 0.5e-3};
    lossy[1].vibration_m = ByOrder{.first = 0.9e-3, .second = 1.001e-3, .fourth = 0.8e-3};
    const auto found = calibrated({.at_delay = delayed, .at_random_loss = lossy}, {});
    ASSERT_TRUE(found) << found.error().message;
    EXPECT_DOUBLE_EQ(found->usable.vibration_max_m.first, 1.04e-3);
    EXPECT_DOUBLE_EQ(found->usable.vibration_max_m.second, 1.01e-3);
    EXPECT_DOUBLE_EQ(found->usable.vibration_max_m.fourth, 0.8e-3);
    EXPECT_DOUBLE_EQ(found->usable.stiffness_ratio_min, 0.052);
    EXPECT_EQ(found->usable.force_vibration_max_n, Criteria{}.usable.force_vibration_max_n);
    for (const Scores& scores : lossy) EXPECT_TRUE(judge(scores, *found).failures.empty());
    for (const Scores& scores : delayed) EXPECT_TRUE(judge(scores, *found).failures.empty());
}

TEST(Calibration, DoesNotHideThatSomethingElseFailsFirst)
{
    std::vector<Scores> lossy{perfect()};
    lossy[0].force_vibration_added_n->first = 0.2;
    const std::vector<Scores> delayed{perfect()};
    const auto found = calibrated({.at_delay = delayed, .at_random_loss = lossy}, {});
    ASSERT_FALSE(found);
    EXPECT_EQ(found.error().message, "a session to calibrate on is not usable in any case: T2: "
                                     "force vibration added 0.2 N > 0.1 N");
}

TEST(Calibration, NeedsSessionsThatTellTheNumbers)
{
    const std::vector<Scores> told{perfect()};
    const std::vector<Scores> silent{Scores{.scored_share = 1.0}};
    EXPECT_FALSE(calibrated({.at_delay = told, .at_random_loss = silent}, {}));
    EXPECT_FALSE(calibrated({.at_delay = silent, .at_random_loss = told}, {}));
    EXPECT_FALSE(calibrated({}, {}));
    std::vector<Scores> limp{perfect()};
    limp[0].stiffness_ratio[judged_press] = -0.02;
    EXPECT_FALSE(calibrated({.at_delay = limp, .at_random_loss = told}, {}));
}

} // namespace
} // namespace hapnet::lab
