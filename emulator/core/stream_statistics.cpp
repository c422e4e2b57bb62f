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

void StreamStatistics::Running::add(base::Duration value)
{
    ++count;
    const double deviation = base::to_nanoseconds(value) - mean;
    mean += deviation / static_cast<double>(count);
    squares += deviation * (base::to_nanoseconds(value) - mean);
}

std::optional<Moments> StreamStatistics::Running::moments() const
{
    if (count == 0) return std::nullopt;
    Moments moments{nearest_duration(mean), {}};
    if (count > 1)
        moments.sd = nearest_duration(std::sqrt(squares / static_cast<double>(count - 1)));
    return moments;
}

void StreamStatistics::on_packet(const Fate& fate)
{
    if (!fate.drop) requested_.add(fate.delay);
}

void StreamStatistics::on_sent(const Datagram& datagram, base::TimePoint at)
{
    if (datagram.is_copy) return;
    const Times times{datagram.arrival, at};
    const auto delay = at - datagram.arrival;
    delay_.add(delay);
    delays_.add(delay);
    if (last_) {
        const auto variation = delay - (last_->sent - last_->arrival);
        variations_.add(std::max(variation, -variation));
        const auto gap = at - last_->sent;
        gaps_.add(gap);
        if (gap < clump_gap) ++clumped_;
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
        ++missing_runs_;
        missing_ += missing;
        missing_run_max_ = std::max(missing_run_max_, missing);
    }
    beyond_highest_ = number + 1;
    remember({number, departures_});
    if (!freshest_) {
        first_fresh_ = times;
    } else {
        // Between two updates the age grows by the second every second: a trapezium.
        const auto from = freshest_->sent - freshest_->arrival;
        const auto peak = times.sent - freshest_->arrival;
        age_area_ += base::to_nanoseconds(times.sent - freshest_->sent) *
                     base::to_nanoseconds(from + peak) / 2.0;
        peaks_.add(peak);
        peak_max_ = std::max(peak_max_, peak);
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
    if (low == oldest && oldest > 0) ++beyond_look_back_;
    const auto extent = departures_ - at(low).place;
    ++reordered_;
    extents_ += extent;
    extent_max_ = std::max(extent_max_, extent);
}

StreamReport StreamStatistics::report() const
{
    StreamReport report;
    report.requested_delay = requested_.moments();
    report.delay = delay_.moments();
    report.delay_quantiles = quantiles_of(delays_);
    report.delay_variation = quantiles_of(variations_);
    report.gap = quantiles_of(gaps_);
    report.clumped_share = ratio(clumped_, gaps_.count());
    report.missing_runs = missing_runs_;
    report.missing_run_mean = ratio(missing_, missing_runs_);
    report.missing_run_max = missing_run_max_;
    report.reordered = reordered_;
    report.reorder_extent_mean = ratio(extents_, reordered_);
    report.reorder_extent_max = extent_max_;
    report.beyond_look_back = beyond_look_back_;
    if (peaks_.count > 0) {
        report.peak_age_mean = peaks_.moments()->mean;
        report.peak_age_max = peak_max_;
        const auto time = freshest_->sent - first_fresh_->sent;
        if (time > base::Duration{0})
            report.age_mean = nearest_duration(age_area_ / base::to_nanoseconds(time));
    }
    return report;
}

} // namespace hapnet::emulator
