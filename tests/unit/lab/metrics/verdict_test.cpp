// SPDX-FileCopyrightText: 2026 The Hapnet authors
// SPDX-License-Identifier: MIT
#include "lab/metrics/verdict.hpp"
#include "proto/base/quantity.hpp"
#include "tests/unit/lab/metrics/made_scores.hpp"

#include <gtest/gtest.h>
#include <string>

namespace hapnet::lab::metrics {
namespace {

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
    scores.slow_stiffness_error = 0.96;
    scores.stiffness_error = 1.2;
    scores.discrepancy_m = Spread{.mean = 0.14, .min = 0.0, .max = 0.2, .std = 0.0};
    scores.force_vibration_added_n->first = 0.134;
    scores.scored_share = 0.5;
    const Judgement judgement = judge(scores, criteria());
    EXPECT_EQ(judgement.tier, Tier::unusable);
    EXPECT_EQ(judgement.failures,
              (std::vector<std::string>{"time together 50 % < 95 %", "vibration 1.31 mm > 1 mm",
                                        "stiffness error at 0.5 Hz 96 % > 90 %",
                                        "force vibration added 0.134 N > 0.1 N",
                                        "copies apart 140 mm > 13.8 mm"}));
    EXPECT_EQ(judgement.failed, (std::vector<std::string_view>{
                                    "time together", "vibration", "stiffness error at 0.5 Hz",
                                    "force vibration added", "copies apart"}));
}

TEST(Verdict, IsUsableWhereItIsNotGoodAndSaysWhyNot)
{
    Scores scores = perfect();
    scores.stiffness_error = 0.5;
    scores.force_discrepancy = 0.12;
    scores.contact_lost = 0.07;
    scores.drag_n = 0.4;
    const Judgement judgement = judge(scores, criteria());
    EXPECT_EQ(judgement.tier, Tier::usable);
    EXPECT_EQ(
        judgement.shortcomings,
        (std::vector<std::string>{"stiffness error 50 % > 23 %", "force discrepancy 12 % > 10 %",
                                  "contact lost 7 % > 5 %", "drag 0.4 N > 0.3 N"}));
}

TEST(Verdict, JudgesHowFarCopiesAreApart)
{
    Scores scores = perfect();
    const auto tier_at = [&](double mean_m) {
        scores.discrepancy_m = Spread{.mean = mean_m, .min = 0.0, .max = 0.2, .std = 0.0};
        return judge(scores, Criteria{}).tier;
    };
    EXPECT_EQ(tier_at(0.005), Tier::good);
    EXPECT_EQ(tier_at(0.0051), Tier::usable);
    EXPECT_EQ(tier_at(0.0138), Tier::usable);
    EXPECT_EQ(tier_at(0.0139), Tier::unusable);
}

TEST(Verdict, JudgesHowFarCopiesAreTurnedApartOnlyWhereATextSaysSo)
{
    Scores scores = perfect();
    scores.discrepancy_m = Spread{.mean = 0.004, .min = 0.0, .max = 0.05, .std = 0.0};
    scores.turned_apart_rad = Spread{.mean = 0.35, .min = 0.0, .max = 1.0, .std = 0.0};
    EXPECT_EQ(judge(scores, criteria()).tier, Tier::good);
    Criteria strict = criteria();
    strict.good.turned_apart_max_rad = 0.35; // met exactly
    strict.good.discrepancy_max_m = 0.003;
    EXPECT_EQ(judge(scores, strict).shortcomings,
              std::vector<std::string>{"copies apart 4 mm > 3 mm"});
    strict.usable.turned_apart_max_rad = 10.0 * base::radians_per_degree;
    EXPECT_EQ(judge(scores, strict).failures,
              std::vector<std::string>{"copies turned apart 20.1 deg > 10 deg"});
}

TEST(Verdict, KeepsALimitThatIsMetExactly)
{
    Scores scores = perfect();
    scores.vibration_m->first = 1.0e-3;
    scores.slow_stiffness_error = scores.stiffness_error = 0.9;
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
    EXPECT_EQ(judge(Scores{}, criteria()).tier, Tier::unusable); // except that a session must exist
}

} // namespace
} // namespace hapnet::lab::metrics
