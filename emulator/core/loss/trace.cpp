// SPDX-FileCopyrightText: 2026 The Hapnet authors
// SPDX-License-Identifier: MIT
#include "emulator/core/loss/trace.hpp"

#include "proto/base/ensure.hpp"

#include <algorithm>
#include <optional>
#include <spdlog/fmt/fmt.h>
#include <utility>

namespace hapnet::emulator {

namespace {

/// Removes and returns the first line of the text, without its end.
std::string_view take_line(std::string_view& text)
{
    const auto end = std::min(text.find('\n'), text.size());
    auto line = text.substr(0, end);
    text.remove_prefix(std::min(end + 1, text.size()));
    if (line.ends_with('\r')) line.remove_suffix(1);
    return line;
}

base::Result<LossTrace> trace_of(std::vector<bool> lost)
{
    if (lost.empty()) return base::fail("a trace of losses with no datagram in it");
    return LossTrace{std::move(lost)};
}

auto too_long(std::size_t line)
{
    return base::fail(fmt::format("line {}: more than {} datagrams in a trace of losses", line,
                                  LossTrace::datagrams_max));
}

} // namespace

LossTrace::LossTrace(std::vector<bool> lost)
    : lost_{std::move(lost)},
      losses_{static_cast<std::size_t>(std::count(lost_.begin(), lost_.end(), true))}
{
    base::ensure(!lost_.empty() && lost_.size() <= datagrams_max);
}

base::Result<LossTrace> parse_loss_trace(std::string_view text)
{
    std::vector<bool> lost;
    for (std::size_t number = 1; !text.empty(); ++number) {
        const std::string_view line = take_line(text);
        for (const char c : line.substr(0, line.find('#'))) {
            if (c == ' ' || c == '\t') continue;
            if (c != '0' && c != '1') {
                return base::fail(fmt::format(
                    "line {}: a trace of losses holds 0 (arrived) and 1 (lost) only", number));
            }
            if (lost.size() == LossTrace::datagrams_max) return too_long(number);
            lost.push_back(c == '1');
        }
    }
    return trace_of(std::move(lost));
}

base::Result<LossTrace> parse_loss_table(std::string_view text, const TableFormat& format)
{
    const auto rows = read_trace_rows(text, Measure::lost, format);
    if (rows) {
        std::vector<bool> lost;
        for (const double one : rows->values) lost.push_back(one != 0.0);
        return trace_of(std::move(lost));
    }
    auto delays = read_trace_rows(text, Measure::delay, format);
    if (delays) return trace_of(std::move(delays->lost));
    const bool has_delays = std::ranges::any_of(
        format.columns, [](const base::Column& column) { return column.what == "delay"; });
    return tl::unexpected{has_delays ? delays.error() : rows.error()};
}

base::Result<void> TraceLoss::load(const base::Reading& reading)
{
    const auto format = parse_format(columns);
    if (!format) return tl::unexpected{format.error()};
    const auto text = base::open_measured(reading, file);
    if (!text) return tl::unexpected{text.error()};
    // A table begins with the names of its columns, a plain file with a 0 or 1 or a comment.
    const bool is_table = !columns.empty() || text->find_first_of(",abcdefghijklmnopqrstuvwxyz") <
                                                  text->find_first_of("01#");
    auto read = is_table ? parse_loss_table(*text, *format) : parse_loss_trace(*text);
    if (!read) return tl::unexpected{reading.trouble_in(file, read.error().message)};
    trace = std::make_shared<const LossTrace>(*std::move(read));
    return {};
}

base::Result<void> TraceLoss::validate() const
{
    if (trace) return {};
    return base::fail("the trace of losses was not read");
}

LossTheory TraceLoss::theory(const Arrivals& /*arrivals*/) const
{
    base::ensure(trace != nullptr);
    return theory_of_period(trace->size(), [&](std::size_t i) { return trace->is_lost(i); });
}

std::vector<LossProperty> TraceLoss::properties(const RunFacts& facts) const
{
    return {same_losses(*this, facts.count)};
}

bool operator==(const TraceLoss& a, const TraceLoss& b)
{
    if (a.file != b.file || a.columns != b.columns) return false;
    return a.trace == b.trace || (a.trace && b.trace && *a.trace == *b.trace);
}

void TraceLoss::Model::change(const TraceLoss& law, const base::RandomStream& /*stream*/)
{
    base::ensure(law.trace != nullptr);
    trace_ = law.trace;
}

} // namespace hapnet::emulator
