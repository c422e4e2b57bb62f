// SPDX-FileCopyrightText: 2026 The Hapnet authors
// SPDX-License-Identifier: MIT
#include "lab/hands/motion.hpp"

#include "lab/metrics/high_pass.hpp"
#include "proto/base/ensure.hpp"

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>
#include <spdlog/fmt/fmt.h>

namespace hapnet::lab::hands {

namespace {

constexpr double butterworth_2 = 0.70710678118654752440; // 1 / (2 sin(pi/4))
constexpr double two_passes = 1.24650470277092690;       // 1 / (sqrt(2) - 1)^(1/4)

/// Returns the slope at sample `i` of the parabola through it and its neighbours; at an end, the
/// slope of the line.
glm::dvec3 slope_at(const std::vector<Sample>& samples, std::size_t i)
{
    const auto slope = [&](std::size_t from, std::size_t to) {
        return (samples[to].place_m - samples[from].place_m) /
               (samples[to].time_s - samples[from].time_s);
    };
    if (i == 0) return slope(0, 1);
    if (i + 1 == samples.size()) return slope(i - 1, i);
    const double before = samples[i].time_s - samples[i - 1].time_s;
    const double after = samples[i + 1].time_s - samples[i].time_s;
    return (after * slope(i - 1, i) + before * slope(i, i + 1)) / (before + after);
}

glm::dvec3 between(const std::vector<Sample>& samples, std::size_t i, double time_s)
{
    const double width = samples[i + 1].time_s - samples[i].time_s;
    const double u = std::clamp((time_s - samples[i].time_s) / width, 0.0, 1.0);
    const double rest = 1.0 - u;
    return (1.0 + 2.0 * u) * rest * rest * samples[i].place_m +
           u * u * (3.0 - 2.0 * u) * samples[i + 1].place_m +
           width * u * rest * (rest * slope_at(samples, i) - u * slope_at(samples, i + 1));
}

/// Filters one coordinate, forward and backward, with its reflections at both ends.
void smooth_axis(Motion& motion, int axis, double cutoff_hertz)
{
    constexpr double periods = 3.0; // periods of the cutoff within which the filter settles
    const auto reach = static_cast<std::size_t>(periods * motion_rate_hz / cutoff_hertz);
    const std::size_t count = motion.size();
    const std::size_t pad = std::min(reach, count - 1);
    const auto at = [&](std::size_t i) { return motion[i][axis]; };
    std::vector<double> line;
    line.reserve(count + 2 * pad);
    for (std::size_t i = pad; i > 0; --i) line.push_back(2.0 * at(0) - at(i));
    for (std::size_t i = 0; i < count; ++i) line.push_back(at(i));
    for (std::size_t i = 1; i <= pad; ++i) line.push_back(2.0 * at(count - 1) - at(count - 1 - i));
    for (int pass = 0; pass < 2; ++pass) {
        auto filter = metrics::second_order_low_pass(
            {two_passes * cutoff_hertz, 1.0 / motion_rate_hz}, butterworth_2);
        filter.settle(line.front());
        for (double& value : line) value = filter.step(value);
        std::ranges::reverse(line);
    }
    for (std::size_t i = 0; i < count; ++i) motion[i][axis] = line[pad + i];
}

/// Rounds to whole nanometres, which are short in a file.
double whole_nm(double metres) { return std::round(metres * 1e9) / 1e9; }

} // namespace

Gaps gaps_in(const Track& track, double from_s, double to_s)
{
    constexpr double rows_max = 1.5;
    Gaps gaps;
    for (std::size_t i = 1; i < track.samples.size(); ++i) {
        const Sample& before = track.samples[i - 1];
        const Sample& after = track.samples[i];
        const double passed = after.time_s - before.time_s;
        if (after.time_s <= from_s || before.time_s >= to_s) continue;
        if (passed <= rows_max / track.rate_hz) continue;
        ++gaps.count;
        gaps.total_s += passed;
        if (passed <= gaps.longest_s) continue;
        gaps.longest_s = passed;
        gaps.line_after_longest = after.line;
        gaps.begin_of_longest_s = before.time_s;
    }
    return gaps;
}

Motion resampled(const Track& track, double from_s, std::size_t count)
{
    base::ensure(track.samples.size() >= 2);
    Motion motion;
    motion.reserve(count);
    std::size_t i = 0;
    for (std::size_t tick = 0; tick < count; ++tick) {
        const double time_s = from_s + static_cast<double>(tick) / motion_rate_hz;
        while (i + 2 < track.samples.size() && track.samples[i + 1].time_s <= time_s) ++i;
        motion.push_back(between(track.samples, i, time_s));
    }
    return motion;
}

void smooth(Motion& motion, double cutoff_hertz)
{
    if (motion.empty()) return;
    for (const int axis : {0, 1, 2}) smooth_axis(motion, axis, cutoff_hertz);
}

double speed_max_of(const Motion& motion)
{
    double most_m = 0.0; // longest distance in one tick
    for (std::size_t i = 1; i < motion.size(); ++i)
        most_m = std::max(most_m, glm::length(motion[i] - motion[i - 1]));
    return most_m * motion_rate_hz;
}

std::string script_text(const Motion& motion)
{
    std::string text = "time_s,x_m,y_m,z_m\n";
    for (std::size_t i = 0; i < motion.size(); ++i) {
        const glm::dvec3& place = motion[i];
        text += fmt::format("{},{},{},{}\n", static_cast<double>(i) / motion_rate_hz,
                            whole_nm(place.x), whole_nm(place.y), whole_nm(place.z));
    }
    return text;
}

} // namespace hapnet::lab::hands
