// SPDX-FileCopyrightText: 2026 The Hapnet authors
// SPDX-License-Identifier: MIT
#include "emulator/tools/learn/measurement.hpp"

#include "emulator/tools/learn/captures.hpp"
#include "emulator/tools/learn/irtt.hpp"

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
        if (duration_ms_ > 0.0 && transmitted_ > 1) {
            const double spacing_ns = 1e6 * duration_ms_ / static_cast<double>(transmitted_ - 1);
            way_.spacing = base::Duration{std::llround(spacing_ns)};
        }
        return Measurement{.round_trip = std::move(way_)};
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

MeasuredWay way_of(const TraceRows& rows)
{
    MeasuredWay way;
    const auto delays = rows.delays();
    for (std::size_t i = 0; i < delays.size(); ++i) way.add(delays[i], rows.lost[i]);
    if (rows.times.size() > 1) {
        way.spacing = rows.times.back() / static_cast<base::Duration::rep>(rows.times.size() - 1);
    }
    return way;
}

/// sequence,sent_s,round_trip_ms,there_ms,back_ms,answers; the ways are empty where the ends have
/// two clocks.
base::Result<Measurement> read_probe(std::string_view text)
{
    const auto column = [&](const std::string& name) {
        return read_trace_rows(text, Measure::delay, {{"time", "sent_s", ""}, {"delay", name, ""}});
    };
    const auto round_trip = column("round_trip_ms");
    if (!round_trip) return tl::unexpected{round_trip.error()};
    const auto there = column("there_ms");
    const auto back = column("back_ms");
    if (!there || !back) return Measurement{.round_trip = way_of(*round_trip)};
    return Measurement{.up = way_of(*there), .down = way_of(*back), .mixes_losses = true};
}

/// The delays that are known.
std::vector<base::Duration> delays_of(const std::optional<MeasuredWay>& way)
{
    std::vector<base::Duration> delays;
    if (!way) return delays;
    for (const auto& delay : way->delays) {
        if (delay) delays.push_back(*delay);
    }
    return delays;
}

void shift(MeasuredWay& way, base::Duration by)
{
    for (auto& delay : way.delays) {
        if (delay) *delay += by;
    }
}

/// One after the other, as they were measured.
void append(MeasuredWay& way, const MeasuredWay& later)
{
    way.delays.insert(way.delays.end(), later.delays.begin(), later.delays.end());
    way.lost.insert(way.lost.end(), later.lost.begin(), later.lost.end());
    way.reordered += later.reordered;
    const bool is_alike = way.spacing && later.spacing && *later.spacing < 2 * *way.spacing &&
                          *way.spacing < 2 * *later.spacing;
    way.spacing = is_alike ? std::optional{(*way.spacing + *later.spacing) / 2} : std::nullopt;
}

/// False when it is of other ways.
bool append(Measurement& measurement, const Measurement& later)
{
    for (const auto way : {&Measurement::round_trip, &Measurement::up, &Measurement::down}) {
        auto& own = measurement.*way;
        if (own.has_value() != (later.*way).has_value()) return false;
        if (own) append(*own, *(later.*way));
    }
    measurement.mixes_losses = measurement.mixes_losses || later.mixes_losses;
    measurement.remarks.insert(measurement.remarks.end(), later.remarks.begin(),
                               later.remarks.end());
    return true;
}

base::Result<Measurement> read_captures(std::span<const MeasuredFile* const> files)
{
    if (files.size() > 2) {
        return base::fail(
            fmt::format("{}: a third capture: give one, or those of both ends", files[2]->name));
    }
    std::vector<Capture> captures;
    for (const MeasuredFile* file : files) {
        auto capture = read_capture(file->bytes);
        if (!capture) return base::fail(fmt::format("{}: {}", file->name, capture.error().message));
        captures.push_back(*std::move(capture));
    }
    auto measured = captures.size() == 1 ? measure_capture(captures.front())
                                         : measure_ends(captures.front(), captures.back());
    if (measured) return measured;
    const auto second = files.size() == 1 ? "" : fmt::format(" and {}", files.back()->name);
    return base::fail(
        fmt::format("{}{}: {}", files.front()->name, second, measured.error().message));
}

} // namespace

base::Result<Measurement> read_measurement(std::string_view text, const Columns& columns)
{
    const auto first = LineReader{text}.next().value_or("");
    if (first.starts_with("PING ")) return read_ping(text);
    if (first.starts_with("{")) return read_irtt(text);
    const bool is_probe = columns.empty() && first.starts_with("sequence,") &&
                          first.find(",round_trip_ms,") != std::string_view::npos;
    if (is_probe) return read_probe(text);
    const auto rows = read_trace_rows(text, Measure::delay, columns);
    if (!rows) return tl::unexpected{rows.error()};
    return Measurement{.round_trip = way_of(*rows)};
}

base::Result<Measurement> read_measurements(std::span<const MeasuredFile> files,
                                            const Columns& columns)
{
    std::optional<Measurement> all;
    std::vector<const MeasuredFile*> captures;
    const auto take = [&](Measurement measurement, const std::string& name) -> base::Result<void> {
        if (!all) {
            all = std::move(measurement);
        } else if (!append(*all, measurement)) {
            return base::fail(fmt::format("{}: it was not measured as the files before it, there, "
                                          "back or there and back: learn from it by itself",
                                          name));
        }
        return {};
    };
    for (const MeasuredFile& file : files) {
        if (is_capture(file.bytes)) {
            captures.push_back(&file);
            continue;
        }
        auto measurement = read_measurement(file.bytes, columns);
        if (!measurement) {
            return base::fail(fmt::format("{}: {}", file.name, measurement.error().message));
        }
        const auto taken = take(*std::move(measurement), file.name);
        if (!taken) return tl::unexpected{taken.error()};
    }
    if (!captures.empty()) {
        auto measurement = read_captures(captures);
        if (!measurement) return measurement;
        const auto taken = take(*std::move(measurement), captures.front()->name);
        if (!taken) return tl::unexpected{taken.error()};
    }
    if (!all) return base::fail("no file was given");
    const auto series = files.size() - captures.size() + (captures.empty() ? 0 : 1);
    if (series > 1) all->remarks.push_back(fmt::format("{} series, one after the other", series));
    return *std::move(all);
}

void settle_clocks(Measurement& measurement)
{
    const auto up = delays_of(measurement.up);
    const auto down = delays_of(measurement.down);
    auto& remarks = measurement.remarks;
    const auto least_of = [](const std::vector<base::Duration>& delays) {
        return *std::min_element(delays.begin(), delays.end());
    };
    const auto is_negative = [](base::Duration delay) { return delay < base::Duration{}; };
    if (std::ranges::none_of(up, is_negative) && std::ranges::none_of(down, is_negative)) {
        remarks.emplace_back("The clocks of the two ends are taken for one, as no delay is "
                             "negative: an error of theirs is in the delays of both ways");
        return;
    }
    if (!up.empty() && !down.empty()) {
        const base::Duration off = (least_of(up) - least_of(down)) / 2;
        shift(*measurement.up, -off);
        shift(*measurement.down, off);
        remarks.push_back(fmt::format("The ends have two clocks, {:.3f} ms apart if the least "
                                      "delays of both ways are equal, as is assumed",
                                      1e3 * base::to_seconds(off)));
        return;
    }
    if (!up.empty()) shift(*measurement.up, -least_of(up));
    if (!down.empty()) shift(*measurement.down, -least_of(down));
    remarks.emplace_back("The ends have two clocks, and one way alone does not tell how far they "
                         "are apart: the least delay is taken for 0, and only what varies is "
                         "known");
}

} // namespace hapnet::emulator::tools
