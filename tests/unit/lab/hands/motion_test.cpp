// SPDX-FileCopyrightText: 2026 The Hapnet authors
// SPDX-License-Identifier: MIT
#include "lab/hands/motion.hpp"

#include <cmath>
#include <gtest/gtest.h>
#include <numbers>

namespace hapnet::lab::hands {
namespace {

constexpr double pi = std::numbers::pi;

Track sine(double hertz, double rate_hz, double length_s)
{
    Track track;
    track.rate_hz = rate_hz;
    for (std::size_t i = 0; static_cast<double>(i) <= length_s * rate_hz; ++i) {
        const double t = static_cast<double>(i) / rate_hz;
        track.samples.push_back({t, glm::dvec3{std::sin(2.0 * pi * hertz * t), 0.0, t}, i + 2});
    }
    track.rows = track.samples.size();
    return track;
}

/// The amplitude of a sine and its lag, over whole periods in the middle.
struct Response {
    double gain = 0.0;
    double lag_s = 0.0;
};

Response response_of(const Motion& motion, double hertz)
{
    double in_phase = 0.0, off_phase = 0.0;
    const std::size_t from = 2000, count = 4000;
    for (std::size_t i = from; i < from + count; ++i) {
        const double angle = 2.0 * pi * hertz * static_cast<double>(i) / 1000.0;
        in_phase += motion[i].x * std::sin(angle) * 2.0 / static_cast<double>(count);
        off_phase += motion[i].x * std::cos(angle) * 2.0 / static_cast<double>(count);
    }
    return {std::hypot(in_phase, off_phase), -std::atan2(off_phase, in_phase) / (2.0 * pi * hertz)};
}

TEST(Resampling, KeepsWhatTheRecordingHolds)
{
    const auto motion = resampled(sine(6.0, 120.0, 8.0), 0.0, 8000);
    const auto six = response_of(motion, 6.0);
    EXPECT_NEAR(six.gain, 1.0, 2e-3);
    EXPECT_NEAR(six.lag_s, 0.0, 1e-6);
    EXPECT_NEAR(motion[1234].z, 1.234, 1e-9); // even growth stays even
}

TEST(Smoothing, HalvesThePowerAtItsCutoffWithoutDelay)
{
    for (const auto& [hertz, gain] : {std::pair{1.0, 0.999}, {6.0, 0.7071}, {24.0, 0.0102}}) {
        auto motion = resampled(sine(hertz, 1000.0, 8.0), 0.0, 8000);
        smooth(motion, 6.0);
        const auto found = response_of(motion, hertz);
        // |H|^2 of both passes: 1 / (1 + (f / (1.2465 fc))^4), without the bilinear warping.
        const double expected = 1.0 / (1.0 + std::pow(hertz / (6.0 * 1.24650470277), 4.0));
        EXPECT_NEAR(found.gain, expected, 2e-3) << hertz;
        EXPECT_NEAR(found.gain, gain, 2e-3) << hertz;
        EXPECT_NEAR(found.lag_s, 0.0, 1e-5) << hertz;
    }
}

TEST(Smoothing, LeavesARampAndItsEndsWhereTheyAre)
{
    Motion ramp;
    for (int i = 0; i < 3000; ++i) ramp.emplace_back(0.5, 1e-4 * i, -2e-4 * i);
    auto smoothed = ramp;
    smooth(smoothed, 6.0);
    for (std::size_t i = 0; i < ramp.size(); ++i)
        for (const int axis : {0, 1, 2}) EXPECT_NEAR(smoothed[i][axis], ramp[i][axis], 1e-6) << i;
}

TEST(Smoothing, TakesMotionsOfAnyLength)
{
    Motion none, one{glm::dvec3{1.0}}, two{glm::dvec3{1.0}, glm::dvec3{1.0}};
    smooth(none, 6.0);
    smooth(one, 6.0);
    smooth(two, 6.0);
    EXPECT_NEAR(one[0].x, 1.0, 1e-12);
    EXPECT_NEAR(two[1].x, 1.0, 1e-12);
}

TEST(Gaps, AreLongerThanOneAndAHalfRowsWithinTheStretch)
{
    Track track = sine(1.0, 100.0, 1.0);
    track.samples.erase(track.samples.begin() + 20, track.samples.begin() + 25); // 60 ms
    track.samples.erase(track.samples.begin() + 60);                             // 20 ms
    const auto gaps = gaps_in(track, 0.0, 1.0);
    EXPECT_EQ(gaps.count, 2U);
    EXPECT_NEAR(gaps.longest_s, 0.06, 1e-12);
    EXPECT_NEAR(gaps.total_s, 0.08, 1e-12);
    EXPECT_EQ(gaps.line_after_longest, 27U);
    EXPECT_EQ(gaps_in(track, 0.3, 1.0).count, 1U);
    EXPECT_EQ(gaps_in(sine(1.0, 100.0, 1.0), 0.0, 1.0).count, 0U);
}

TEST(Speed, IsTheHighestBetweenNeighbours)
{
    EXPECT_NEAR(speed_max_of({glm::dvec3{0.0}, glm::dvec3{3e-3, 4e-3, 0.0}, glm::dvec3{3e-3}}), 5.0,
                1e-9);
    EXPECT_EQ(speed_max_of({glm::dvec3{1.0}}), 0.0);
}

} // namespace
} // namespace hapnet::lab::hands
