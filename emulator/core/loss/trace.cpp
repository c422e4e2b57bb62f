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

/// Takes the first line off the text, without its end.
std::string_view take_line(std::string_view& text)
{
    const auto end = std::min(text.find('\n'), text.size());
    auto line = text.substr(0, end);
    text.remove_prefix(std::min(end + 1, text.size()));
    if (line.ends_with('\r')) line.remove_suffix(1);
    return line;
}

/// The cell of this column, counted from 0; nullopt when the line is shorter.
std::optional<std::string_view> cell(std::string_view line, std::size_t column)
{
    for (; column > 0; --column) {
        const auto comma = line.find(',');
        if (comma == std::string_view::npos) return std::nullopt;
        line.remove_prefix(comma + 1);
    }
    return line.substr(0, line.find(','));
}

std::optional<std::size_t> column_of(std::string_view header, std::string_view name)
{
    for (std::size_t column = 0;; ++column) {
        const auto comma = header.find(',');
        if (header.substr(0, comma) == name) return column;
        if (comma == std::string_view::npos) return std::nullopt;
        header.remove_prefix(comma + 1);
    }
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

base::Result<LossTrace> parse_loss_table(std::string_view text, const Columns& columns)
{
    const auto named = std::find_if(columns.begin(), columns.end(),
                                    [](const Column& one) { return one.what == "lost"; });
    const std::string name = named == columns.end() ? "lost" : named->name;
    const std::string_view whole = text;
    const auto column = column_of(take_line(text), name);
    if (!column) {
        auto delays = read_trace_rows(whole, Measure::delay, columns);
        if (delays) return trace_of(std::move(delays->lost));
        const bool has_delays = std::any_of(columns.begin(), columns.end(),
                                            [](const Column& one) { return one.what == "delay"; });
        if (has_delays) return tl::unexpected{delays.error()};
        return base::fail(fmt::format("line 1: there is no column named '{}'", shortened(name)));
    }
    std::vector<bool> lost;
    for (std::size_t number = 2; !text.empty(); ++number) {
        const auto value = cell(take_line(text), *column);
        if (value != "0" && value != "1") {
            return base::fail(
                fmt::format("line {}: 'lost' is 0 (arrived) or 1 (lost), nothing else", number));
        }
        if (lost.size() == LossTrace::datagrams_max) return too_long(number);
        lost.push_back(value == "1");
    }
    return trace_of(std::move(lost));
}

base::Result<void> TraceLoss::load(const base::Reading& reading)
{
    const auto named = parse_columns(columns);
    if (!named) return base::fail(fmt::format("columns: {}", named.error().message));
    const auto text = reading.open(file);
    if (!text) return tl::unexpected{text.error()};
    // A table begins with the names of its columns, a plain file with a 0 or 1 or a comment.
    const bool is_table =
        text->find_first_of(",abcdefghijklmnopqrstuvwxyz") < text->find_first_of("01#");
    auto read = is_table ? parse_loss_table(*text, *named) : parse_loss_trace(*text);
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
