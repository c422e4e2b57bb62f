// SPDX-FileCopyrightText: 2026 The Hapnet authors
// SPDX-License-Identifier: MIT
#include "emulator/core/regime_chain.hpp"

#include <algorithm>
#include <chrono>
#include <cmath>
#include <gtest/gtest.h>
#include <tuple>

namespace hapnet::emulator::regime_chain_test {
namespace {

using namespace std::chrono_literals;

Regimes good_and_bad(base::Duration good = 3s, base::Duration bad = 150ms)
{
    return {{Regime{"good", good, {}, {}}, Regime{"bad", bad, {}, {}}}};
}

/// "a" is followed by "b" three times in four; "c" always by "a".
Regimes three()
{
    return {{Regime{"a", 2s, {{"b", 3.0}, {"c", 1.0}}, {}}, Regime{"b", 500ms, {}, {}},
             Regime{"c", 1s, {{"a", 2.0}}, {}}}};
}

RegimeChain chain_of(const Regimes& regimes, std::uint64_t seed = 1)
{
    return {regimes, base::Seed{seed}.stream("up/regime")};
}

TEST(RegimeChain, HasTheSharesOfItsRates)
{
    const auto two = shares_of(good_and_bad().all.get());
    EXPECT_NEAR(two[0], 3.0 / 3.15, 1e-12);
    EXPECT_NEAR(two[1], 0.15 / 3.15, 1e-12);
    // Visits: a = b / 2 + c, b = 3/4 a, c = a / 4 + b / 2: as 8 to 6 to 5. Times 2 s, 0.5 s, 1 s.
    const auto shares = shares_of(three().all.get());
    EXPECT_NEAR(shares[0], 16.0 / 24.0, 1e-12);
    EXPECT_NEAR(shares[1], 3.0 / 24.0, 1e-12);
    EXPECT_NEAR(shares[2], 5.0 / 24.0, 1e-12);
}

TEST(RegimeChain, SpendsTheSharesOfTheTime)
{
    const auto course = chain_of(three()).course(100h);
    const auto shares = shares_of(three().all.get());
    base::Duration whole{};
    for (std::size_t i = 0; i < 3; ++i) {
        whole += course[i].time;
        EXPECT_NEAR(base::to_seconds(course[i].time) / 360'000.0, shares[i], 0.005);
    }
    EXPECT_EQ(whole, 100h);
    EXPECT_NEAR(static_cast<double>(course[1].stays) / static_cast<double>(course[0].stays), 0.75,
                0.005);
}

TEST(RegimeChain, DependsOnNothingButTime)
{
    auto often = chain_of(good_and_bad());
    auto seldom = chain_of(good_and_bad());
    std::size_t changes = 0;
    std::size_t last = 0;
    for (base::Duration at{}; at < 600s; at += 1ms) {
        const auto now = often.at(at);
        if (now != last) ++changes;
        last = now;
        if (at % 7s == 0s) {
            EXPECT_EQ(seldom.at(at), now) << at.count();
        }
    }
    EXPECT_GT(changes, 200U);
}

TEST(RegimeChain, StaysForExponentialTimes)
{
    auto chain = chain_of(good_and_bad(1s, 1s));
    std::vector<double> stays;
    base::Duration begin{};
    while (stays.size() < 20'000) {
        stays.push_back(base::to_seconds(chain.end() - begin));
        begin = chain.end();
        std::ignore = chain.at(begin);
    }
    std::sort(stays.begin(), stays.end());
    double distance = 0.0;
    for (std::size_t i = 0; i < stays.size(); ++i) {
        const double rank = (static_cast<double>(i) + 0.5) / 20'000.0;
        distance = std::max(distance, std::abs(rank - (1.0 - std::exp(-stays[i]))));
    }
    EXPECT_LT(distance, 2.0 / std::sqrt(20'000.0)); // exceeded 7 times in 10 000
}

TEST(RegimeChain, BeginsInItsStationaryLaw)
{
    std::size_t bad = 0;
    constexpr std::size_t seeds = 20'000;
    for (std::uint64_t seed = 0; seed < seeds; ++seed) {
        if (chain_of(good_and_bad(3s, 1s), seed).at(0s) == 1) ++bad;
    }
    EXPECT_NEAR(static_cast<double>(bad) / seeds, 0.25, 4.0 * std::sqrt(0.25 * 0.75 / seeds));
}

TEST(RegimeChain, TellsItsCourseAtAnyTime)
{
    auto chain = chain_of(good_and_bad());
    std::ignore = chain.at(100s);
    const auto before = chain.course(50s); // no longer known: as of the last call
    const auto after = chain.course(200s);
    EXPECT_LE(before[0].time + before[1].time, 100s);
    EXPECT_EQ(after[0].time + after[1].time, 200s);
    const auto fresh = chain_of(good_and_bad()).course(200s);
    EXPECT_EQ(after[0].time, fresh[0].time);
    EXPECT_EQ(after[1].stays, fresh[1].stays);
}

TEST(Regimes, MustBeAbleToFollowEachOther)
{
    EXPECT_TRUE(validate(Regimes{}));
    EXPECT_TRUE(validate(three()));
    const auto refusal = [](std::vector<Regime> all) {
        const auto valid = validate(Regimes{std::move(all)});
        return valid ? std::string{} : valid.error().message;
    };
    EXPECT_NE(refusal({Regime{"a", 1s, {}, {}}}).find("2 to 4 regimes"), std::string::npos);
    EXPECT_NE(refusal({Regime{"a", 1s, {}, {}}, Regime{"a", 1s, {}, {}}}).find("two regimes 'a'"),
              std::string::npos);
    EXPECT_NE(refusal({Regime{"a", 1us, {}, {}}, Regime{"b", 1s, {}, {}}}).find("1ms to 720h"),
              std::string::npos);
    EXPECT_NE(refusal({Regime{"a", 1s, {{"x", 1.0}}, {}}, Regime{"b", 1s, {}, {}}}).find("'x'"),
              std::string::npos);
    EXPECT_NE(refusal({Regime{"a", 1s, {{"b", 0.0}}, {}}, Regime{"b", 1s, {}, {}}})
                  .find("nothing follows"),
              std::string::npos);
    // c is never reached. Also, a is never left for c.
    EXPECT_NE(refusal({Regime{"a", 1s, {{"b", 1.0}}, {}}, Regime{"b", 1s, {{"a", 1.0}}, {}},
                       Regime{"c", 1s, {}, {}}})
                  .find("fall apart"),
              std::string::npos);
    EXPECT_NE(refusal({Regime{"a", 1s, {}, {}}, Regime{"b", 1s, {{"c", 1.0}}, {}},
                       Regime{"c", 1s, {{"b", 1.0}}, {}}})
                  .find("fall apart"),
              std::string::npos);
}

} // namespace
} // namespace hapnet::emulator::regime_chain_test
