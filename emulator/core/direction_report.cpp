// SPDX-FileCopyrightText: 2026 The Hapnet authors
// SPDX-License-Identifier: MIT
#include "emulator/core/direction_report.hpp"

#include "emulator/core/verdict.hpp"

namespace hapnet::emulator {

Distribution distribution_of(const base::DurationHistogram& histogram, double ns_per_unit)
{
    Distribution list;
    for (const auto& [low, high, count] : histogram.filled_bins()) {
        list.push_back({base::to_nanoseconds(low) / ns_per_unit,
                        base::to_nanoseconds(high) / ns_per_unit, static_cast<double>(count)});
    }
    return list;
}

std::optional<DelayReport> StreamShape::delay() const
{
    if (!measured.delay || !measured.delay_quantiles) return std::nullopt;
    return DelayReport{*measured.delay, *measured.delay_quantiles, distribution};
}

std::optional<RegimeReports> regime_reports_of(const Regimes& regimes,
                                               const std::vector<RegimeCourse>& course)
{
    if (regimes.empty() || course.size() != regimes.all.size()) return std::nullopt;
    double whole = 0.0;
    for (const RegimeCourse& one : course) whole += base::to_seconds(one.time);
    RegimeReports reports;
    for (std::size_t i = 0; i < course.size(); ++i) {
        const double share = whole > 0.0 ? base::to_seconds(course[i].time) / whole : 0.0;
        reports.emplace_back(regimes.all[i].name, RegimeReport{share, course[i].stays});
    }
    return reports;
}

std::vector<std::string> DirectionReport::reasons() const
{
    return invalid_because(*statistics, overflowed, budget);
}

TimesReport DirectionReport::times(const base::DurationHistogram& histogram) const
{
    constexpr double ns_per_us = 1e3;
    TimesReport report{.of = &histogram, .distribution = {}};
    if (has_distributions) report.distribution = distribution_of(histogram, ns_per_us);
    return report;
}

std::optional<StreamShape> DirectionReport::lens() const
{
    constexpr double ns_per_ms = 1e6;
    if (stream == nullptr) return std::nullopt;
    StreamShape lens{.measured = stream->report(), .distribution = {}, .over_time = {}};
    if (has_distributions) {
        lens.distribution = distribution_of(stream->delays.delays(), ns_per_ms);
        if (stream->over_time) lens.over_time = stream->over_time->report();
    }
    return lens;
}

} // namespace hapnet::emulator
