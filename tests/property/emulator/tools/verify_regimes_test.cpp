// SPDX-FileCopyrightText: 2026 The Hapnet authors
// SPDX-License-Identifier: MIT
// The tests of regimes pass for a correct run, and fail for a run that differs by a little.
#include "emulator/tools/verify/regimes.hpp"

#include "emulator/core/pipeline.hpp"
#include "emulator/tools/verify/verify.hpp"

#include <algorithm>
#include <chrono>
#include <cmath>
#include <cstdlib>
#include <gtest/gtest.h>
#include <iostream>
#include <string>

namespace hapnet::emulator::tools::verify_regimes_test {
namespace {

using namespace std::chrono_literals;
using namespace base::literals; // NOLINT(google-build-using-namespace): literals only

constexpr double alpha = 1e-6;

std::size_t packets()
{
    const char* asked = std::getenv("HAPNET_SOAK_PACKETS");
    return asked != nullptr ? std::stoull(asked) : 300'000;
}

/// Three regimes with all kinds of laws.
Conditions changing(base::Duration bad = 100ms, double share = 0.3, double to_gone = 1.0)
{
    const auto lost = base::Probability::from_fraction(share).value();
    return {.loss = {RandomLoss{1_percent}},
            .delay = constant(20ms),
            .regimes = {{Regime{"good", 400ms, {{"bad", 3.0}, {"gone", to_gone}}, {}},
                         Regime{"bad",
                                bad,
                                {},
                                {.loss = {{RandomLoss{lost}}},
                                 .delay = constant(60ms),
                                 .jitter = Variation{GammaLaw{30ms, 10ms}, 50ms}}},
                         Regime{"gone",
                                50ms,
                                {},
                                {.loss = {{GilbertElliott{5_percent, 20_percent}}},
                                 .jitter = Variation{ExponentialLaw{5ms}, {}}}}}}};
}

std::vector<Fate> fates(const Conditions& conditions, std::uint64_t seed)
{
    Pipeline pipeline{conditions, base::Seed{seed}, Direction::up};
    std::vector<Fate> all;
    for (std::uint64_t n = 0; n < packets(); ++n) {
        all.push_back(pipeline.on_packet({n, 100, std::chrono::milliseconds{n}}));
    }
    return all;
}

std::vector<std::string> failed(const std::vector<TestResult>& results)
{
    std::vector<std::string> names;
    for (const TestResult& result : results) {
        if (result.outcome == Outcome::failed) names.push_back(result.name);
    }
    return names;
}

/// Prints the figures of a soak, which shows lines that begin with two spaces.
void print(const std::vector<TestResult>& results, std::uint64_t seed)
{
    for (const TestResult& result : results) {
        std::cout << "  seed " << seed << ", " << result.name << ": " << result.sentence;
        if (result.p_value) std::cout << ", p = " << *result.p_value;
        std::cout << std::endl;
    }
}

TEST(VerifyRegimes, PassesWhereTheyAreAsAsked)
{
    for (std::uint64_t seed = 1; seed <= 3; ++seed) {
        const auto results = verify_regimes(changing(), fates(changing(), seed), 1ms, alpha);
        EXPECT_EQ(failed(results), std::vector<std::string>{});
        std::size_t unable = 0;
        for (const TestResult& result : results) {
            if (result.outcome == Outcome::unable) ++unable;
        }
        EXPECT_LT(unable, 3U);
        EXPECT_GT(results.size(), 15U);
        if (std::getenv("HAPNET_SOAK_PACKETS") != nullptr) print(results, seed);
    }
}

TEST(VerifyRegimes, FailsWhereAnythingIsDifferent)
{
    const auto observed = fates(changing(), 1);
    const auto fails = [&](const Conditions& claimed, std::string_view test) {
        const auto names = failed(verify_regimes(claimed, observed, 1ms, alpha));
        return std::ranges::any_of(
            names, [&](const std::string& name) { return name.find(test) != name.npos; });
    };
    EXPECT_TRUE(fails(changing(140ms), "regime bad stays"));
    EXPECT_TRUE(fails(changing(100ms, 0.28), "regime bad, losses"));
    EXPECT_TRUE(fails(changing(100ms, 0.3, 2.0), "regime good to gone"));
    Conditions other = changing();
    auto all = other.regimes.all.get();
    all[1].own.jitter = Variation{GammaLaw{45ms, 10ms}, 50ms};
    all[2].own.loss = {{GilbertElliott{7_percent, 20_percent}}};
    other.regimes.all = std::move(all);
    EXPECT_TRUE(fails(other, "regime bad, delay law"));
    EXPECT_TRUE(fails(other, "regime gone, good to bad"));
    other = changing();
    other.delay = constant(21ms);
    EXPECT_TRUE(fails(other, "regime good, delay"));
}

TEST(VerifyRegimes, DrawsTheFatesOfASeedAgainInTheRegimesThatTheyMet)
{
    Conditions conditions = changing();
    auto all = conditions.regimes.all.get();
    all[1].own.jitter = Variation{GammaLaw{30ms, 10ms}, {}};
    conditions.regimes.all = std::move(all);
    auto observed = fates(conditions, 7);
    Claim claim{.path = {conditions, {}}, .seed = base::Seed{7}, .spacing = 1ms};
    const auto seed_passes = [&] {
        return verify_direction(claim, Direction::up, observed).front().outcome;
    };
    EXPECT_EQ(seed_passes(), Outcome::passed);
    const auto deliver =
        std::ranges::find_if(observed, [](const Fate& fate) { return !fate.drop; });
    deliver->delay += 1ns;
    EXPECT_EQ(seed_passes(), Outcome::failed);
}

TEST(VerifyRegimes, IsUnableWithoutTheColumnOrTheSpacing)
{
    const auto plain = verify_regimes(changing(), std::vector<Fate>(100), 1ms, alpha);
    ASSERT_EQ(plain.size(), 1U);
    EXPECT_EQ(plain.front().outcome, Outcome::unable);
    const auto unspaced = verify_regimes(changing(), fates(changing(), 1), std::nullopt, alpha);
    EXPECT_EQ(unspaced.front().outcome, Outcome::unable);
    EXPECT_TRUE(failed(unspaced).empty());
}

TEST(VerifyRegimes, KnowsTheChainFromDatagramToDatagram)
{
    const std::vector<Regime> two{Regime{"a", 3s, {}, {}}, Regime{"b", 1s, {}, {}}};
    for (const base::Duration after :
         {base::Duration{1ms}, base::Duration{700ms}, base::Duration{30s}}) {
        const double left = std::exp(-base::to_seconds(after) * (1.0 / 3.0 + 1.0));
        const auto passages = passages_of(two, after);
        EXPECT_NEAR(passages[0][1], 0.25 * (1.0 - left), 1e-12);
        EXPECT_NEAR(passages[1][1], 0.25 + 0.75 * left, 1e-12);
    }
}

} // namespace
} // namespace hapnet::emulator::tools::verify_regimes_test
