// SPDX-FileCopyrightText: 2026 The Hapnet authors
// SPDX-License-Identifier: MIT
#include "proto/base/figures/age.hpp"

#include "tests/property/proto/base/figures/random_arrivals.hpp"

#include <gtest/gtest.h>

namespace hapnet::base {
namespace {

using namespace std::chrono_literals;

/// The send time of the newest datagram that has arrived by then, or of the first `count` arrivals.
TimePoint newest_by(const std::vector<RandomArrival>& arrivals, TimePoint time, std::size_t count)
{
    TimePoint newest = TimePoint::min();
    for (std::size_t i = 0; i < arrivals.size(); ++i) {
        const bool is_there = i < count && arrivals[i].arrived <= time;
        if (is_there) newest = std::max(newest, arrivals[i].sent);
    }
    return newest;
}

/// Times are whole milliseconds, and the age is linear within each, so its mean there is its middle
/// value.
double mean_ms(const std::vector<RandomArrival>& arrivals, TimePoint from, TimePoint to)
{
    double sum = 0.0;
    for (TimePoint at = from; at < to; at += 1ms) {
        const TimePoint middle = at + 500us;
        sum += 1e3 * to_seconds(middle - newest_by(arrivals, middle, arrivals.size()));
    }
    return sum / (1e3 * to_seconds(to - from));
}

TEST(AgeMeter, MeasuresWhatALookAtEveryMillisecondFinds)
{
    std::size_t measured = 0;
    for (std::uint64_t seed = 1; seed <= 40; ++seed) {
        SCOPED_TRACE(seed);
        const auto arrivals = without_copies(random_arrivals(seed, 0));
        AgeMeter meter;
        std::vector<Duration> peaks;
        TimePoint last{};
        for (std::size_t i = 0; i < arrivals.size(); ++i) {
            if (!is_in_order(arrivals, i)) continue;
            last = arrivals[i].arrived;
            if (i > 0) peaks.push_back(last - newest_by(arrivals, last, i));
            meter.add(last, last - arrivals[i].sent);
        }
        const Age age = meter.age();
        ASSERT_EQ(age.peak_max.has_value(), !peaks.empty());
        if (peaks.empty()) continue;
        EXPECT_EQ(age.peak_max, std::ranges::max(peaks));
        Duration sum{};
        for (const Duration peak : peaks) sum += peak;
        // One rounding to a whole nanosecond.
        EXPECT_NEAR(to_nanoseconds(*age.peak_mean),
                    to_nanoseconds(sum) / static_cast<double>(peaks.size()), 0.6);
        const TimePoint from = arrivals.front().arrived;
        ASSERT_EQ(age.mean.has_value(), last > from);
        if (!age.mean) continue;
        EXPECT_NEAR(1e-6 * to_nanoseconds(*age.mean), mean_ms(arrivals, from, last), 1e-6);
        ++measured;
    }
    EXPECT_GT(measured, 30U);
}

} // namespace
} // namespace hapnet::base
