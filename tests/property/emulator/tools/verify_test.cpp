// SPDX-FileCopyrightText: 2026 The Hapnet authors
// SPDX-License-Identifier: MIT
// The tests of verify can fail: each is shown a run that breaks its law by a little.
#include "emulator/tools/verify/verify.hpp"

#include "emulator/core/pipeline.hpp"
#include "emulator/tools/verify/draws.hpp"
#include "emulator/tools/verify/exact.hpp"
#include "emulator/tools/verify/losses.hpp"
#include "emulator/tools/verify/tails.hpp"
#include "tests/property/emulator/core/loss/simulated.hpp"

#include <algorithm>
#include <chrono>
#include <cmath>
#include <gtest/gtest.h>
#include <map>

namespace hapnet::emulator::tools {

namespace {

using namespace std::chrono_literals;
using namespace base::literals; // NOLINT(google-build-using-namespace): literals only
using test::alpha;
using test::simulated;
using test::spacing;

constexpr std::uint64_t count = 200'000;

base::RandomStream stream(std::uint64_t seed = 1) { return base::Seed{seed}.stream("planted"); }

/// The outcome of each test for a run under a law that it does not follow.
std::map<std::string, Outcome> outcomes(const LossLaw& claimed, const LossRecord& observed)
{
    std::map<std::string, Outcome> result;
    for (const auto& one : verify_losses({claimed}, observed, spacing, alpha)) {
        result[one.name] = one.outcome;
    }
    return result;
}

/// As tc-netem draws correlated losses: X[n] = (1 - rho) U[n] + rho X[n - 1], lost when X < share.
LossRecord correlated_as_netem_does(double share, double rho)
{
    LossRecord record{.lost = {}, .states = {{}}};
    double x = 0.5;
    for (std::uint64_t n = 0; n < count; ++n) {
        x = (1 - rho) * stream().uniform(n) + rho * x;
        record.lost.push_back(x < share ? 1 : 0);
        record.states[0].push_back(LossState::none);
    }
    return record;
}

std::vector<Fate> fates(const Conditions& conditions, Direction direction, std::uint64_t seed)
{
    Pipeline pipeline{conditions, base::Seed{seed}, direction};
    std::vector<Fate> result;
    for (std::uint64_t n = 0; n < 20'000; ++n) {
        result.push_back(
            pipeline.on_packet({n, 96, spacing * static_cast<base::Duration::rep>(n)}));
    }
    return result;
}

} // namespace

TEST(Verify, PassesARunWhoseFirstDatagramsHadNoDestinationYet)
{
    Claim claim;
    claim.seed = base::Seed{5};
    claim.alpha = alpha;
    claim.path.up.loss = {RandomLoss{30_percent}};
    Pipeline pipeline{claim.path.up, *claim.seed, Direction::up};
    std::vector<Fate> fates;
    for (std::uint64_t number = 0; number < 20'000; ++number) {
        const Fate drawn = pipeline.on_packet({.number = number});
        fates.push_back(number < 5000 ? without_destination(drawn) : drawn);
    }
    for (const TestResult& result : verify_direction(claim, Direction::up, fates)) {
        EXPECT_NE(result.outcome, Outcome::failed) << result.name << ": " << result.sentence;
    }
    fates[7000] = without_destination(Fate{}); // a datagram that the law may have lost, or not
    fates[7001] = Fate{.drop = DropCause::random_loss};
    fates[7002] = Fate{};
    fates[7003] = Fate{.drop = DropCause::random_loss};
    EXPECT_EQ(verify_direction(claim, Direction::up, fates).at(0).outcome, Outcome::failed);
}

TEST(VerifyRejects, AShareThatIsOffByOnePercentOfItself)
{
    // Over 10^6 datagrams 30.3 % instead of 30 % is 6.5 standard deviations.
    const auto found =
        outcomes(RandomLoss{30_percent}, simulated(RandomLoss{30.3_percent}, 1'000'000));
    EXPECT_EQ(found.at("losses"), Outcome::failed);
    EXPECT_EQ(found.at("independence"), Outcome::passed);
}

TEST(VerifyRejects, TheCorrelatedLossOfNetem)
{
    const auto tenth = outcomes(RandomLoss{10_percent}, correlated_as_netem_does(0.10, 0.25));
    EXPECT_EQ(tenth.at("losses"), Outcome::failed);
    const auto half = outcomes(RandomLoss{50_percent}, correlated_as_netem_does(0.50, 0.25));
    EXPECT_EQ(half.at("losses"), Outcome::passed);
    EXPECT_EQ(half.at("independence"), Outcome::failed);
    EXPECT_EQ(half.at("number of runs"), Outcome::failed);
    EXPECT_EQ(half.at("run lengths"), Outcome::failed);
}

TEST(VerifyRejects, RunsOfAnotherLengthUnderTheRightShare)
{
    const auto found = outcomes(Gilbert{5_percent, 4.0}, simulated(Gilbert{5_percent, 4.6}, count));
    EXPECT_EQ(found.at("losses"), Outcome::passed);
    EXPECT_EQ(found.at("run lengths"), Outcome::failed);
    EXPECT_EQ(found.at("bad to good"), Outcome::failed);
}

TEST(VerifyRejects, AChainThatLosesOtherThanItsStateSays)
{
    const GilbertElliott claimed{2_percent, 5_percent, 1_percent, 70_percent};
    const GilbertElliott done{2_percent, 5_percent, 2_percent, 67_percent};
    const auto found = outcomes(claimed, simulated(done, count));
    EXPECT_EQ(found.at("lost while good"), Outcome::failed);
    EXPECT_EQ(found.at("lost while bad"), Outcome::failed);
    EXPECT_EQ(found.at("good to bad"), Outcome::passed);
}

TEST(VerifyRejects, FourStatesWithOtherGoodRuns)
{
    const FourState claimed{30_percent, 10.0, 60_percent, 10_percent, 3.0};
    FourState done = claimed;
    done.good_run = 2.5;
    const auto found = outcomes(claimed, simulated(done, count));
    EXPECT_EQ(found.at("received_in_burst to lost_in_burst"), Outcome::failed);
    EXPECT_EQ(found.at("run lengths"), Outcome::failed);
    EXPECT_EQ(found.at("losses"), Outcome::passed);
}

TEST(VerifyRejects, BlocksThatLoseTheirNumberOnAverageOnly)
{
    const auto found = outcomes(BlockLoss{30, 100}, simulated(RandomLoss{30_percent}, count));
    EXPECT_EQ(found.at("blocks"), Outcome::failed);
    EXPECT_EQ(found.at("places"), Outcome::passed);
}

TEST(VerifyRejects, BlocksThatPreferAPlace)
{
    const auto found = outcomes(BlockLoss{30, 100}, simulated(Burst{30, 100}, count));
    EXPECT_EQ(found.at("blocks"), Outcome::passed);
    EXPECT_EQ(found.at("places"), Outcome::failed);
}

TEST(VerifyRejects, OneWrongDatagramUnderALawThatDrawsNothing)
{
    for (const LossLaw& law : {LossLaw{PeriodicLoss{7, 3}}, LossLaw{Burst{40, 100}},
                               LossLaw{ListedLoss{{5, 9}}}, LossLaw{PatternLoss{{true, false}}}}) {
        auto record = simulated(law, count);
        EXPECT_EQ(verify_losses({law}, record, spacing, alpha).at(0).outcome, Outcome::passed);
        record.lost[count / 2] ^= 1U;
        const auto result = verify_losses({law}, record, spacing, alpha).at(0);
        EXPECT_EQ(result.outcome, Outcome::failed) << name_of(law);
        EXPECT_EQ(result.statistic, 1.0);
    }
}

TEST(VerifyRejects, ALossWhereNoLawIs)
{
    const auto record = simulated(ListedLoss{{700}}, 1000);
    EXPECT_EQ(verify_losses({}, record, spacing, alpha).at(0).outcome, Outcome::failed);
}

TEST(VerifyRejects, OneSeedForBothDirections)
{
    const Conditions conditions{.loss = {Gilbert{30_percent, 3.0}}};
    const Claim claim{.path = {conditions, conditions}, .spacing = spacing};
    const auto up = fates(conditions, Direction::up, 7);
    const auto down = fates(conditions, Direction::down, 7);
    EXPECT_EQ(verify(claim, up, down).between.at(0).outcome, Outcome::passed);
    EXPECT_EQ(verify(claim, up, up).between.at(0).outcome, Outcome::failed);
}

TEST(VerifyRejects, FatesOfAnotherSeed)
{
    const Conditions conditions{.loss = {RandomLoss{30_percent}, Burst{4, 17}},
                                .jitter = {UniformLaw{0ms, 5ms}}};
    const Claim claim{.path = {conditions, conditions}, .seed = base::Seed{7}};
    const auto right = verify_direction(claim, Direction::up, fates(conditions, Direction::up, 7));
    EXPECT_EQ(right.at(0).outcome, Outcome::passed);
    const auto wrong = verify_direction(claim, Direction::up, fates(conditions, Direction::up, 8));
    EXPECT_EQ(wrong.at(0).name, "seed");
    EXPECT_EQ(wrong.at(0).outcome, Outcome::failed);
}

TEST(VerifyRejects, ADelayThatIsNotTheConstantOne)
{
    const Conditions asked{.delay = {ConstantLaw{160ms}}};
    const Conditions done{.delay = {ConstantLaw{160ms + 1ns}}};
    const Claim claim{.path = {asked, asked}};
    EXPECT_FALSE(verify(claim, fates(asked, Direction::up, 7), {}).failed());
    EXPECT_TRUE(verify(claim, fates(done, Direction::up, 7), {}).failed());
}

TEST(Verify, SaysNothingAgainstAnHonestRunAndShowsEachTest)
{
    const Conditions conditions{.loss = {RandomLoss{30_percent}, Gilbert{5_percent, 4.0}},
                                .delay = {ConstantLaw{160ms}},
                                .jitter = {UniformLaw{0ms, 5ms}}};
    const Claim claim{.path = {conditions, {}}, .seed = base::Seed{7}, .spacing = spacing};
    const auto result = verify(claim, fates(conditions, Direction::up, 7), {});
    EXPECT_FALSE(result.failed()) << to_text(result);
    const auto text = to_text(result);
    EXPECT_NE(text.find("good to bad"), std::string::npos);
    EXPECT_NE(text.find("delay law"), std::string::npos) << text;
    EXPECT_TRUE(text.ends_with("verdict  passed\n"));
}

TEST(Verify, FindsARightLawImprobableAsOftenAsItSays)
{
    // p < 5 % in 200 runs: binomial, mean 10, standard deviation 3.1; at most 5 of them above.
    constexpr int runs = 200;
    for (const LossLaw& law :
         {LossLaw{RandomLoss{10_percent}}, LossLaw{BlockLoss{30, 100}},
          LossLaw{GilbertElliott{2_percent, 5_percent, 10_percent, 70_percent}},
          LossLaw{FourState{30_percent, 10.0, 60_percent, 10_percent, 3.0}}}) {
        std::map<std::string, int> improbable;
        for (std::uint64_t seed = 0; seed < runs; ++seed) {
            for (const auto& one :
                 verify_losses({law}, simulated(law, 10'000, seed), spacing, 0.05)) {
                if (one.outcome == Outcome::failed) ++improbable[one.name];
            }
        }
        for (const auto& [name, times] : improbable) {
            EXPECT_LE(times, 10 + 5 * 3.1) << name_of(law) << ": " << name;
        }
    }
}

TEST(Verify, SaysWhatItCannotTell)
{
    const auto few = outcomes(Gilbert{1_percent, 50.0}, simulated(Gilbert{1_percent, 50.0}, 1000));
    EXPECT_EQ(few.at("losses"), Outcome::unable);
    EXPECT_EQ(outcomes(Outage{{{0ms, 1ms}}}, simulated(Outage{{{0ms, 1ms}}}, 10)).at("losses"),
              Outcome::unable);
}

TEST(Tails, AreThoseOfTheTables)
{
    EXPECT_NEAR(normal_two_sided(1.959964), 0.05, 1e-7);
    EXPECT_NEAR(normal_two_sided(4.891638), 1e-6, 1e-11);
    // 2 P(X <= 1) = 2 (1 + 10) / 1024 of Binomial(10, 1/2).
    EXPECT_NEAR(binomial_two_sided(1, 10, 0.5), 22.0 / 1024, 1e-12);
    EXPECT_EQ(binomial_two_sided(5, 10, 0.5), 1.0);
    EXPECT_EQ(binomial_two_sided(0, 10, 0.0), 1.0);
    EXPECT_EQ(binomial_two_sided(9, 10, 1.0), 0.0);
    EXPECT_NEAR(chi_square_tail(3.841459, 1), 0.05, 1e-7);
    EXPECT_NEAR(chi_square_tail(18.307038, 10), 0.05, 1e-7);
    EXPECT_NEAR(kolmogorov_tail(1.3581 / 1000, 1e6), 0.05, 1e-4);
    EXPECT_NEAR(kolmogorov_tail(1.6276 / 1000, 1e6), 0.01, 1e-4);
    EXPECT_NEAR(normal_score(0.975), 1.959964, 1e-6);
}

TEST(DelayTests, TellAUniformLawFromOneThatIsTwoPercentWider)
{
    const auto drawn = [](double width) {
        std::vector<base::Duration> delays;
        for (std::uint64_t n = 0; n < count; ++n) {
            delays.emplace_back(std::llround(stream().uniform(n) * width));
        }
        return delays;
    };
    EXPECT_EQ(test_same_law(drawn(1e7), drawn(1.02e7), alpha).outcome, Outcome::failed);
}

TEST(DelayTests, MeasureTheCorrelationOfANormalChain)
{
    constexpr double rho = 0.9;
    std::vector<double> scores{0.0};
    for (std::uint64_t n = 0; n < count; ++n) {
        const double fresh = normal_score(0.5 * 0x1p-53 + stream().uniform(n) * (1 - 0x1p-53));
        scores.push_back(rho * scores.back() + std::sqrt(1 - rho * rho) * fresh);
    }
    EXPECT_EQ(test_correlation(scores, rho, alpha).outcome, Outcome::passed);
    EXPECT_EQ(test_correlation(scores, rho - 0.01, alpha).outcome, Outcome::failed);
    EXPECT_EQ(test_correlation(scores, 0.0, alpha).outcome, Outcome::failed);
}

} // namespace hapnet::emulator::tools
