// SPDX-FileCopyrightText: 2026 The Hapnet authors
// SPDX-License-Identifier: MIT
#include "proto/base/normal.hpp"

#include "proto/base/math.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <limits>

namespace hapnet::base {

namespace {

/// Returns first + x (second + x (...)).
template <std::size_t n>
double polynomial(const std::array<double, n>& coefficients, double x)
{
    double sum = coefficients[n - 1];
    for (std::size_t i = n - 1; i-- > 0;) sum = sum * x + coefficients[i];
    return sum;
}

/// Returns exp(-z^2 / 2) without the error that the squaring of a large z causes in the exponent.
double bell(double z)
{
    const double coarse = static_cast<double>(static_cast<std::int64_t>(z * 16.0)) / 16.0;
    const double rest = (z - coarse) * (z + coarse);
    return exp(-0.5 * coarse * coarse) * exp(-0.5 * rest);
}

/// Returns P(Z > z) for z > 0.674.
double upper_tail(double z)
{
    // The coefficients ascend in z, or, beyond sqrt(32), in 1 / z^2.
    constexpr std::array<double, 9> c{
        9842.7148383839780218, 11602.651437647350124, 6848.1904505362823326,
        2494.5375852903726711, 597.27027639480026226, 93.506656132177855979,
        8.8831497943883759412, .39894151208813466764, 1.0765576773720192317e-8};
    constexpr std::array<double, 9> d{
        19685.429676859990727, 38912.003286093271411, 34900.952721145977266,
        18615.571640885098091, 6485.558298266760755,  1519.377599407554805,
        235.38790178262499861, 22.266688044328115691, 1.0};
    constexpr std::array<double, 6> p{2.9112874951168792e-5, .001421619193227893466,
                                      .022235277870649807,   .1274011611602473639,
                                      .21589853405795699,    .02307344176494017303};
    constexpr std::array<double, 6> q{7.29751555083966205e-5, .00378239633202758244,
                                      .0659881378689285515,   .468238212480865118,
                                      1.28426009614491121,    1.0};
    constexpr double sqrt_32 = 5.656854249492380195206754896838;
    constexpr double one_over_sqrt_two_pi = 0.398942280401432677939946059934;
    if (z <= sqrt_32) return bell(z) * polynomial(c, z) / polynomial(d, z);
    const double w = 1.0 / (z * z);
    return bell(z) * (one_over_sqrt_two_pi - w * polynomial(p, w) / polynomial(q, w)) / z;
}

} // namespace

double normal_cdf(double z)
{
    constexpr std::array<double, 5> a{18154.981253343561249, 1067.6894854603709582,
                                      161.02823106855587881, 2.2352520354606839287,
                                      .065682337918207449113};
    constexpr std::array<double, 5> b{45507.789335026729956, 10260.932208618978205,
                                      976.09855173777669322, 47.20258190468824187, 1.0};
    constexpr double third_quartile = 0.67448975;
    constexpr double most = 38.6; // P(Z > 38.6) is too small for a double
    if (z != z) return z;
    if (std::abs(z) <= third_quartile) {
        return 0.5 + z * polynomial(a, z * z) / polynomial(b, z * z);
    }
    const double tail = upper_tail(std::min(std::abs(z), most));
    return z < 0.0 ? tail : 1.0 - tail;
}

double normal_quantile(double probability)
{
    constexpr std::array<double, 8> a{3.3871328727963666080e0, 1.3314166789178437745e2,
                                      1.9715909503065514427e3, 1.3731693765509461125e4,
                                      4.5921953931549871457e4, 6.7265770927008700853e4,
                                      3.3430575583588128105e4, 2.5090809287301226727e3};
    constexpr std::array<double, 8> b{1.0,
                                      4.2313330701600911252e1,
                                      6.8718700749205790830e2,
                                      5.3941960214247511077e3,
                                      2.1213794301586595867e4,
                                      3.9307895800092710610e4,
                                      2.8729085735721942674e4,
                                      5.2264952788528545610e3};
    constexpr std::array<double, 8> c{1.42343711074968357734e0,  4.63033784615654529590e0,
                                      5.76949722146069140550e0,  3.64784832476320460504e0,
                                      1.27045825245236838258e0,  2.41780725177450611770e-1,
                                      2.27238449892691845833e-2, 7.74545014278341407640e-4};
    constexpr std::array<double, 8> d{1.0,
                                      2.05319162663775882187e0,
                                      1.67638483018380384940e0,
                                      6.89767334985100004550e-1,
                                      1.48103976427480074590e-1,
                                      1.51986665636164571966e-2,
                                      5.47593808499534494600e-4,
                                      1.05075007164441684324e-9};
    constexpr std::array<double, 8> e{6.65790464350110377720e0,  5.46378491116411436990e0,
                                      1.78482653991729133580e0,  2.96560571828504891230e-1,
                                      2.65321895265761230930e-2, 1.24266094738807843860e-3,
                                      2.71155556874348757815e-5, 2.01033439929228813265e-7};
    constexpr std::array<double, 8> f{1.0,
                                      5.99832206555887937690e-1,
                                      1.36929880922735805310e-1,
                                      1.48753612908506148525e-2,
                                      7.86869131145613259100e-4,
                                      1.84631831751005468180e-5,
                                      1.42151175831644588870e-7,
                                      2.04426310338993978564e-15};
    constexpr double infinity = std::numeric_limits<double>::infinity();
    const double q = probability - 0.5;
    if (std::abs(q) <= 0.425) {
        const double r = 0.180625 - q * q;
        return q * polynomial(a, r) / polynomial(b, r);
    }
    const double tail = q < 0.0 ? probability : 1.0 - probability;
    if (!(tail > 0.0)) {
        if (tail != 0.0) return std::numeric_limits<double>::quiet_NaN();
        return q < 0.0 ? -infinity : infinity;
    }
    const double r = std::sqrt(-log(tail));
    const double z = r <= 5.0 ? polynomial(c, r - 1.6) / polynomial(d, r - 1.6)
                              : polynomial(e, r - 5.0) / polynomial(f, r - 5.0);
    return q < 0.0 ? -z : z;
}

} // namespace hapnet::base
