// SPDX-FileCopyrightText: 2026 The Hapnet authors
// SPDX-License-Identifier: MIT
#include "emulator/tools/verify/tails.hpp"

#include "proto/base/ensure.hpp"

#include <algorithm>
#include <boost/math/distributions/binomial.hpp>
#include <boost/math/distributions/chi_squared.hpp>
#include <boost/math/distributions/normal.hpp>
#include <cmath>

namespace hapnet::emulator::tools {

double normal_two_sided(double z) { return std::erfc(std::abs(z) / std::sqrt(2.0)); }

double binomial_two_sided(std::uint64_t successes, std::uint64_t trials, double share)
{
    base::ensure(successes <= trials && share >= 0.0 && share <= 1.0);
    if (share == 0.0) return successes == 0 ? 1.0 : 0.0;
    if (share == 1.0) return successes == trials ? 1.0 : 0.0;
    if (trials == 0) return 1.0;
    const boost::math::binomial law{static_cast<double>(trials), share};
    const auto k = static_cast<double>(successes);
    const double at_most = boost::math::cdf(law, k);
    const double at_least =
        successes == 0 ? 1.0 : boost::math::cdf(boost::math::complement(law, k - 1.0));
    return std::min(1.0, 2.0 * std::min(at_most, at_least));
}

double chi_square_tail(double x, double degrees)
{
    const boost::math::chi_squared law{degrees};
    return boost::math::cdf(boost::math::complement(law, std::max(x, 0.0)));
}

double kolmogorov_tail(double distance, double n)
{
    const double root = std::sqrt(n);
    const double t = distance * (root + 0.12 + 0.11 / root);
    if (t < 0.3) return 1.0; // 1 - 9e-6; the series below needs a larger t
    double sum = 0.0;
    double sign = 2.0;
    for (int k = 1; k <= 100; ++k) {
        sum += sign * std::exp(-2.0 * k * k * t * t);
        sign = -sign;
    }
    return std::clamp(sum, 0.0, 1.0);
}

double normal_score(double u) { return boost::math::quantile(boost::math::normal{}, u); }

} // namespace hapnet::emulator::tools
