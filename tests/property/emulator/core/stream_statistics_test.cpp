// SPDX-FileCopyrightText: 2026 The Hapnet authors
// SPDX-License-Identifier: MIT
#include "emulator/core/stream_statistics.hpp"

#include "proto/base/random.hpp"
#include "tests/unit/emulator/core/passage.hpp"

#include <algorithm>
#include <cmath>
#include <gtest/gtest.h>
#include <vector>

namespace hapnet::emulator {
namespace {

using namespace std::chrono_literals;

/// A 1 kHz stream, part of it lost, part of it copied, with jitter that reorders most of it.
std::vector<Passage> random_log(std::uint64_t seed)
{
    const auto stream = base::Seed{seed}.stream("log");
    const double jitter = seed % 2 == 0 ? 15e6 : 0.5e6; // ns
    std::vector<Passage> log;
    for (std::uint64_t n = 0; n < 3'000; ++n) {
        if (stream.uniform(n) < 0.1) continue;
        const base::TimePoint arrival{1h + n * 1ms};
        const auto delay =
            20ms + base::Duration{static_cast<std::int64_t>(stream.uniform(n, 1) * jitter)};
        log.push_back({n, arrival, arrival + delay, false});
        if (stream.uniform(n, 2) < 0.05) log.push_back({n, arrival, arrival + delay + 3ms, true});
    }
    std::stable_sort(log.begin(), log.end(),
                     [](const Passage& a, const Passage& b) { return a.sent < b.sent; });
    return log;
}

std::vector<Passage> originals_of(const std::vector<Passage>& log)
{
    std::vector<Passage> originals;
    std::copy_if(log.begin(), log.end(), std::back_inserter(originals),
                 [](const Passage& passage) { return !passage.is_copy; });
    return originals;
}

double mean_of(const std::vector<double>& values)
{
    double sum = 0;
    for (const double value : values) sum += value;
    return sum / static_cast<double>(values.size());
}

double sd_of(const std::vector<double>& values)
{
    const double mean = mean_of(values);
    double squares = 0;
    for (const double value : values) squares += (value - mean) * (value - mean);
    return std::sqrt(squares / static_cast<double>(values.size() - 1));
}

/// Expects quantiles within the bins of the histogram.
void expect_quantiles(const std::optional<base::Quantiles>& quantiles, std::vector<double> values)
{
    ASSERT_TRUE(quantiles);
    std::sort(values.begin(), values.end());
    const auto exact = [&](double q) {
        return values[static_cast<std::size_t>(std::ceil(q * static_cast<double>(values.size()))) -
                      1];
    };
    const auto expect = [&](base::Duration measured, double q) {
        const auto ns = static_cast<double>(measured.count());
        EXPECT_NEAR(ns, exact(q), exact(q) / 64) << q;
        EXPECT_GE(ns, values.front()) << q;
        EXPECT_LE(ns, values.back()) << q;
    };
    expect(quantiles->p50, 0.5);
    expect(quantiles->p90, 0.9);
    expect(quantiles->p99, 0.99);
    expect(quantiles->p999, 0.999);
    EXPECT_EQ(static_cast<double>(quantiles->max.count()), values.back());
}

void expect_near(std::optional<base::Duration> measured, double nanoseconds)
{
    ASSERT_TRUE(measured);
    // One rounding to a whole nanosecond, and sums of 3000 doubles.
    EXPECT_NEAR(static_cast<double>(measured->count()), nanoseconds, 0.6);
}

void expect_times(const StreamReport& report, const std::vector<Passage>& log)
{
    std::vector<double> delays;
    std::vector<double> variations;
    std::vector<double> gaps;
    for (std::size_t i = 0; i < log.size(); ++i) {
        delays.push_back(static_cast<double>((log[i].sent - log[i].arrival).count()));
        if (i == 0) continue;
        variations.push_back(std::abs(delays[i] - delays[i - 1]));
        gaps.push_back(static_cast<double>((log[i].sent - log[i - 1].sent).count()));
    }
    expect_near(report.delay->mean, mean_of(delays));
    expect_near(report.delay->sd, sd_of(delays));
    expect_quantiles(report.delay_quantiles, delays);
    expect_quantiles(report.delay_variation, variations);
    expect_quantiles(report.gap, gaps);
    const auto clumped =
        std::count_if(gaps.begin(), gaps.end(), [](double gap) { return gap < 50e3; });
    EXPECT_EQ(report.clumped_share,
              static_cast<double>(clumped) / static_cast<double>(gaps.size()));
}

void expect_order(const StreamReport& report, const std::vector<Passage>& log)
{
    std::vector<double> extents;
    std::vector<double> runs;
    std::uint64_t expected = 0;
    for (std::size_t i = 0; i < log.size(); ++i) {
        const auto overtaker =
            std::find_if(log.begin(), log.begin() + static_cast<long>(i),
                         [&](const Passage& one) { return one.number > log[i].number; });
        const auto extent = i - static_cast<std::size_t>(overtaker - log.begin());
        if (extent > 0) {
            extents.push_back(static_cast<double>(extent));
            continue;
        }
        if (log[i].number > expected) {
            runs.push_back(static_cast<double>(log[i].number - expected));
        }
        expected = log[i].number + 1;
    }
    EXPECT_EQ(report.missing_runs.count, runs.size());
    EXPECT_NEAR(report.missing_runs.mean().value(), mean_of(runs), 1e-9);
    EXPECT_EQ(static_cast<double>(report.missing_runs.max),
              *std::max_element(runs.begin(), runs.end()));
    EXPECT_EQ(report.reordered.count, extents.size());
    EXPECT_EQ(report.beyond_look_back, 0U);
    if (extents.empty()) return;
    EXPECT_NEAR(report.reordered.mean().value(), mean_of(extents), 1e-9);
    EXPECT_EQ(static_cast<double>(report.reordered.max),
              *std::max_element(extents.begin(), extents.end()));
}

/// By definition, the age at t is t minus the newest arrival of datagrams sent before t.
void expect_age(const StreamReport& report, const std::vector<Passage>& log)
{
    double area = 0;
    std::vector<double> peaks;
    base::TimePoint newest = log.front().arrival;
    base::TimePoint last_fresh = log.front().sent;
    double area_until_fresh = 0;
    for (std::size_t i = 1; i < log.size(); ++i) {
        const auto before = static_cast<double>((log[i - 1].sent - newest).count());
        const auto after = static_cast<double>((log[i].sent - newest).count());
        area += (after * after - before * before) / 2;
        if (log[i].arrival < newest) continue;
        peaks.push_back(after);
        newest = log[i].arrival;
        last_fresh = log[i].sent;
        area_until_fresh = area;
    }
    const auto time = static_cast<double>((last_fresh - log.front().sent).count());
    expect_near(report.age.mean, area_until_fresh / time);
    expect_near(report.age.peak_mean, mean_of(peaks));
    expect_near(report.age.peak_max, *std::max_element(peaks.begin(), peaks.end()));
}

TEST(StreamStatistics, EqualsAnOfflineComputationFromTheCompleteLog)
{
    for (std::uint64_t seed = 1; seed <= 4; ++seed) {
        SCOPED_TRACE(seed);
        const auto log = random_log(seed);
        StreamStatistics measured;
        for (const Passage& passage : log) note(measured, passage);
        const auto originals = originals_of(log);
        expect_times(measured.report(), originals);
        expect_order(measured.report(), originals);
        expect_age(measured.report(), originals);
    }
}

} // namespace
} // namespace hapnet::emulator
