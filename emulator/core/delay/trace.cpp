// SPDX-FileCopyrightText: 2026 The Hapnet authors
// SPDX-License-Identifier: MIT
#include "emulator/core/delay/trace.hpp"

#include "proto/base/ensure.hpp"
#include "proto/base/ramp.hpp"

#include <algorithm>
#include <cmath>
#include <spdlog/fmt/fmt.h>
#include <utility>

namespace hapnet::emulator {

namespace {

/// Returns each value with its share; a linearly interpolated part is divided into 16 steps.
std::vector<TraceLaw::Step> pieces_of(const TraceLaw& law)
{
    const auto& delays = law.trace->delays();
    const bool is_linear = law.interpolate == Interpolation::linear && delays.size() > 1;
    constexpr int parts = 16;
    std::vector<TraceLaw::Step> pieces;
    for (std::size_t i = 0; i < delays.size(); ++i) {
        if (!is_linear) {
            pieces.push_back({delays[i], law.trace->share(i)});
            continue;
        }
        const std::size_t after_last = law.timing.repeat ? 0 : i;
        const auto next = delays[i + 1 < delays.size() ? i + 1 : after_last];
        for (int part = 0; part < parts; ++part) {
            pieces.push_back({*base::between(delays[i], next, (part + 0.5) / parts),
                              law.trace->share(i) / parts});
        }
    }
    return pieces;
}

} // namespace

DelayTrace::DelayTrace(std::vector<base::Duration> delays) : delays_{std::move(delays)}
{
    base::ensure(!delays_.empty());
}

DelayTrace::DelayTrace(std::vector<base::Duration> delays, std::vector<base::Duration> times)
    : delays_{std::move(delays)}, axis_{std::move(times)}
{
    base::ensure(delays_.size() == axis_->size());
}

base::Duration DelayTrace::of(std::uint64_t number, bool repeats) const
{
    base::ensure(!axis_);
    const std::uint64_t size = delays_.size();
    return delays_[repeats ? number % size : std::min(number, size - 1)];
}

base::Duration DelayTrace::at(base::Duration time, Interpolation way, bool repeats) const
{
    base::ensure(axis_.has_value());
    const TimeAxis::Place place = axis_->place(time, repeats);
    const base::Duration value = delays_[place.index];
    if (way == Interpolation::step) return value;
    return *base::between(value, delays_[place.next], place.progress);
}

double DelayTrace::share(std::size_t index) const
{
    base::ensure(index < delays_.size());
    return axis_ ? axis_->share(index) : 1.0 / static_cast<double>(delays_.size());
}

base::Result<void> TraceLaw::load(const base::Reading& reading)
{
    const auto format = parse_format(columns, timing.slot);
    if (!format) return tl::unexpected{format.error()};
    const auto text = base::open_measured(reading, file);
    if (!text) return tl::unexpected{text.error()};
    auto read = parse_delay_trace(*text, *format);
    if (!read) return tl::unexpected{reading.trouble_in(file, read.error().message)};
    trace = *std::move(read);
    return {};
}

base::Result<void> TraceLaw::validate() const
{
    base::ensure(trace != nullptr);
    if (trace->is_by_time()) {
        return require(timing.offset >= base::Duration{0}, "offset must not be negative");
    }
    const bool is_in_time = timing.offset != base::Duration{0} || timing.start != TraceStart::run ||
                            interpolate != Interpolation::step;
    return require(!is_in_time, "offset, start and interpolate need a column of times, or a slot: "
                                "this trace has a value for each datagram");
}

LawMoments TraceLaw::moments() const
{
    const auto all = pieces_of(*this);
    double mean = 0.0;
    for (const Step& one : all) mean += one.share * base::to_nanoseconds(one.delay);
    double variance = 0.0;
    for (const Step& one : all) {
        const double distance = base::to_nanoseconds(one.delay) - mean;
        variance += one.share * distance * distance;
    }
    return {rounded(mean), rounded(std::sqrt(variance))};
}

std::vector<TraceLaw::Step> TraceLaw::steps() const
{
    std::vector<Step> steps = pieces_of(*this);
    const auto by_delay = [](const Step& a, const Step& b) { return a.delay < b.delay; };
    std::sort(steps.begin(), steps.end(), by_delay);
    double sum = 0.0;
    for (Step& step : steps) {
        sum += step.share;
        step.share = std::min(sum, 1.0);
    }
    steps.back().share = 1.0;
    return steps;
}

bool operator==(const TraceLaw& a, const TraceLaw& b)
{
    const bool is_same = a.file == b.file && a.columns == b.columns &&
                         a.interpolate == b.interpolate && a.timing == b.timing;
    if (!is_same) return false;
    return a.trace == b.trace || (a.trace && b.trace && *a.trace == *b.trace);
}

TraceLaw::Sampler::Sampler(const TraceLaw& law)
    : trace_{law.trace}, interpolate_{law.interpolate}, clock_{law.timing}
{
    base::ensure(trace_ != nullptr);
}

void TraceLaw::Sampler::change(const TraceLaw& law)
{
    const bool is_same = law.trace == trace_ && law.timing == clock_.timing();
    if (!is_same) *this = Sampler{law};
    interpolate_ = law.interpolate;
}

base::Result<std::shared_ptr<const DelayTrace>> parse_delay_trace(std::string_view text,
                                                                  const TableFormat& format)
{
    auto rows = read_trace_rows(text, Measure::delay, format);
    if (!rows) return base::fail(rows.error().message);
    if (rows->times.empty()) return std::make_shared<const DelayTrace>(rows->delays());
    return std::make_shared<const DelayTrace>(rows->delays(), std::move(rows->times));
}

} // namespace hapnet::emulator
