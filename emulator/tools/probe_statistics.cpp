// SPDX-FileCopyrightText: 2026 The Hapnet authors
// SPDX-License-Identifier: MIT
#include "emulator/tools/probe_statistics.hpp"

#include "proto/base/ensure.hpp"
#include "proto/base/figures/delay_meter.hpp"
#include "proto/base/figures/moments.hpp"

#include <algorithm>
#include <chrono>
#include <spdlog/fmt/fmt.h>

namespace hapnet::emulator::tools {

namespace {

std::optional<ProbeDelays> delays_of(const base::DurationSample& sample)
{
    const auto quantiles = sample.quantiles();
    if (!quantiles) return std::nullopt;
    base::RunningMoments moments;
    for (const auto value : sample.values()) moments.add(value);
    return ProbeDelays{std::ranges::min(sample.values()), moments.moments()->mean, quantiles->p50,
                       quantiles->p99, quantiles->max};
}

double milliseconds(base::Duration duration) { return 1e3 * base::to_seconds(duration); }

} // namespace

double ProbeSummary::loss() const
{
    return sent == 0 ? 0.0 : static_cast<double>(sent - answered) / static_cast<double>(sent);
}

ProbeMessage ProbeStatistics::next_question(base::TimePoint now)
{
    base::ensure(rows_.size() < questions_max);
    rows_.push_back({.sent = now});
    return {.session = session_, .sequence = rows_.size() - 1, .sent = now};
}

std::optional<ProbeReply> ProbeStatistics::on_answer(const ProbeMessage& answer,
                                                     base::TimePoint arrived)
{
    if (!answer.is_answer || answer.session != session_ || answer.sequence >= rows_.size()) {
        return std::nullopt;
    }
    Row& row = rows_[answer.sequence];
    if (answer.sent != row.sent) return std::nullopt;
    const auto there = answer.received - answer.sent;
    const auto back = arrived - answer.answered;
    if (boot_ == 0 || answer.boot != boot_ || there < base::Duration{0} ||
        back < base::Duration{0}) {
        clocks_are_one_ = false;
    }
    heard_ = std::max(heard_, answer.heard);
    const bool is_copy = row.answers++ > 0;
    answers_.add(answer.sequence, is_copy);
    if (!is_copy) {
        row.there = there;
        row.back = back;
        longest_ = std::max(longest_, there + back);
    }
    return ProbeReply{answer.sequence, there + back, there, back, is_copy};
}

ProbeWay ProbeStatistics::way(base::Duration (*delay)(const Row&), bool is_known) const
{
    base::DelayMeter<base::DurationSample> meter;
    for (const Row& row : rows_) {
        if (row.answers > 0) {
            meter.add(delay(row));
        } else {
            meter.pause();
        }
    }
    ProbeWay way;
    if (is_known) way.delay = delays_of(meter.delays());
    way.ipdv = delays_of(meter.variations());
    return way;
}

ProbeSummary ProbeStatistics::summary() const
{
    const auto [beyond_answered, answered, copies, reordered] = answers_.counts();
    ProbeSummary summary{.sent = rows_.size(),
                         .answered = answered,
                         .copies = copies,
                         .reordered = reordered,
                         .clocks_are_one = clocks_are_one()};
    summary.round_trip = way([](const Row& row) { return row.there + row.back; }, true);
    summary.there = way([](const Row& row) { return row.there; }, clocks_are_one());
    summary.back = way([](const Row& row) { return row.back; }, clocks_are_one());
    // It is not known which questions the other side received after the last one whose answer
    // arrived.
    const auto heard = std::clamp(heard_, answered, beyond_answered);
    summary.there.lost = beyond_answered - heard;
    summary.back.lost = heard - answered;
    summary.unknown = rows_.size() - beyond_answered;
    summary.round_trip.lost = rows_.size() - answered;
    return summary;
}

std::string ProbeStatistics::csv() const
{
    std::string text = "sequence,sent_s,round_trip_ms,there_ms,back_ms,answers\n";
    for (std::size_t i = 0; i < rows_.size(); ++i) {
        const Row& row = rows_[i];
        text += fmt::format("{},{:.9f},", i, base::to_seconds(row.sent - rows_.front().sent));
        if (row.answers > 0) text += fmt::format("{:.6f}", milliseconds(row.there + row.back));
        if (row.answers > 0 && clocks_are_one()) {
            text += fmt::format(",{:.6f},{:.6f}", milliseconds(row.there), milliseconds(row.back));
        } else {
            text += ",,";
        }
        text += fmt::format(",{}\n", row.answers);
    }
    return text;
}

} // namespace hapnet::emulator::tools
