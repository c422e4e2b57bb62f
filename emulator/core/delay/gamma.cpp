// SPDX-FileCopyrightText: 2026 The Hapnet authors
// SPDX-License-Identifier: MIT
#include "emulator/core/delay/gamma.hpp"

#include "proto/base/ensure.hpp"
#include "proto/base/math.hpp"
#include "proto/base/normal.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

namespace hapnet::emulator {

namespace {

constexpr double expansion_from = 1000.0;
constexpr double unsolved = std::numeric_limits<double>::quiet_NaN();

double shape_of(const GammaLaw& law)
{
    const double ratio =
        base::to_nanoseconds(law.mean) / std::max(base::to_nanoseconds(law.sd), 1.0);
    return std::max(ratio * ratio, GammaQuantile::shape_min);
}

/// Returns log Gamma(x) for x > 0: by Stirling's series (DLMF 5.11.1) beyond 10, by the recurrence
/// below.
double log_gamma(double x)
{
    double product = 1.0;
    for (; x < 10.0; x += 1.0) product *= x;
    constexpr double half_log_two_pi = 0.918938533204672741780;
    const double w = 1.0 / (x * x);
    const double series =
        1.0 / 12 +
        w * (-1.0 / 360 +
             w * (1.0 / 1260 +
                  w * (-1.0 / 1680 + w * (1.0 / 1188 + w * (-691.0 / 360360 + w * (1.0 / 156))))));
    return (x - 0.5) * base::log(x) - x + half_log_two_pi + series / x - base::log(product);
}

/// Returns the sum of x^n / ((shape + 1) ... (shape + n)), n >= 0 (DLMF 8.7.1).
double lower_series(double shape, double x)
{
    double sum = 1.0;
    double term = 1.0;
    for (double n = 1.0; term > 1e-17 * sum; n += 1.0) {
        term *= x / (shape + n);
        sum += term;
    }
    return sum;
}

/// Returns x^(1-shape) e^x times the upper incomplete gamma function, for x >= shape + 1: its
/// continued fraction (DLMF 8.9.2) by Lentz's method, modified by Thompson and Barnett.
double upper_fraction(double shape, double x)
{
    double b = x + 1.0 - shape;
    double c = std::numeric_limits<double>::infinity();
    double d = 1.0 / b;
    double product = d;
    constexpr double terms_max = 10'000;
    for (double n = 1.0; n < terms_max; n += 1.0) {
        const double a = n * (shape - n);
        b += 2.0;
        d = 1.0 / (b + a * d);
        c = b + a / c;
        const double factor = c * d;
        product *= factor;
        if (std::abs(factor - 1.0) < 1e-16) break;
    }
    return product * x;
}

} // namespace

GammaQuantile::GammaQuantile(double shape) : shape_{shape}
{
    base::ensure(shape >= shape_min);
    nodes_.fill({unsolved, unsolved});
    if (shape >= expansion_from) return;
    log_shape_ = base::log(shape);
    log_gamma_ = log_gamma(shape);
}

double GammaQuantile::at(double z)
{
    if (shape_ >= expansion_from) return expansion(z);
    const double place = (std::clamp(z, -z_max, z_max) + z_max) * nodes_per_unit;
    const auto index = std::min(static_cast<std::size_t>(place), nodes - 2);
    const Node& low = node(index);
    const Node& high = node(index + 1);
    // Hermite's cubic between the two nodes.
    const double t = place - static_cast<double>(index);
    const double rise = high.value - low.value;
    const double bend_low = low.slope / nodes_per_unit - rise;
    const double bend_high = rise - high.slope / nodes_per_unit;
    const double bend = (1.0 - t) * bend_low + t * bend_high;
    return base::exp(low.value + t * (rise + (1.0 - t) * bend));
}

const GammaQuantile::Node& GammaQuantile::node(std::size_t index)
{
    Node& node = nodes_[index];
    if (node.value != node.value) {
        node = solve(static_cast<double>(index) / nodes_per_unit - z_max);
    }
    return node;
}

/// Applies Newton's method to the logarithm of the smaller tail as a function of w = log x. The
/// function is concave, so the method converges from everywhere, and is accurate however far out.
GammaQuantile::Node GammaQuantile::solve(double z) const
{
    const double log_tail = base::log(base::normal_cdf(-std::abs(z)));
    const double log_gamma_next = log_gamma_ + log_shape_; // log gamma(shape + 1)
    const double w_max = base::log(shape_ + 60.0 + 12.0 * std::sqrt(shape_));
    // Starts from Wilson and Hilferty, PNAS 17 (1931), or where that fails from the power law near
    // zero.
    const double root = 1.0 - 1.0 / (9.0 * shape_) + z / (3.0 * std::sqrt(shape_));
    double w = root > 0.1 ? log_shape_ + 3.0 * base::log(root)
                          : (base::log(base::normal_cdf(z)) + log_gamma_next) / shape_;
    double log_density = 0.0; // log density of w
    constexpr int steps_max = 100;
    for (int i = 0; i < steps_max; ++i) {
        w = std::min(w, w_max);
        const double x = base::exp(w);
        log_density = shape_ * w - x - log_gamma_;
        const auto log_lower = [&] {
            return log_density - log_shape_ + base::log(lower_series(shape_, x));
        };
        double log_share = 0.0;
        if (z < 0.0) {
            log_share = log_lower();
        } else if (x < shape_ + 1.0) {
            log_share = base::log1p(-std::min(base::exp(log_lower()), 1.0 - 0x1p-53));
        } else {
            log_share = log_density - w + base::log(upper_fraction(shape_, x));
        }
        const double step = (log_share - log_tail) * base::exp(log_share - log_density);
        w = z < 0.0 ? w - step : w + step;
        if (std::abs(step) < 1e-9) break;
    }
    log_density = shape_ * w - base::exp(w) - log_gamma_;
    const double log_bell = -0.5 * z * z - 0.918938533204672741780; // - log(2 pi) / 2
    return {w - log_shape_, base::exp(log_bell - log_density)};
}

/// Returns the quantile by Cornish and Fisher, Revue de l'Institut International de Statistique 5
/// (1938), for the gamma distribution (the coefficients of Goldberg and Levine, Ann. Math. Statist.
/// 17 (1946)).
double GammaQuantile::expansion(double z) const
{
    const double s = 1.0 / std::sqrt(shape_);
    const double y = z * z;
    const double first = (y - 1.0) / 3;
    const double second = z * (y - 7.0) / 36;
    const double third = ((-3.0 * y - 7.0) * y + 16.0) / 810;
    const double fourth = z * ((9.0 * y + 256.0) * y - 433.0) / 38880;
    const double fifth = (((12.0 * y - 243.0) * y - 923.0) * y + 1472.0) / 204120;
    return 1.0 + s * (z + s * (first + s * (second + s * (third + s * (fourth + s * fifth)))));
}

base::Result<void> GammaLaw::validate() const
{
    constexpr base::Duration zero{0};
    static_assert(GammaQuantile::shape_min == 0.01);
    return all({require_ranges(*this), require(mean > zero, "mean must be more than 0"),
                require(sd > zero, "sd must be more than 0"),
                require(sd <= 10 * mean, "sd must be at most 10 times the mean")});
}

LawMoments GammaLaw::moments() const { return {mean, sd}; }

GammaLaw::Sampler::Sampler(const GammaLaw& law)
    : mean_{base::to_nanoseconds(law.mean)}, shape_{shape_of(law)}, quantiles_{shape_}
{}

base::Duration GammaLaw::Sampler::quantile(double u)
{
    return bounded(mean_ * quantiles_.at(base::normal_quantile(u)));
}

void GammaLaw::Sampler::change(const GammaLaw& law)
{
    if (shape_ != shape_of(law)) {
        *this = Sampler{law};
    } else {
        mean_ = base::to_nanoseconds(law.mean);
    }
}

} // namespace hapnet::emulator
