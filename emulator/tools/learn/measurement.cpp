// SPDX-FileCopyrightText: 2026 The Hapnet authors
// SPDX-License-Identifier: MIT
#include "emulator/tools/learn/measurement.hpp"

#include <algorithm>
#include <charconv>
#include <cmath>
#include <spdlog/fmt/fmt.h>
#include <utility>

namespace hapnet::emulator::tools {

namespace {

/// The number that follows `key` in a line.
std::optional<double> number_after(std::string_view line, std::string_view key)
{
    const auto place = line.find(key);
    if (place == std::string_view::npos) return std::nullopt;
    const auto rest = line.substr(place + key.size());
    double number = 0.0;
    const auto [end, error] = std::from_chars(rest.begin(), rest.end(), number);
    if (error != std::errc{} || end == rest.begin() || !std::isfinite(number)) return std::nullopt;
    return number;
}

/// Lines of ping, one after the other.
class Ping {
public:
    [[nodiscard]] base::Result<void> add(std::string_view line)
    {
        if (line.find(" packets transmitted") != std::string_view::npos) return add_summary(line);
        const auto sequence = number_after(line, "icmp_seq=");
        const auto time = number_after(line, "time=");
        if (!sequence || !time || line.find("(DUP!)") != std::string_view::npos) return {};
        if (*sequence < 0 || *sequence > 65'535 || *sequence != std::floor(*sequence)) {
            return base::fail("icmp_seq must be a whole number from 0 to 65535");
        }
        if (*time < 0 || *time > 1e9) return base::fail("time must be from 0 to 10^9 ms");
        return add_answer(static_cast<std::size_t>(*sequence), *time);
    }

    [[nodiscard]] base::Result<Measurement> finished()
    {
        if (answers_ == 0) return base::fail("no line has icmp_seq= and time=: nothing answered");
        if (!has_zero_ && !way_.delays.empty()) { // ping of iputils counts from 1
            way_.delays.erase(way_.delays.begin());
            way_.lost.erase(way_.lost.begin());
        }
        if (transmitted_ > way_.delays.size() && transmitted_ <= trace_rows_max) {
            way_.delays.resize(transmitted_);
            way_.lost.resize(transmitted_, true);
        }
        Measurement measurement;
        if (duration_ms_ > 0.0 && transmitted_ > 1) {
            const double spacing_ns = 1e6 * duration_ms_ / static_cast<double>(transmitted_ - 1);
            measurement.spacing = base::Duration{std::llround(spacing_ns)};
        }
        measurement.down = std::move(way_);
        return measurement;
    }

private:
    [[nodiscard]] base::Result<void> add_answer(std::size_t sequence, double time_ms)
    {
        // The numbers have 16 bits, and begin again.
        constexpr std::size_t wraps_at = 65'536;
        sequence += newest_ / wraps_at * wraps_at;
        if (sequence + wraps_at / 2 < newest_) sequence += wraps_at;
        if (sequence >= trace_rows_max) return base::fail(std::string{too_many_values});
        if (sequence >= way_.delays.size()) {
            way_.delays.resize(sequence + 1);
            way_.lost.resize(sequence + 1, true);
        }
        has_zero_ = has_zero_ || sequence == 0;
        if (answers_ > 0 && sequence < newest_) ++way_.reordered;
        newest_ = std::max(newest_, sequence);
        way_.delays[sequence] = base::Duration{std::llround(1e6 * time_ms)};
        way_.lost[sequence] = false;
        ++answers_;
        return {};
    }

    /// "100 packets transmitted, 98 received, 2% packet loss, time 99123ms"
    [[nodiscard]] base::Result<void> add_summary(std::string_view line)
    {
        const auto number = number_after(line, "");
        if (!number || *number < 0 || *number > 1e9) return base::fail("no number of packets");
        transmitted_ = static_cast<std::size_t>(*number);
        duration_ms_ = std::clamp(number_after(line, "time ").value_or(0.0), 0.0, 1e12);
        return {};
    }

    MeasuredWay way_;
    std::size_t answers_ = 0;
    std::size_t newest_ = 0;
    bool has_zero_ = false;
    std::size_t transmitted_ = 0;
    double duration_ms_ = 0.0;
};

base::Result<Measurement> read_ping(std::string_view text)
{
    Ping ping;
    LineReader lines{text};
    while (const auto line = lines.next()) {
        if (const auto added = ping.add(*line); !added) return lines.fail(added.error().message);
    }
    auto measurement = ping.finished();
    if (!measurement) return lines.fail(measurement.error().message);
    return measurement;
}

MeasuredWay way_of(TraceRows rows) { return {rows.delays(), std::move(rows.lost), 0}; }

std::optional<base::Duration> spacing_of(const TraceRows& rows)
{
    if (rows.times.size() < 2) return std::nullopt;
    return rows.times.back() / static_cast<base::Duration::rep>(rows.times.size() - 1);
}

/// sequence,sent_s,round_trip_ms,there_ms,back_ms,answers; the ways are empty where the ends have
/// two clocks.
base::Result<Measurement> read_probe(std::string_view text)
{
    const auto column = [&](const std::string& name) {
        return read_trace_rows(text, Measure::delay, {{"time", "sent_s", ""}, {"delay", name, ""}});
    };
    auto round_trip = column("round_trip_ms");
    if (!round_trip) return tl::unexpected{round_trip.error()};
    Measurement measurement{.spacing = spacing_of(*round_trip)};
    auto there = column("there_ms");
    auto back = column("back_ms");
    if (!there || !back) {
        measurement.down = way_of(*std::move(round_trip));
        return measurement;
    }
    measurement.up = way_of(*std::move(there));
    measurement.down = way_of(*std::move(back));
    return measurement;
}

} // namespace

base::Result<Measurement> read_measurement(std::string_view text, const Columns& columns)
{
    const auto first = LineReader{text}.next().value_or("");
    if (first.starts_with("PING ")) return read_ping(text);
    const bool is_probe = columns.empty() && first.starts_with("sequence,") &&
                          first.find(",round_trip_ms,") != std::string_view::npos;
    if (is_probe) return read_probe(text);
    auto rows = read_trace_rows(text, Measure::delay, columns);
    if (!rows) return tl::unexpected{rows.error()};
    Measurement measurement{.spacing = spacing_of(*rows)};
    measurement.down = way_of(*std::move(rows));
    return measurement;
}

} // namespace hapnet::emulator::tools
