// SPDX-FileCopyrightText: 2026 The Hapnet authors
// SPDX-License-Identifier: MIT
#include "emulator/tools/probe_statistics.hpp"

#include "proto/base/ensure.hpp"

#include <algorithm>
#include <cmath>
#include <spdlog/fmt/fmt.h>

namespace hapnet::emulator::tools {

namespace {

/// Of values in no order; sorts them.
std::optional<ProbeDelays> delays_of(std::vector<base::Duration>& values)
{
    if (values.empty()) return std::nullopt;
    std::ranges::sort(values);
    const auto quantile = [&](double q) {
        const auto rank = std::ceil(q * static_cast<double>(values.size()));
        return values[static_cast<std::size_t>(rank) - 1];
    };
    double sum = 0;
    for (const auto value : values) sum += base::to_seconds(value);
    const auto mean = base::from_seconds(sum / static_cast<double>(values.size()));
    return ProbeDelays{values.front(), mean, quantile(0.5), quantile(0.99), values.back()};
}

double milliseconds(base::Duration duration) { return 1e3 * base::to_seconds(duration); }

} // namespace

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
    if (is_copy) {
        ++copies_;
    } else {
        row.there = there;
        row.back = back;
        ++answered_;
        if (answer.sequence + 1 < beyond_answered_) ++reordered_;
        beyond_answered_ = std::max(beyond_answered_, answer.sequence + 1);
        longest_ = std::max(longest_, there + back);
    }
    return ProbeReply{answer.sequence, there + back, there, back, is_copy};
}

ProbeWay ProbeStatistics::way(base::Duration (*delay)(const Row&), bool is_known) const
{
    std::vector<base::Duration> delays;
    std::vector<base::Duration> differences;
    const Row* before = nullptr;
    for (const Row& row : rows_) {
        const bool is_answered = row.answers > 0;
        if (is_answered) delays.push_back(delay(row));
        if (is_answered && before != nullptr) {
            differences.push_back(std::chrono::abs(delay(row) - delay(*before)));
        }
        before = is_answered ? &row : nullptr;
    }
    ProbeWay way;
    if (is_known) way.delay = delays_of(delays);
    way.ipdv = delays_of(differences);
    return way;
}

ProbeSummary ProbeStatistics::summary() const
{
    ProbeSummary summary{.sent = rows_.size(),
                         .answered = answered_,
                         .copies = copies_,
                         .reordered = reordered_,
                         .clocks_are_one = clocks_are_one()};
    summary.round_trip = way([](const Row& row) { return row.there + row.back; }, true);
    summary.there = way([](const Row& row) { return row.there; }, clocks_are_one());
    summary.back = way([](const Row& row) { return row.back; }, clocks_are_one());
    // What the other side has heard beyond the last question that was answered is not known.
    const auto heard = std::clamp(heard_, answered_, beyond_answered_);
    summary.there.lost = beyond_answered_ - heard;
    summary.back.lost = heard - answered_;
    summary.unknown = rows_.size() - beyond_answered_;
    summary.round_trip.lost = rows_.size() - answered_;
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
