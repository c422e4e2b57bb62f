// SPDX-FileCopyrightText: 2026 The Hapnet authors
// SPDX-License-Identifier: MIT
#include "emulator/core/trace/rate_trace.hpp"

#include "emulator/core/delay/bounds.hpp"
#include "proto/base/ensure.hpp"
#include "proto/base/text.hpp"

#include <algorithm>
#include <cmath>
#include <functional>
#include <iterator>
#include <limits>
#include <spdlog/fmt/fmt.h>
#include <utility>

namespace hapnet::emulator {

namespace {

constexpr Work work_per_opportunity = Opportunities::bytes_each * work_per_byte;
constexpr Work most_work = Work{1} << 63U;

Work product(std::uint64_t rate, base::Duration time)
{
    const auto nanoseconds = static_cast<std::uint64_t>(time.count());
    if (rate != 0 && nanoseconds > most_work / rate) return most_work;
    return rate * nanoseconds;
}

/// Returns the work of a number of opportunities, limited to the most that a line ever needs.
Work work_of(std::uint64_t opportunities)
{
    return std::min(opportunities, most_work / work_per_opportunity) * work_per_opportunity;
}

Work sum(Work a, Work b) { return a > most_work - b ? most_work : a + b; }

base::Result<RateTrace> parse_opportunities(std::string_view text)
{
    constexpr auto most = static_cast<std::uint64_t>(longest_delay / std::chrono::milliseconds{1});
    std::vector<Opportunities::Moment> moments;
    base::LineReader lines{text};
    while (const auto line = lines.next()) {
        const auto ms = base::parse_count(*line, most);
        if (!ms) {
            return lines.fail(fmt::format("'{}' is not a time in whole milliseconds, as Mahimahi "
                                          "has them; a table begins with the names of its columns",
                                          base::shortened(*line)));
        }
        const base::Duration time = std::chrono::milliseconds{*ms};
        if (!moments.empty() && time < moments.back().at) {
            return lines.fail(fmt::format("{} ms is earlier than the line before", *ms));
        }
        if (moments.empty() || moments.back().at != time) {
            if (moments.size() == trace_rows_max) {
                return lines.fail("more than 10000000 different times: cut the file");
            }
            moments.push_back({time, moments.empty() ? 0 : moments.back().count});
        }
        ++moments.back().count;
    }
    if (moments.empty() || moments.back().at == base::Duration{0}) {
        return lines.fail("the file ends without an opportunity later than 0 ms");
    }
    return RateTrace{Opportunities{std::move(moments)}};
}

} // namespace

Opportunities::Opportunities(std::vector<Moment> moments) : moments_{std::move(moments)}
{
    base::ensure(!moments_.empty() && moments_.front().at >= base::Duration{0});
    base::ensure(moments_.front().count > 0 && moments_.back().at > base::Duration{0});
    base::ensure(std::ranges::is_sorted(moments_, std::ranges::less_equal{}, &Moment::at));
    base::ensure(std::ranges::is_sorted(moments_, std::ranges::less_equal{}, &Moment::count));
    moments_.shrink_to_fit();
}

/// Returns the number of opportunities up to and including a time.
std::uint64_t Opportunities::count(base::Duration until, bool repeats) const
{
    const auto rounds = repeats ? static_cast<std::uint64_t>(until / period()) : 0;
    const auto rest = repeats ? until % period() : until;
    const auto after = std::ranges::upper_bound(moments_, rest, {}, &Moment::at);
    return rounds * each_round() + (after == moments_.begin() ? 0 : std::prev(after)->count);
}

std::optional<Completion> Opportunities::finish(base::Duration from, Work work, bool repeats) const
{
    if (work == 0) return Completion{from, 0};
    const auto before = count(from, repeats);
    // The number of the last opportunity that the work uses.
    const auto last = before + (work - 1) / work_per_opportunity;
    const auto round = static_cast<base::Duration::rep>(last / each_round());
    if (round > 0 && !repeats) return std::nullopt;
    const auto moment = std::ranges::upper_bound(moments_, last % each_round(), {}, &Moment::count);
    const auto at = round * period() + moment->at;
    return Completion{at, work_of(count(at, repeats) - before) - work};
}

Work Opportunities::sent(base::Duration from, base::Duration to, bool repeats) const
{
    return work_of(count(to, repeats) - count(from, repeats));
}

double Opportunities::mean_rate() const
{
    const auto bits = static_cast<double>(8 * bytes_each * each_round());
    return bits / base::to_seconds(period());
}

RateSteps::RateSteps(std::vector<std::uint64_t> rates, std::vector<base::Duration> times)
    : rates_{std::move(rates)}, axis_{std::move(times)}
{
    base::ensure(rates_.size() == axis_.size());
    base::ensure(std::any_of(rates_.begin(), rates_.end(), [](auto rate) { return rate > 0; }));
    for (std::size_t i = 0; i < rates_.size() && axis_.size() > 1; ++i) {
        per_period_ = sum(per_period_, product(rates_[i], axis_.end(i) - axis_.begin(i)));
    }
}

RateSteps::Segment RateSteps::segment(base::Duration time, bool repeats) const
{
    const std::size_t index = axis_.place(time, repeats).index;
    const bool is_last = index + 1 == axis_.size();
    if (axis_.size() == 1 || (is_last && !repeats)) return {rates_[index], std::nullopt};
    return {rates_[index], axis_.end(index) - time % axis_.period()};
}

std::optional<Completion> RateSteps::finish(base::Duration from, Work work, bool repeats) const
{
    // Skips whole periods first, because a slow line may need many.
    if (repeats && per_period_ > 0 && work > per_period_) {
        const auto rounds = (work - 1) / per_period_;
        constexpr auto never = static_cast<std::uint64_t>(longest_delay.count());
        if (rounds > never / static_cast<std::uint64_t>(axis_.period().count())) {
            return std::nullopt;
        }
        work -= rounds * per_period_;
        from += static_cast<base::Duration::rep>(rounds) * axis_.period();
    }
    while (work > 0) {
        const auto [rate, left] = segment(from, repeats);
        if (!left && rate == 0) return std::nullopt;
        if (!left || work <= product(rate, *left)) {
            const Work nanoseconds = work / rate + (work % rate != 0 ? 1 : 0);
            const auto passed = static_cast<base::Duration::rep>(nanoseconds);
            return Completion{from + base::Duration{passed}, nanoseconds * rate - work};
        }
        work -= product(rate, *left);
        from += *left;
    }
    return Completion{from, 0};
}

Work RateSteps::sent(base::Duration from, base::Duration to, bool repeats) const
{
    Work work = 0;
    if (repeats && axis_.size() > 1 && to - from > axis_.period()) {
        const auto rounds = static_cast<std::uint64_t>((to - from) / axis_.period());
        if (per_period_ > most_work / rounds) return most_work;
        work = rounds * per_period_;
        from += static_cast<base::Duration::rep>(rounds) * axis_.period();
    }
    while (from < to) {
        const auto [rate, left] = segment(from, repeats);
        const auto length = left ? std::min(*left, to - from) : to - from;
        work = sum(work, product(rate, length));
        from += length;
    }
    return work;
}

double RateSteps::mean_rate() const
{
    double mean = 0.0;
    for (std::size_t i = 0; i < rates_.size(); ++i) {
        mean += axis_.share(i) * static_cast<double>(rates_[i]);
    }
    return mean;
}

RateTrace::RateTrace(std::variant<Opportunities, RateSteps> trace) : trace_{std::move(trace)} {}

std::optional<Completion> RateTrace::finish(base::Duration from, Work work, bool repeats) const
{
    return std::visit([&](const auto& trace) { return trace.finish(from, work, repeats); }, trace_);
}

Work RateTrace::sent(base::Duration from, base::Duration to, bool repeats) const
{
    return std::visit([&](const auto& trace) { return trace.sent(from, to, repeats); }, trace_);
}

double RateTrace::mean_rate() const
{
    return std::visit([](const auto& trace) { return trace.mean_rate(); }, trace_);
}

base::Duration RateTrace::period() const
{
    return std::visit([](const auto& trace) { return trace.period(); }, trace_);
}

base::Result<RateTrace> parse_rate_trace(std::string_view text, const TableFormat& format)
{
    base::LineReader lines{text};
    const auto first = lines.next();
    const bool is_plain = format.columns.empty() && format.slot == base::Duration{0};
    if (is_plain && first && first->find_first_not_of("0123456789") == std::string_view::npos) {
        return parse_opportunities(text);
    }
    auto rows = read_trace_rows(text, Measure::rate, format);
    if (!rows) return tl::unexpected{rows.error()};
    if (rows->times.empty()) {
        return base::fail(std::string{without_times});
    }
    std::vector<std::uint64_t> rates;
    for (const double rate : rows->values) {
        rates.push_back(static_cast<std::uint64_t>(std::llround(rate)));
    }
    const bool is_any = std::any_of(rates.begin(), rates.end(), [](auto rate) { return rate > 0; });
    if (!is_any) return base::fail("line 2: nothing would ever pass: each rate is 0");
    return RateTrace{RateSteps{std::move(rates), std::move(rows->times)}};
}

base::Result<void> RateTraceLaw::load(const base::Reading& reading)
{
    const auto format = parse_format(columns, timing.slot);
    if (!format) return tl::unexpected{format.error()};
    const auto text = base::open_measured(reading, file);
    if (!text) return tl::unexpected{text.error()};
    auto read = parse_rate_trace(*text, *format);
    if (!read) return tl::unexpected{reading.trouble_in(file, read.error().message)};
    trace = std::make_shared<const RateTrace>(*std::move(read));
    return {};
}

base::Result<void> RateTraceLaw::validate() const
{
    if (!trace) return base::fail("the trace of rates was not read");
    return require(timing.offset >= base::Duration{0}, "offset must not be negative");
}

bool operator==(const RateTraceLaw& a, const RateTraceLaw& b)
{
    if (a.file != b.file || a.columns != b.columns || a.timing != b.timing) return false;
    return a.trace == b.trace || (a.trace && b.trace && *a.trace == *b.trace);
}

} // namespace hapnet::emulator
