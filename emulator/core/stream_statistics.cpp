// SPDX-FileCopyrightText: 2026 The Hapnet authors
// SPDX-License-Identifier: MIT
#include "emulator/core/stream_statistics.hpp"

#include <algorithm>
#include <cmath>

namespace hapnet::emulator {

namespace {

base::Duration nearest_duration(double nanoseconds)
{
    return base::Duration{static_cast<base::Duration::rep>(std::floor(nanoseconds + 0.5))};
}

std::optional<Quantiles> quantiles_of(const base::DurationHistogram& histogram)
{
    if (histogram.count() == 0) return std::nullopt;
    return Quantiles{*histogram.quantile(0.5), *histogram.quantile(0.9), *histogram.quantile(0.99),
                     *histogram.quantile(0.999), *histogram.max()};
}

std::optional<double> ratio(std::uint64_t part, std::uint64_t whole)
{
    if (whole == 0) return std::nullopt;
    return static_cast<double>(part) / static_cast<double>(whole);
}

} // namespace

void StreamTotals::Running::add(base::Duration value)
{
    ++count;
    const double deviation = base::to_nanoseconds(value) - mean;
    mean += deviation / static_cast<double>(count);
    squares += deviation * (base::to_nanoseconds(value) - mean);
}

std::optional<Moments> StreamTotals::Running::moments() const
{
    if (count == 0) return std::nullopt;
    Moments moments{nearest_duration(mean), {}};
    if (count > 1)
        moments.sd = nearest_duration(std::sqrt(squares / static_cast<double>(count - 1)));
    return moments;
}

void StreamStatistics::on_packet(const Fate& fate)
{
    if (!fate.drop) totals_.requested.add(fate.delay);
}

void StreamStatistics::on_sent(const Datagram& datagram, base::TimePoint at)
{
    if (datagram.is_copy) return;
    const Times times{datagram.arrival, at};
    const auto delay = at - datagram.arrival;
    totals_.delay.add(delay);
    totals_.delays.add(delay);
    if (last_) {
        const auto variation = delay - (last_->sent - last_->arrival);
        totals_.variations.add(std::max(variation, -variation));
        const auto gap = at - last_->sent;
        totals_.gaps.add(gap);
        if (gap < clump_gap) ++totals_.clumped;
    }
    last_ = times;
    if (datagram.number >= beyond_highest_) {
        in_order(datagram.number, times);
    } else {
        out_of_order(datagram.number);
    }
    ++departures_;
}

void StreamStatistics::in_order(std::uint64_t number, const Times& times)
{
    if (const auto missing = number - beyond_highest_; missing > 0) {
        ++totals_.missing_runs;
        totals_.missing += missing;
        totals_.missing_run_max = std::max(totals_.missing_run_max, missing);
    }
    beyond_highest_ = number + 1;
    remember({number, departures_});
    if (freshest_) {
        totals_.fresh_time += times.sent - freshest_->sent;
        // Between two updates the age grows by the second every second: a trapezium.
        const auto from = freshest_->sent - freshest_->arrival;
        const auto peak = times.sent - freshest_->arrival;
        totals_.age_area += base::to_nanoseconds(times.sent - freshest_->sent) *
                            base::to_nanoseconds(from + peak) / 2.0;
        totals_.peaks.add(peak);
        totals_.peak_max = std::max(totals_.peak_max, peak);
    }
    freshest_ = times;
}

void StreamStatistics::remember(const Record& record)
{
    records_[recorded_ % records_.size()] = record;
    ++recorded_;
}

/// The first departure with a higher number was an in-order one: all before it had lower numbers
/// than it has.
void StreamStatistics::out_of_order(std::uint64_t number)
{
    const auto at = [&](std::uint64_t rank) -> const Record& {
        return records_[rank % records_.size()];
    };
    const auto oldest = recorded_ - std::min<std::uint64_t>(recorded_, records_.size());
    auto low = oldest;
    auto high = recorded_ - 1; // has a higher number
    while (low < high) {
        const auto middle = low + (high - low) / 2;
        if (at(middle).number > number) {
            high = middle;
        } else {
            low = middle + 1;
        }
    }
    if (low == oldest && oldest > 0) ++totals_.beyond_look_back;
    const auto extent = departures_ - at(low).place;
    ++totals_.reordered;
    totals_.extents += extent;
    totals_.extent_max = std::max(totals_.extent_max, extent);
}

StreamReport StreamTotals::report() const
{
    StreamReport report;
    report.requested_delay = requested.moments();
    report.delay = delay.moments();
    report.delay_quantiles = quantiles_of(delays);
    report.delay_variation = quantiles_of(variations);
    report.gap = quantiles_of(gaps);
    report.clumped_share = ratio(clumped, gaps.count());
    report.missing_runs = missing_runs;
    report.missing_run_mean = ratio(missing, missing_runs);
    report.missing_run_max = missing_run_max;
    report.reordered = reordered;
    report.reorder_extent_mean = ratio(extents, reordered);
    report.reorder_extent_max = extent_max;
    report.beyond_look_back = beyond_look_back;
    if (peaks.count > 0) {
        report.peak_age_mean = peaks.moments()->mean;
        report.peak_age_max = peak_max;
        if (fresh_time > base::Duration{0})
            report.age_mean = nearest_duration(age_area / base::to_nanoseconds(fresh_time));
    }
    return report;
}

} // namespace hapnet::emulator
