// SPDX-FileCopyrightText: 2026 The Hapnet authors
// SPDX-License-Identifier: MIT
#include "emulator/core/delay/trace.hpp"

#include "emulator/core/delay/rows.hpp"
#include "proto/base/ensure.hpp"

#include <algorithm>
#include <cmath>
#include <functional>
#include <spdlog/fmt/fmt.h>
#include <utility>

namespace hapnet::emulator {

DelayTrace::DelayTrace(std::vector<base::Duration> delays) : delays_{std::move(delays)}
{
    base::ensure(!delays_.empty());
}

DelayTrace::DelayTrace(std::vector<base::Duration> delays, std::vector<base::Duration> times)
    : delays_{std::move(delays)}, times_{std::move(times)}
{
    base::ensure(!delays_.empty() && delays_.size() == times_.size());
    base::ensure(times_.front() == base::Duration{0});
    base::ensure(std::is_sorted(times_.begin(), times_.end(), std::less_equal{}));
    if (times_.size() == 1) return;
    period_ = times_.back() + (times_.back() - times_[times_.size() - 2]);
}

base::Duration DelayTrace::at(const Packet& packet) const
{
    if (times_.empty()) return delays_[packet.number % delays_.size()];
    if (period_ == base::Duration{0}) return delays_.front();
    const auto time = std::max(packet.at, base::Duration{0}) % period_;
    const auto next = std::upper_bound(times_.begin(), times_.end(), time);
    return delays_[static_cast<std::size_t>(next - times_.begin()) - 1];
}

double DelayTrace::share(std::size_t index) const
{
    base::ensure(index < delays_.size());
    if (period_ == base::Duration{0}) return 1.0 / static_cast<double>(delays_.size());
    const auto end = index + 1 < times_.size() ? times_[index + 1] : period_;
    return static_cast<double>((end - times_[index]).count()) /
           static_cast<double>(period_.count());
}

base::Result<void> TraceLaw::load(const base::Reading& reading)
{
    const auto text = reading.open(file);
    if (!text) return tl::unexpected{text.error()};
    auto read = parse_delay_trace(*text);
    if (!read) return base::fail(fmt::format("{}: {}", file, read.error().message));
    trace = *std::move(read);
    return {};
}

base::Result<void> TraceLaw::validate() const
{
    base::ensure(trace != nullptr);
    return {};
}

LawMoments TraceLaw::moments() const
{
    const auto& delays = trace->delays();
    double mean = 0.0;
    for (std::size_t i = 0; i < delays.size(); ++i) {
        mean += trace->share(i) * base::to_nanoseconds(delays[i]);
    }
    double variance = 0.0;
    for (std::size_t i = 0; i < delays.size(); ++i) {
        const double distance = base::to_nanoseconds(delays[i]) - mean;
        variance += trace->share(i) * distance * distance;
    }
    return {rounded(mean), rounded(std::sqrt(variance))};
}

std::vector<TraceLaw::Step> TraceLaw::steps() const
{
    const auto& delays = trace->delays();
    std::vector<Step> steps;
    for (std::size_t i = 0; i < delays.size(); ++i) steps.push_back({delays[i], trace->share(i)});
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
    if (a.file != b.file) return false;
    return a.trace == b.trace || (a.trace && b.trace && *a.trace == *b.trace);
}

TraceLaw::Sampler::Sampler(const TraceLaw& law) : trace_{law.trace}
{
    base::ensure(trace_ != nullptr);
}

base::Result<std::shared_ptr<const DelayTrace>> parse_delay_trace(std::string_view text)
{
    auto rows = read_delay_rows(text);
    if (!rows) return base::fail(rows.error().message);
    if (rows->times.empty()) return std::make_shared<const DelayTrace>(std::move(rows->delays));
    return std::make_shared<const DelayTrace>(std::move(rows->delays), std::move(rows->times));
}

} // namespace hapnet::emulator
