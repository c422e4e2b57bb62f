// SPDX-FileCopyrightText: 2026 The Hapnet authors
// SPDX-License-Identifier: MIT
#include "peer/core/path_meter.hpp"

#include <algorithm>

namespace hapnet::peer {

void PathMeter::on_state(const wire::State& state, base::TimePoint arrived,
                         const std::optional<ClockEstimate>& clock)
{
    using Arrival = base::ArrivalCounter::Arrival;
    const bool is_duplicate = numbers_.add(state.sequence) == base::Seen::yes;
    const Arrival arrival = arrivals_.add(state.sequence, is_duplicate);
    if (arrival == Arrival::duplicate) return;
    if (!clock) {
        in_.pause();
        out_.pause();
        age_.pause();
        return;
    }
    in_.add(arrived - state.sent, -clock->offset);
    if (arrival == Arrival::reordered) return;
    on_newest(state, arrived, -clock->offset);
    if (state.echo) on_echo(*state.echo, state.sent, clock->offset);
}

void PathMeter::on_newest(const wire::State& state, base::TimePoint arrived, base::Duration ahead)
{
    // Among states that arrive at the same time, only the newest has an age.
    if (age_.newest_arrived() >= arrived) age_.pause();
    age_.add(arrived, (arrived - state.sent) - ahead);
}

/// `sent` is on the other peer's clock, which is `ahead` of this peer's.
void PathMeter::on_echo(const wire::Echo& echo, base::TimePoint sent, base::Duration ahead)
{
    if (!echoed_) echoed_ = echo.of; // may be the echo of a hello from before the session
    const bool is_new = echo.of > *echoed_;
    if (is_new) {
        echoed_ = echo.of;
        out_.add((sent - echo.age) - echo.of, ahead);
    }
    if (!is_new && ages_there_.count() == 0) return;
    const base::Duration age = (sent - echo.of) - ahead;
    ages_there_.add(age);
    age_there_peak_ = std::max(age_there_peak_, age);
}

PathsReport PathMeter::report() const
{
    const auto path_of = [](const DelayMeter& meter) {
        return PathReport{meter.delays().quantiles(), meter.variations().quantiles(), {}};
    };
    PathsReport report{arrivals_.counts(), {}, path_of(in_), path_of(out_)};
    if (const auto sent = static_cast<double>(report.arrived.sent); sent > 0.0) {
        // Duplicates that arrived too late to be detected count as received.
        const double missing = sent - static_cast<double>(report.arrived.received);
        report.loss = std::max(0.0, missing) / sent;
    }
    report.in.age = age_.age();
    if (const auto ages = ages_there_.moments()) {
        report.out.age = {.mean = ages->mean, .peak_mean = {}, .peak_max = age_there_peak_};
    }
    return report;
}

} // namespace hapnet::peer
