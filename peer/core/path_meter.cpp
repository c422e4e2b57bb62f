// SPDX-FileCopyrightText: 2026 The Hapnet authors
// SPDX-License-Identifier: MIT
#include "peer/core/path_meter.hpp"

#include <algorithm>

namespace hapnet::peer {

namespace {

std::optional<TimeQuantiles> quantiles_of(const base::DurationHistogram& histogram)
{
    if (histogram.count() == 0) return std::nullopt;
    return TimeQuantiles{
        .p50 = *histogram.quantile(0.5), .p99 = *histogram.quantile(0.99), .max = *histogram.max()};
}

} // namespace

void PathMeter::Delays::add(base::Duration apart, base::Duration ahead)
{
    delay_.add(apart - ahead);
    // Without the clocks: these may be slewed from one to the next.
    if (before_) jitter_.add(std::chrono::abs(apart - *before_));
    before_ = apart;
}

void PathMeter::Delays::report_to(PathReport& report) const
{
    report.delay = quantiles_of(delay_);
    report.jitter = quantiles_of(jitter_);
}

void PathMeter::on_state(const wire::State& state, base::TimePoint arrived,
                         const std::optional<ClockEstimate>& clock)
{
    const std::uint32_t highest_before = highest_;
    if (is_duplicate(state.sequence)) {
        ++duplicates_;
        return;
    }
    ++received_;
    const bool is_newest = state.sequence > highest_before;
    if (!is_newest) ++reordered_;
    if (!clock) {
        in_.pause();
        out_.pause();
        newest_.reset();
        return;
    }
    in_.add(arrived - state.sent, -clock->offset);
    if (!is_newest) return;
    on_newest(state, arrived, -clock->offset);
    if (state.echo) on_echo(*state.echo, state.sent, clock->offset);
}

/// Also remembers it.
bool PathMeter::is_duplicate(std::uint32_t sequence)
{
    if (sequence > highest_) {
        const std::uint32_t missing = sequence - highest_ - 1;
        if (missing >= looks_back) {
            seen_.reset();
        } else {
            for (std::uint32_t i = 1; i <= missing; ++i) seen_.reset((highest_ + i) % looks_back);
        }
        highest_ = sequence;
    } else if (highest_ - sequence >= looks_back) {
        return false;
    } else if (seen_.test(sequence % looks_back)) {
        return true;
    }
    seen_.set(sequence % looks_back);
    return false;
}

void PathMeter::on_newest(const wire::State& state, base::TimePoint arrived, base::Duration ahead)
{
    if (newest_ && arrived > newest_->arrived) {
        const base::Duration held = arrived - newest_->arrived;
        const base::Duration peak = newest_->delay + held;
        age_area_s2_ += base::to_seconds(held) * base::to_seconds(newest_->delay + peak) / 2.0;
        age_time_s_ += base::to_seconds(held);
        age_peak_ = std::max(age_peak_, peak);
    }
    newest_ = Newest{.arrived = arrived, .delay = (arrived - state.sent) - ahead};
}

/// `sent` by them, on their clock, which is `ahead` of ours.
void PathMeter::on_echo(const wire::Echo& echo, base::TimePoint sent, base::Duration ahead)
{
    if (!echoed_) echoed_ = echo.of; // of a hello, it may be, from before the session
    const bool is_new = echo.of > *echoed_;
    if (is_new) {
        echoed_ = echo.of;
        out_.add((sent - echo.age) - echo.of, ahead);
    }
    if (!is_new && ages_there_ == 0) return;
    const base::Duration age = (sent - echo.of) - ahead;
    age_there_s_ += base::to_seconds(age);
    ++ages_there_;
    age_there_peak_ = std::max(age_there_peak_, age);
}

PathsReport PathMeter::report() const
{
    PathsReport report;
    report.arrived.sent = highest_;
    report.arrived.received = received_;
    report.arrived.duplicates = duplicates_;
    report.arrived.reordered = reordered_;
    if (highest_ > 0) {
        const double missing = static_cast<double>(highest_) - static_cast<double>(received_);
        report.arrived.loss = std::max(0.0, missing) / static_cast<double>(highest_);
    }
    in_.report_to(report.in);
    out_.report_to(report.out);
    if (age_time_s_ > 0.0) {
        report.in.age =
            StateAge{.mean = base::from_seconds(age_area_s2_ / age_time_s_), .peak_max = age_peak_};
    }
    if (ages_there_ > 0) {
        report.out.age =
            StateAge{.mean = base::from_seconds(age_there_s_ / static_cast<double>(ages_there_)),
                     .peak_max = age_there_peak_};
    }
    return report;
}

} // namespace hapnet::peer
