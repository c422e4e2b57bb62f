// SPDX-FileCopyrightText: 2026 The Hapnet authors
// SPDX-License-Identifier: MIT
//
// Every law against the distribution functions of Boost.Math, over virtual datagrams. The seeds are
// fixed: a test that passes keeps passing. HAPNET_SOAK_PACKETS sets the number of datagrams.
#include "emulator/core/delay/delay.hpp"
#include "emulator/core/delay/theory.hpp"
#include "proto/base/normal.hpp"

#include <algorithm>
#include <boost/math/distributions/exponential.hpp>
#include <boost/math/distributions/gamma.hpp>
#include <boost/math/distributions/lognormal.hpp>
#include <boost/math/distributions/normal.hpp>
#include <boost/math/distributions/pareto.hpp>
#include <boost/math/distributions/uniform.hpp>
#include <chrono>
#include <cmath>
#include <cstdlib>
#include <gtest/gtest.h>
#include <string>
#include <tuple>
#include <vector>

namespace hapnet::emulator {
namespace {

using namespace std::chrono_literals;
namespace math = boost::math;

std::uint64_t packets(std::uint64_t usual)
{
    const char* asked = std::getenv("HAPNET_SOAK_PACKETS");
    return asked ? std::stoull(asked) : usual;
}

/// Every `thin`-th of `count` delays of datagrams that arrive `spacing` apart, sorted.
std::vector<double> draw(const Variation& variation, std::uint64_t count,
                         base::Duration spacing = 1ms, std::uint64_t thin = 1)
{
    DelayProcess process{variation, base::Seed{42}.stream("up/jitter")};
    std::vector<double> delays;
    for (std::uint64_t n = 0; n < count; ++n) {
        const auto delay =
            process.on_packet({n, 96, static_cast<base::Duration::rep>(n) * spacing});
        if (n % thin == 0) delays.push_back(static_cast<double>(delay.count()));
    }
    std::sort(delays.begin(), delays.end());
    return delays;
}

constexpr double alpha = 1e-6;

/// Kolmogorov-Smirnov and Anderson-Darling at alpha. below(x) and above(x) are the shares of
/// delays up to and beyond x: both, since 1 - share says nothing in the far tail.
template <typename Below, typename Above>
void expect_fit(const std::vector<double>& delays, const Below& below, const Above& above)
{
    const auto n = static_cast<double>(delays.size());
    double distance = 0.0;
    double logs = 0.0;
    for (std::size_t i = 0; i < delays.size(); ++i) {
        const auto rank = static_cast<double>(i);
        const double share = below(delays[i]);
        distance = std::max({distance, (rank + 1.0) / n - share, share - rank / n});
        logs += (2.0 * rank + 1.0) * std::log(share);
        logs += (2.0 * (n - rank) - 1.0) * std::log(above(delays[i]));
    }
    // P(D > d) <= 2 exp(-2 n d^2) (Dvoretzky, Kiefer, Wolfowitz; Massart 1990).
    EXPECT_LT(distance, std::sqrt(std::log(2.0 / alpha) / (2.0 * n)));
    // P(A^2 > a) tends to sqrt(3) erfc(sqrt(a)) (the weights 1 / (j (j + 1)) of Anderson and
    // Darling 1952 with the tail of Zolotarev 1961), which is 1e-6 at 12.5.
    EXPECT_LT(-n - logs / n, 12.5);
}

template <typename Distribution>
void expect_fit(const std::vector<double>& delays, const Distribution& distribution)
{
    expect_fit(
        delays, [&](double x) { return math::cdf(distribution, x); },
        [&](double x) { return math::cdf(math::complement(distribution, x)); });
}

// The delays are 100 s, so that rounding to a nanosecond does not matter in a test of 10^7 delays.

TEST(Laws, UniformDelaysAreUniform)
{
    expect_fit(draw({UniformLaw{100s, 15s}}, packets(1'000'000)),
               math::uniform_distribution<>{85e9, 115e9});
}

TEST(Laws, NormalDelaysAreNormal)
{
    expect_fit(draw({NormalLaw{100s, 5s}}, packets(1'000'000)),
               math::normal_distribution<>{100e9, 5e9});
}

TEST(Laws, LogNormalDelaysAreLogNormalWithTheirOwnMeanAndSd)
{
    const double log_variance = std::log1p(0.3 * 0.3);
    expect_fit(draw({LogNormalLaw{100s, 30s}}, packets(200'000)),
               math::lognormal_distribution<>{std::log(100e9) - 0.5 * log_variance,
                                              std::sqrt(log_variance)});
}

TEST(Laws, ExponentialDelaysAreExponential)
{
    expect_fit(draw({ExponentialLaw{100s}}, packets(200'000)),
               math::exponential_distribution<>{1e-11});
}

TEST(Laws, ParetoDelaysArePareto)
{
    expect_fit(draw({ParetoLaw{150s, 3.0}}, packets(200'000)),
               math::pareto_distribution<>{100e9, 3.0});
    expect_fit(draw({ParetoLaw{300s, 1.5}}, packets(200'000)),
               math::pareto_distribution<>{100e9, 1.5});
}

TEST(Laws, GammaDelaysAreGamma)
{
    expect_fit(draw({GammaLaw{80s, 40s}}, packets(200'000)), math::gamma_distribution<>{4.0, 20e9});
}

TEST(Laws, GammaDelaysOfALargeShapeAreGammaToo)
{
    // Few values, because each value of the distribution function takes Boost microseconds here.
    expect_fit(draw({GammaLaw{100s, 1s}}, 10'000), math::gamma_distribution<>{10'000.0, 1e7});
}

TEST(Laws, DelaysOfATableRunInStraightLinesThroughItsValues)
{
    const auto table = std::make_shared<const QuantileTable>(std::vector<double>{80e9, 10e9, 40e9},
                                                             QuantileTable::Unit::nanoseconds);
    const auto below = [](double x) {
        return x < 40e9 ? 0.5 * (x - 10e9) / 30e9 : 0.5 + 0.5 * (x - 40e9) / 40e9;
    };
    expect_fit(draw({TableLaw{"file", {}, {}, table}}, packets(200'000)), below,
               [&](double x) { return 1.0 - below(x); });
}

/// Thinned by 5 correlation times: neighbours are left with a correlation of exp(-5) = 0.007.
TEST(Laws, ACorrelationTimeLeavesTheLawAsItIs)
{
    for (const base::Duration tau :
         {base::Duration{1ms}, base::Duration{100ms}, base::Duration{1s}}) {
        expect_fit(draw({UniformLaw{100s, 15s}, tau}, packets(200'000), tau / 4, 20),
                   math::uniform_distribution<>{85e9, 115e9});
        expect_fit(draw({GammaLaw{80s, 40s}, tau}, packets(200'000), tau / 4, 20),
                   math::gamma_distribution<>{4.0, 20e9});
    }
}

/// The normal scores of a uniform law's delays, which are the underlying Gaussian process.
std::vector<double> scores(base::Duration tau, const std::vector<base::Duration>& arrivals)
{
    DelayProcess process{{UniformLaw{100s, 15s}, tau}, base::Seed{7}.stream("up/jitter")};
    std::vector<double> out;
    for (std::uint64_t n = 0; n < arrivals.size(); ++n) {
        const auto delay = process.on_packet({n, 96, arrivals[n]});
        out.push_back(base::normal_quantile(static_cast<double>((delay - 85s).count()) / 30e9));
    }
    return out;
}

TEST(Laws, CorrelationDecaysExponentiallyWithTheTimeBetweenArrivals)
{
    std::vector<base::Duration> arrivals;
    for (std::uint64_t n = 0; n < packets(400'000); ++n) {
        arrivals.push_back(static_cast<base::Duration::rep>(n) * base::Duration{1ms});
    }
    const auto z = scores(20ms, arrivals);
    for (const std::size_t lag : {1U, 5U, 20U, 60U, 200U}) {
        double sum = 0.0;
        for (std::size_t i = lag; i < z.size(); ++i) sum += z[i] * z[i - lag];
        const auto terms = static_cast<double>(z.size() - lag);
        // Bartlett 1946: the variance is at most 2 / n times the sum of all squared correlations,
        // here coth(1 ms / 20 ms) = 20. Five standard deviations: one in 10^6.
        EXPECT_NEAR(sum / terms, std::exp(-static_cast<double>(lag) / 20.0),
                    5.0 * std::sqrt(2.0 * 20.0 / terms))
            << lag;
    }
}

TEST(Laws, WhatIsNewInACorrelatedDrawIsIndependentNoiseHoweverFarTheArrivalsLieApart)
{
    const auto gap = base::Seed{8}.stream("gaps");
    std::vector<base::Duration> arrivals{0ms};
    for (std::uint64_t n = 1; n < packets(200'000); ++n) {
        const double u = gap.uniform(n);
        arrivals.push_back(arrivals.back() + base::from_seconds(0.05 * u * u * u));
    }
    const auto z = scores(20ms, arrivals);
    std::vector<double> noise;
    double with_last = 0.0;
    for (std::size_t i = 1; i < z.size(); ++i) {
        const double rho = std::exp(-base::to_seconds(arrivals[i] - arrivals[i - 1]) / 0.02);
        if (rho > 0.999) continue; // the noise is lost in the rounding of the delays
        noise.push_back((z[i] - rho * z[i - 1]) / std::sqrt(1.0 - rho * rho));
        with_last += noise.back() * z[i - 1];
    }
    const auto n = static_cast<double>(noise.size());
    EXPECT_LT(std::abs(with_last / n), 5.0 / std::sqrt(n)); // five standard deviations
    std::sort(noise.begin(), noise.end());
    expect_fit(noise, math::normal_distribution<>{});
}

/// Both tails are computed from the smaller share.
template <typename Distribution>
double worst_quantile(const DelayLaw& law, const Distribution& distribution)
{
    DelayTheory theory{law};
    double worst = 0.0;
    for (int i = 1; i < 200; ++i) {
        const double z = -8.2 + i * 0.082;
        const double u = base::normal_cdf(z);
        const double truth = u < 0.5 ? math::quantile(distribution, u)
                                     : math::quantile(math::complement(distribution, 1.0 - u));
        const auto ours = theory.quantile(u);
        const double error = std::abs(static_cast<double>(ours.count()) - truth);
        worst = std::max(worst, (error - 0.5) / truth); // rounded to a nanosecond
    }
    return worst;
}

TEST(Laws, QuantilesAreExactToEightStandardDeviations)
{
    EXPECT_LE(worst_quantile(UniformLaw{160ms, 15ms}, math::uniform_distribution<>{145e6, 175e6}),
              1e-14);
    EXPECT_LE(worst_quantile(NormalLaw{160ms, 5ms}, math::normal_distribution<>{160e6, 5e6}),
              1e-14);
    EXPECT_LE(worst_quantile(ExponentialLaw{5ms}, math::exponential_distribution<>{1.0 / 5e6}),
              1e-14);
    EXPECT_LE(worst_quantile(ParetoLaw{15ms, 3.0}, math::pareto_distribution<>{10e6, 3.0}), 1e-13);
    const double log_variance = std::log1p(1e-10);
    EXPECT_LE(worst_quantile(LogNormalLaw{100s, 1ms},
                             math::lognormal_distribution<>{std::log(1e11) - 0.5 * log_variance,
                                                            std::sqrt(log_variance)}),
              1e-14);
}

TEST(Laws, QuantilesOfTheGammaLawAreWithinTheirStatedErrorForEveryShape)
{
    const auto worst = [](base::Duration mean, base::Duration sd) {
        const double ratio = static_cast<double>(mean.count()) / static_cast<double>(sd.count());
        const double shape = ratio * ratio;
        return worst_quantile(
            GammaLaw{mean, sd},
            math::gamma_distribution<>{shape, static_cast<double>(mean.count()) / shape});
    };
    for (const base::Duration sd :
         {base::Duration{1ms}, base::Duration{1s}, base::Duration{3162ms}, base::Duration{3163ms},
          base::Duration{25s}, base::Duration{50s}, base::Duration{100s}}) {
        EXPECT_LE(worst(100s, sd), 2e-8) << sd.count();
    }
    EXPECT_LE(worst(100s, 300s), 2e-6);
    EXPECT_LE(worst(100s, 1000s), 2e-6);
}

} // namespace
} // namespace hapnet::emulator
