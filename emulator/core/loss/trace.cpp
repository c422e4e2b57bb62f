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

constexpr std::size_t pattern_max = 1'000'000;

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

base::Result<LossTrace> parse_loss_table(std::string_view text)
{
    const auto column = column_of(take_line(text), "lost");
    if (!column) return base::fail("line 1: there is no column named 'lost'");
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

base::Result<std::vector<bool>> parse_pattern(std::string_view text)
{
    if (text.empty() || text.find_first_not_of("01") != std::string_view::npos) {
        return base::fail(
            "a pattern is written as 0 (passes) and 1 (lost), such as \"0010\" for every fourth");
    }
    if (text.size() > pattern_max) {
        return base::fail(fmt::format("a pattern of more than {} digits", pattern_max));
    }
    std::vector<bool> pattern;
    for (const char c : text) pattern.push_back(c == '1');
    return pattern;
}

std::string to_text(const std::vector<bool>& pattern)
{
    std::string text;
    for (const bool is_lost : pattern) text += is_lost ? '1' : '0';
    return text;
}

} // namespace hapnet::emulator
