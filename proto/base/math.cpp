// SPDX-FileCopyrightText: 2026 The Hapnet authors
// SPDX-License-Identifier: MIT
#include "proto/base/math.hpp"

#include <bit>
#include <cstdint>
#include <limits>

namespace hapnet::base {

namespace {

constexpr double not_a_number = std::numeric_limits<double>::quiet_NaN();

/// Returns the integer nearest to x for |x| < 2^51, by the rounding of an addition.
double nearest(double x)
{
    constexpr double shift = 6755399441055744.0; // 1.5 * 2^52
    const double shifted = x + shift;
    return shifted - shift;
}

/// x = quadrant * pi/2 + (high + low), |high| <= pi/4.
struct Reduced {
    double high, low;
    int quadrant;
};

Reduced reduce(double x)
{
    // pi/2 in three parts of 33 bits (fdlibm e_rem_pio2.c): n * part is exact for |n| < 2^20.
    constexpr double two_over_pi = 6.36619772367581382433e-01;
    constexpr double part1 = 1.57079632673412561417e+00;
    constexpr double part2 = 6.07710050630396597660e-11;
    constexpr double part3 = 2.02226624871116645580e-21;
    constexpr double rest3 = 8.47842766036889956997e-32;
    const double n = nearest(x * two_over_pi);
    const double first = x - n * part1;
    const double second = first - n * part2;
    const double lost2 = (first - second) - n * part2;
    const double third = second - n * part3;
    const double lost3 = (second - third) - n * part3;
    const double tail = lost2 + lost3 - n * rest3;
    const double high = third + tail;
    return {high, (third - high) + tail, static_cast<int>(static_cast<std::int64_t>(n) & 3)};
}

double kernel_sin(double x, double tail)
{
    const double z = x * x;
    const double cube = z * x;
    const double series =
        8.33333333332248946124e-03 +
        z * (-1.98412698298579493134e-04 +
             z * (2.75573137070700676789e-06 +
                  z * (-2.50507602534068634195e-08 + z * 1.58969099521155010221e-10)));
    return x - ((z * (0.5 * tail - cube * series) - tail) - cube * -1.66666666666666324348e-01);
}

double kernel_cos(double x, double tail)
{
    const double z = x * x;
    const double series =
        z * (4.16666666666666019037e-02 +
             z * (-1.38888888888741095749e-03 +
                  z * (2.48015872894767294178e-05 +
                       z * (-2.75573143513906633035e-07 +
                            z * (2.08757232129817482790e-09 + z * -1.13596475577881948265e-11)))));
    const double half = 0.5 * z;
    const double high = 1.0 - half;
    return high + (((1.0 - high) - half) + (z * series - x * tail));
}

double circular(double radians, int phase)
{
    if (!(radians >= -1e6 && radians <= 1e6)) return not_a_number;
    const Reduced r = reduce(radians);
    switch ((r.quadrant + phase) & 3) {
    case 0: return kernel_sin(r.high, r.low);
    case 1: return kernel_cos(r.high, r.low);
    case 2: return -kernel_sin(r.high, r.low);
    default: return -kernel_cos(r.high, r.low);
    }
}

} // namespace

double sin(double radians) { return circular(radians, 0); }

double cos(double radians) { return circular(radians, 1); }

void sines_of_turns(std::span<double> turns)
{
    // The loop has no branch, so that compilers can vectorise it.
    for (double& t : turns) {
        const double halves = nearest(2.0 * t);
        const double odd = halves - 2.0 * nearest(0.5 * halves); // -1, 0 or 1
        const double x = t - 0.5 * halves;                       // exact, |x| <= 1/4
        const double z = x * x;
        const double z2 = z * z;
        // Taylor's series of sin(2 pi x); the next term is below 1e-19.
        const double tail = (1.04229162208139838897e-01 + z * -1.20315859421206271945e-02) +
                            z2 * (1.13092374825179628473e-03 + z * -8.82353359924300568876e-05);
        const double middle = (4.20586939448976551148e+01 + z * -1.50946425768229897102e+01) +
                              z2 * (3.81995258484828204004e+00 + z * -7.18122301778500560232e-01);
        const double head = (6.28318530717958623200e+00 + z * -4.13417022403997620472e+01) +
                            z2 * (8.16052492760750567413e+01 + z * -7.67058597530613894833e+01);
        const double z4 = z2 * z2;
        t = (1.0 - 2.0 * odd * odd) * x * (head + z4 * (middle + z4 * tail));
    }
}

double exp(double x)
{
    if (x != x) return not_a_number;
    if (x > 700.0) return std::numeric_limits<double>::infinity();
    if (x < -700.0) return 0.0;
    // x = n ln2 + high - low, then fdlibm e_exp.c.
    constexpr double log2_of_e = 1.44269504088896338700e+00;
    constexpr double ln2_high = 6.93147180369123816490e-01;
    constexpr double ln2_low = 1.90821492927058770002e-10;
    const double n = nearest(x * log2_of_e);
    const double high = x - n * ln2_high;
    const double low = n * ln2_low;
    const double r = high - low;
    const double z = r * r;
    const double c =
        r - z * (1.66666666666666019037e-01 +
                 z * (-2.77777777770155933842e-03 +
                      z * (6.61375632143793436117e-05 +
                           z * (-1.65339022054652515390e-06 + z * 4.13813679705723846039e-08))));
    const double fraction = 1.0 - ((low - (r * c) / (2.0 - c)) - high);
    const auto exponent = static_cast<std::uint64_t>(static_cast<std::int64_t>(n) + 1023);
    return fraction * std::bit_cast<double>(exponent << 52);
}

double log(double x)
{
    constexpr double infinity = std::numeric_limits<double>::infinity();
    if (!(x > 0.0)) return x == 0.0 ? -infinity : not_a_number;
    if (x == infinity) return infinity;
    std::int64_t exponent = 0;
    if (x < 0x1p-1022) { // subnormal
        x *= 0x1p54;
        exponent = -54;
    }
    // x = 2^exponent (1 + f), sqrt(1/2) < 1 + f < sqrt(2), then fdlibm e_log.c.
    constexpr std::uint64_t sqrt_half = 0x3fe6a09e667f3bcd;
    const std::uint64_t bits = std::bit_cast<std::uint64_t>(x) - sqrt_half;
    const std::int64_t octaves = static_cast<std::int64_t>(bits) >> 52;
    exponent += octaves;
    const double f = std::bit_cast<double>(std::bit_cast<std::uint64_t>(x) -
                                           (static_cast<std::uint64_t>(octaves) << 52)) -
                     1.0;
    constexpr double ln2_high = 6.93147180369123816490e-01;
    constexpr double ln2_low = 1.90821492927058770002e-10;
    const double s = f / (2.0 + f);
    const double z = s * s;
    const double w = z * z;
    const double even = w * (3.999999999940941908e-01 +
                             w * (2.222219843214978396e-01 + w * 1.531383769920937332e-01));
    const double odd = z * (6.666666666666735130e-01 +
                            w * (2.857142874366239149e-01 +
                                 w * (1.818357216161805012e-01 + w * 1.479819860511658591e-01)));
    const double half_square = 0.5 * f * f;
    const auto n = static_cast<double>(exponent);
    return n * ln2_high - ((half_square - (s * (half_square + even + odd) + n * ln2_low)) - f);
}

double log1p(double x)
{
    // A factor restores the part of x that is lost in 1 + x (Hewlett-Packard, HP-15C Advanced
    // Functions Handbook, 1982).
    const double sum = 1.0 + x;
    if (sum == 1.0) return x;
    if (!(sum > 0.0) || sum == std::numeric_limits<double>::infinity()) return log(sum);
    return log(sum) * (x / (sum - 1.0));
}

} // namespace hapnet::base
