// SPDX-FileCopyrightText: 2026 The Hapnet authors
// SPDX-License-Identifier: MIT
#include "emulator/core/loss/timed_trace.hpp"

#include "proto/base/ensure.hpp"

#include <algorithm>
#include <optional>
#include <spdlog/fmt/fmt.h>
#include <utility>

namespace hapnet::emulator {

LossSeries::LossSeries(std::vector<double> shares, std::vector<base::Duration> times)
    : shares_{std::move(shares)}, axis_{std::move(times)}
{
    base::ensure(shares_.size() == axis_.size());
}

double LossSeries::at(base::Duration time, Interpolation way, bool repeats) const
{
    const TimeAxis::Place place = axis_.place(time, repeats);
    const double share = shares_[place.index];
    if (way == Interpolation::step) return share;
    return share + (shares_[place.next] - share) * place.progress;
}

base::Result<LossSeries> parse_loss_series(std::string_view text, const TableFormat& format)
{
    auto rows = read_trace_rows(text, Measure::loss, format);
    if (!rows) {
        auto delays = read_trace_rows(text, Measure::delay, format);
        if (!delays || delays->times.empty()) return tl::unexpected{rows.error()};
        rows = std::move(delays);
        for (std::size_t i = 0; i < rows->values.size(); ++i) {
            rows->values[i] = rows->lost[i] ? 1.0 : 0.0;
        }
    }
    if (rows->times.empty()) {
        return base::fail(std::string{without_times});
    }
    return LossSeries{std::move(rows->values), std::move(rows->times)};
}

base::Result<void> TimedTraceLoss::load(const base::Reading& reading)
{
    const auto format = parse_format(columns, timing.slot);
    if (!format) return tl::unexpected{format.error()};
    const auto text = base::open_measured(reading, file);
    if (!text) return tl::unexpected{text.error()};
    auto read = parse_loss_series(*text, *format);
    if (!read) return tl::unexpected{reading.trouble_in(file, read.error().message)};
    trace = std::make_shared<const LossSeries>(*std::move(read));
    return {};
}

base::Result<void> TimedTraceLoss::validate() const
{
    if (!trace) return base::fail("the trace of losses was not read");
    if (timing.offset < base::Duration{0}) return base::fail("offset must not be negative");
    return {};
}

LossTheory TimedTraceLoss::theory(const Arrivals& arrivals) const
{
    base::ensure(trace != nullptr);
    // More arrivals do not change the result visibly.
    const auto count = std::min<std::uint64_t>(arrivals.count, 1'000'000);
    double losses = 0.0;
    double both = 0.0;
    double variance = 0.0;
    double before = 0.0;
    base::Duration at = timing.offset;
    for (std::uint64_t i = 0; i < count; ++i, at += arrivals.spacing) {
        const double share = trace->at(at, interpolate, timing.repeat);
        losses += share;
        both += share * before;
        variance += share * (1.0 - share);
        before = share;
    }
    const auto n = static_cast<double>(count);
    LossTheory theory = theory_from_pairs(losses / n, both / n);
    const double alike = losses * (1.0 - losses / n); // variance of independent losses
    theory.variance_inflation = alike > 0.0 ? variance / alike : 0.0;
    return theory;
}

std::vector<LossProperty> TimedTraceLoss::properties(const RunFacts& /*facts*/) const
{
    return {Untestable{"losses depend on arrival times, which fates do not record"}};
}

bool operator==(const TimedTraceLoss& a, const TimedTraceLoss& b)
{
    const bool is_same = a.file == b.file && a.columns == b.columns &&
                         a.interpolate == b.interpolate && a.timing == b.timing;
    if (!is_same) return false;
    return a.trace == b.trace || (a.trace && b.trace && *a.trace == *b.trace);
}

TimedTraceLoss::Model::Model(const TimedTraceLoss& law, const base::RandomStream& /*stream*/)
    : trace_{law.trace}, interpolate_{law.interpolate}, clock_{law.timing}
{
    base::ensure(trace_ != nullptr);
}

bool TimedTraceLoss::Model::on_packet(const Packet& packet, const base::RandomStream& stream)
{
    const auto time = clock_.on_packet(packet.at);
    return stream.uniform(packet.number) < trace_->at(time, interpolate_, clock_.timing().repeat);
}

void TimedTraceLoss::Model::change(const TimedTraceLoss& law, const base::RandomStream& stream)
{
    const bool is_same = law.trace == trace_ && law.timing == clock_.timing();
    if (!is_same) *this = Model{law, stream};
    interpolate_ = law.interpolate;
}

} // namespace hapnet::emulator
