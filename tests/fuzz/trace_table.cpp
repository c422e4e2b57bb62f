// SPDX-FileCopyrightText: 2026 The Hapnet authors
// SPDX-License-Identifier: MIT
#include "emulator/core/trace/rows.hpp"
#include "tests/fuzz/fuzz_target.hpp"

#include <algorithm>
#include <spdlog/fmt/fmt.h>
#include <string>

namespace {

using namespace hapnet;
using emulator::Measure;

/// Prints a table in another dialect: tabs, quotes and decimal commas.
std::string printed(const emulator::TraceRows& rows, std::string_view value_name)
{
    const bool has_times = !rows.times.empty();
    std::string text = fmt::format("\"{}\"\t\"{}\"\n", has_times ? "t_ns" : "n", value_name);
    for (std::size_t i = 0; i < rows.values.size(); ++i) {
        auto value = rows.lost[i] ? "lost" : fmt::format("{}", rows.values[i]);
        if (!rows.lost[i]) std::ranges::replace(value, '.', ',');
        const auto time = has_times ? rows.times[i].count() : static_cast<std::int64_t>(i);
        text += fmt::format("\"{}\"\t\"{}\"\r\n", time, value);
    }
    return text;
}

void check(std::string_view text, Measure measure, const emulator::TableFormat& format)
{
    const auto rows = emulator::read_trace_rows(text, measure, format);
    if (!rows) {
        base::ensure(rows.error().message.rfind("line ", 0) == 0);
        return;
    }
    base::ensure(!rows->values.empty() && rows->values.size() == rows->lost.size());
    base::ensure(rows->times.empty() || rows->times.size() == rows->values.size());
    const auto name = measure == Measure::delay  ? "delay_ns"
                      : measure == Measure::loss ? "loss"
                      : measure == Measure::rate ? "rate_bps"
                                                 : "lost";
    const auto again = emulator::read_trace_rows(printed(*rows, name), measure);
    base::ensure(again.has_value());
    base::ensure(again->values == rows->values && again->lost == rows->lost);
    base::ensure(again->times == rows->times);
}

} // namespace

/// The first line names columns. An accepted table reads as the same table when it is printed in
/// another dialect. Errors name a line.
extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size)
{
    std::string bytes;
    for (const std::uint8_t byte : std::span{data, size}) bytes += static_cast<char>(byte);
    const auto end = std::min(bytes.find('\n'), bytes.size());
    const auto format = emulator::parse_format(bytes.substr(0, end));
    const auto text = base::plain_text(bytes.substr(std::min(end + 1, bytes.size())));
    if (!format || !text) {
        base::ensure(!(format ? text.error() : format.error()).message.empty());
        return 0;
    }
    for (const auto measure : {Measure::delay, Measure::loss, Measure::rate, Measure::lost}) {
        check(*text, measure, *format);
        check(*text, measure, {format->columns, std::chrono::milliseconds{10}});
    }
    return 0;
}
