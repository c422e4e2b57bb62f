// SPDX-FileCopyrightText: 2026 The Hapnet authors
// SPDX-License-Identifier: MIT
#include "emulator/tools/learn/losses.hpp"

#include "emulator/core/pipeline.hpp"
#include "emulator/tools/learn/four_state_fit.hpp"
#include "emulator/tools/learn/learn.hpp"
#include "tests/support/seeds.hpp"

#include <chrono>
#include <cmath>
#include <gtest/gtest.h>
#include <vector>

namespace hapnet::emulator::tools {
namespace {

using namespace std::chrono_literals;
using namespace base::literals; // NOLINT(google-build-using-namespace): literals only

std::vector<bool> drawn(const LossLaw& law, std::uint64_t count, std::uint64_t seed = 42)
{
    Pipeline pipeline{{.loss = {law}}, base::Seed{seed}, Direction::down};
    std::vector<bool> lost;
    for (std::uint64_t number = 0; number < count; ++number) {
        lost.push_back(pipeline.on_packet({number, 96, 1ms * number}).drop.has_value());
    }
    return lost;
}

// Bursts of 20 datagrams on average, with 60 % of them lost and arrivals within them in runs of 3,
// and isolated losses outside.
const FourState salsano{.share = 4_percent,
                        .burst = 20.0,
                        .density = 60_percent,
                        .isolated = 1_percent,
                        .good_run = 3.0};

TEST(LearnFourStates, FindsItsParametersWithinTheirErrors)
{
    constexpr std::uint64_t count = 300'000;
    for (std::uint64_t seed = 1; seed <= test::seeds(3); ++seed) {
        const auto models = fit_losses(drawn(salsano, count, seed));
        const auto* law = std::get_if<FourState>(&models.front().law);
        ASSERT_NE(law, nullptr) << models.front().name;
        // Some 750 bursts: the relative error of their mean length, and of the share within them,
        // is about 1 / sqrt(750) = 3.7 %; of the 2900 losses alone 2 %; of 2000 good runs 2 %.
        EXPECT_NEAR(law->share.fraction(), 0.04, 4 * 0.04 * 0.045) << seed;
        EXPECT_NEAR(law->burst, 20.0, 4 * 20.0 * 0.045) << seed;
        EXPECT_NEAR(law->density.fraction(), 0.60, 0.04) << seed;
        EXPECT_NEAR(law->isolated.fraction(), 0.01, 4 * 0.01 * 0.025) << seed;
        EXPECT_NEAR(law->good_run, 3.0, 0.35) << seed;
        EXPECT_GE(models.front().losses_p_value.value_or(0.0), 1e-3) << seed;
        EXPECT_GE(models.front().arrivals_p_value.value_or(0.0), 1e-3) << seed;
    }
}

TEST(LearnFourStates, RejectsTheModelsWithFewerStates)
{
    const auto models = fit_losses(drawn(salsano, 300'000));
    ASSERT_EQ(models.size(), 4U);
    for (std::size_t i = 1; i < models.size(); ++i) {
        EXPECT_GT(models[i].bic, models.front().bic + 100.0) << models[i].name;
        const bool is_rejected = models[i].losses_p_value.value_or(1.0) < 1e-3 ||
                                 models[i].arrivals_p_value.value_or(1.0) < 1e-3;
        EXPECT_TRUE(is_rejected) << models[i].name;
    }
}

TEST(LearnFourStates, IsNotTakenForWhatFewerStatesDescribe)
{
    for (const LossLaw& law :
         {LossLaw{RandomLoss{3_percent}}, LossLaw{Gilbert{5_percent, 4.0}},
          LossLaw{GilbertElliott{1_percent, 5_percent, 1_percent, 60_percent}}}) {
        EXPECT_NE(fit_losses(drawn(law, 50'000)).front().name, "four-state") << name_of(law);
    }
}

TEST(LearnFourStates, ItsLawHasTheStepsThatWereFound)
{
    const FourStateSteps steps{0.001, 0.01, 0.07, 0.21, 0.5};
    const auto again = law_of(steps).steps();
    EXPECT_NEAR(again.gap_to_burst, steps.gap_to_burst, 1e-5);
    EXPECT_NEAR(again.gap_to_isolated, steps.gap_to_isolated, 1e-5);
    EXPECT_NEAR(again.burst_to_gap, steps.burst_to_gap, 1e-5);
    EXPECT_NEAR(again.burst_to_good_run, steps.burst_to_good_run, 1e-5);
    EXPECT_NEAR(again.good_run_to_burst, steps.good_run_to_burst, 1e-5);
}

TEST(LossRuns, OfAChainAreAsLongAsThoseThatItDraws)
{
    const auto lost = drawn(salsano, 400'000);
    const auto chain = chain_of(salsano.steps());
    const auto runs = runs_of(lost);
    for (const bool of_losses : {true, false}) {
        const auto at_least = run_lengths(chain, of_losses, 6);
        for (std::size_t length = 1; length <= 6; ++length) {
            double count = 0.0;
            double longer = 0.0;
            for (const LossRun& run : runs) {
                if (run.is_lost != of_losses) continue;
                count += 1.0;
                if (run.length >= length) longer += 1.0;
            }
            const double share = at_least[length - 1];
            // Runs come in clusters, a geometric number of them, 3.7 on average: of such counts the
            // variance is at most 2 * 3.7 - 1 = 6.4 times that of independent ones.
            EXPECT_NEAR(longer / count, share,
                        4.0 * std::sqrt(6.4 * share * (1.0 - share) / count) + 1e-12)
                << length;
        }
        // The law that drew them passes its own test.
        EXPECT_GE(test_runs(runs, chain, of_losses).value_or(0.0), 1e-3);
    }
}

TEST(LossRuns, OfAWrongModelAreRejected)
{
    const auto runs = runs_of(drawn(Gilbert{5_percent, 4.0}, 50'000));
    LossChain independent;
    independent.loses[0] = 0.05;
    independent.shares[0] = independent.steps[0][0] = 1.0;
    EXPECT_LT(test_runs(runs, independent, true).value_or(1.0), 1e-6);
    EXPECT_FALSE(test_runs(runs_of({false, true, false}), independent, true)); // too few
}

TEST(LossRuns, ThatNoLawDescribesAreSaid)
{
    // Ten in a row of every 200: neither geometric nor independent.
    MeasuredWay way{.spacing = 10ms};
    for (int i = 0; i < 20'000; ++i) way.add(30ms, i % 200 < 10);
    const auto lesson = learn({.round_trip = way});
    ASSERT_TRUE(lesson);
    EXPECT_NE(to_text(*lesson).find("no law here describes them"), std::string::npos);
    EXPECT_NE(to_text(*lesson).find(" is taken: its BIC is the least"), std::string::npos);
}

TEST(LearnPlots, DrawWhatWasMeasuredBesideTheLaw)
{
    MeasuredWay way{.spacing = 10ms};
    const auto lost = drawn(Gilbert{5_percent, 4.0}, 4000);
    for (std::size_t i = 0; i < lost.size(); ++i) {
        way.add(30ms + 1ms * static_cast<int>(i % 10), lost[i]);
    }
    const auto lesson = learn({.round_trip = way});
    ASSERT_TRUE(lesson);
    ASSERT_EQ(lesson->plots.size(), 2U);
    for (const std::string& plot : lesson->plots) {
        EXPECT_NE(plot.find("###"), std::string::npos);
        EXPECT_NE(plot.find("| "), std::string::npos);
        std::size_t begin = 0;
        for (auto end = plot.find('\n'); end != std::string::npos; end = plot.find('\n', begin)) {
            EXPECT_LE(end - begin, 78U) << plot;
            begin = end + 1;
        }
    }
    EXPECT_NE(lesson->plots[1].find("8 or more"), std::string::npos);
}

} // namespace
} // namespace hapnet::emulator::tools
