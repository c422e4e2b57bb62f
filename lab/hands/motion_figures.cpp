// SPDX-FileCopyrightText: 2026 The Hapnet authors
// SPDX-License-Identifier: MIT
#include "lab/hands/motion_figures.hpp"

#include "lab/metrics/paired.hpp"
#include "proto/base/ensure.hpp"
#include "proto/base/math.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <glm/geometric.hpp>
#include <numeric>
#include <span>

namespace hapnet::lab::hands {

namespace {

constexpr double mm_per_m = 1e3;
constexpr double spectrum_line_hz = 0.25;  // spacing of the spectrum's spectrum_lines
constexpr std::size_t spectrum_lines = 41; // 0 to 10 Hz
constexpr auto window_length = static_cast<std::size_t>(200); // 4 s
constexpr double slow_share = 0.1;                            // of the speed below

/// The power of a velocity around 0, 0.25, ... 10 Hz, in any unit.
using Spectrum = std::array<double, spectrum_lines>;

/// Adds the power of one axis of a stretch, by Goertzel's algorithm (Am. Math. Monthly 65, 1958).
/// It goes through the stretch once, for all frequencies side by side: none waits for another.
void add_power(Spectrum& spectrum, const Spectrum& twice_cos, std::span<const double> weighted)
{
    Spectrum last{}, before{};
    for (const double value : weighted) {
        for (std::size_t k = 0; k < spectrum_lines; ++k) {
            const double next = value + twice_cos[k] * last[k] - before[k];
            before[k] = last[k];
            last[k] = next;
        }
    }
    for (std::size_t k = 0; k < spectrum_lines; ++k) {
        spectrum[k] +=
            last[k] * last[k] + before[k] * before[k] - twice_cos[k] * last[k] * before[k];
    }
}

/// Returns twice the cosine of what the sine of each frequency turns by from sample to sample.
Spectrum turns_of_lines()
{
    Spectrum twice_cos{};
    for (std::size_t k = 0; k < spectrum_lines; ++k) {
        const double hertz = spectrum_line_hz * static_cast<double>(k);
        twice_cos[k] = 2.0 * base::cos(base::two_pi * hertz / figures_rate_hz);
    }
    return twice_cos;
}

Spectrum spectrum_of(const Places& velocities)
{
    const std::size_t length = std::min(window_length, velocities.size());
    static const Spectrum twice_cos = turns_of_lines();
    Spectrum spectrum{};
    std::vector<double> weighted(length), weights(length);
    for (std::size_t i = 0; i < length; ++i) {
        const double turn =
            base::two_pi * (static_cast<double>(i) + 0.5) / static_cast<double>(length);
        weights[i] = 0.5 * (1.0 - base::cos(turn));
    }
    const std::size_t last = velocities.size() - length; // where the last window begins
    const std::size_t steps = (2 * last + length - 1) / length;
    for (std::size_t step = 0; step <= steps; ++step) {
        const std::size_t from = steps == 0 ? 0 : last * step / steps;
        for (const int axis : {0, 1, 2}) {
            for (std::size_t i = 0; i < length; ++i)
                weighted[i] = velocities[from + i][axis] * weights[i];
            add_power(spectrum, twice_cos, weighted);
        }
    }
    spectrum.front() *= 0.5; // only half of its band is above 0
    return spectrum;
}

/// Returns the frequency below which a share of the power is. The power of a line is spread evenly
/// over its band.
double hertz_below(const Spectrum& spectrum, double share)
{
    double left = share * std::accumulate(spectrum.begin(), spectrum.end(), 0.0);
    for (std::size_t k = 0; k < spectrum_lines; ++k) {
        const double low = std::max(0.0, (static_cast<double>(k) - 0.5) * spectrum_line_hz);
        const double high = (static_cast<double>(k) + 0.5) * spectrum_line_hz;
        if (left <= spectrum.at(k))
            return spectrum.at(k) > 0.0 ? low + (high - low) * left / spectrum.at(k) : low;
        left -= spectrum.at(k);
    }
    return (static_cast<double>(spectrum_lines) - 0.5) * spectrum_line_hz;
}

glm::dvec3 spread_of(const Places& places)
{
    const auto count = static_cast<double>(places.size());
    glm::dvec3 mean{0.0}, squares{0.0};
    for (const glm::dvec3& place : places) mean += place / count;
    for (const glm::dvec3& place : places) squares += (place - mean) * (place - mean) / count;
    return glm::dvec3{std::sqrt(squares.x), std::sqrt(squares.y), std::sqrt(squares.z)};
}

} // namespace

Places sampled(const Motion& motion)
{
    constexpr auto step = static_cast<std::size_t>(motion_rate_hz / figures_rate_hz);
    Places places;
    for (std::size_t i = 0; i < motion.size(); i += step) places.push_back(motion[i]);
    return places;
}

MotionFigures figures_of(const Places& places)
{
    base::ensure(places.size() >= 3);
    Places velocities;
    std::vector<double> speeds;
    double squares = 0.0;
    for (std::size_t i = 1; i < places.size(); ++i) {
        velocities.push_back((places[i] - places[i - 1]) * figures_rate_hz);
        speeds.push_back(glm::length(velocities.back()));
        squares += speeds.back() * speeds.back();
    }
    const auto count = static_cast<double>(speeds.size());
    const double slow = slow_share * metrics::quantile_of(speeds, 0.95);
    std::size_t peaks = 0, slow_times = 0;
    for (std::size_t i = 0; i < speeds.size(); ++i) {
        slow_times += speeds[i] <= slow ? 1U : 0U;
        const bool is_inner = i > 0 && i + 1 < speeds.size();
        if (is_inner && speeds[i] > slow && speeds[i] > speeds[i - 1] && speeds[i] >= speeds[i + 1])
            ++peaks;
    }
    const Spectrum spectrum = spectrum_of(velocities);
    const glm::dvec3 spread = mm_per_m * spread_of(places);
    return {.spread_x_mm = spread.x,
            .spread_y_mm = spread.y,
            .spread_z_mm = spread.z,
            .speed_mm_s = mm_per_m * std::sqrt(squares / count),
            .speed_max_mm_s = mm_per_m * *std::ranges::max_element(speeds),
            .half_power_hz = hertz_below(spectrum, 0.5),
            .most_power_hz = hertz_below(spectrum, 0.9),
            .peaks_per_s = static_cast<double>(peaks) * figures_rate_hz / count,
            .rest_share = static_cast<double>(slow_times) / count};
}

} // namespace hapnet::lab::hands
