// SPDX-FileCopyrightText: 2026 The Hapnet authors
// SPDX-License-Identifier: MIT
#include "emulator/tools/learn/measurement.hpp"

#include "emulator/tools/learn/captures.hpp"
#include "emulator/tools/learn/irtt.hpp"
#include "emulator/tools/learn/ping.hpp"

#include <algorithm>
#include <spdlog/fmt/fmt.h>
#include <utility>

namespace hapnet::emulator::tools {

namespace {

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

/// Reads sequence,sent_s,round_trip_ms,there_ms,back_ms,answers. The delays of both directions are
/// empty if the ends have two clocks.
base::Result<Measurement> read_probe(std::string_view text)
{
    const auto column = [&](const std::string& name) {
        return read_trace_rows(text, Measure::delay,
                               {{{"time", "sent_s", ""}, {"delay", name, ""}}});
    };
    const auto round_trip = column("round_trip_ms");
    if (!round_trip) return tl::unexpected{round_trip.error()};
    const auto there = column("there_ms");
    const auto back = column("back_ms");
    if (!there || !back) return Measurement{.round_trip = way_of(*round_trip)};
    return Measurement{.up = way_of(*there), .down = way_of(*back), .mixes_losses = true};
}

/// Returns the known delays.
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

/// Appends the later values.
void append(MeasuredWay& way, const MeasuredWay& later)
{
    way.delays.insert(way.delays.end(), later.delays.begin(), later.delays.end());
    way.lost.insert(way.lost.end(), later.lost.begin(), later.lost.end());
    way.reordered += later.reordered;
    const bool is_alike = way.spacing && later.spacing && *later.spacing < 2 * *way.spacing &&
                          *way.spacing < 2 * *later.spacing;
    way.spacing = is_alike ? std::optional{(*way.spacing + *later.spacing) / 2} : std::nullopt;
}

/// Appends a later measurement. Returns false when it does not have the same directions.
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
    if (measured) {
        for (std::size_t i = 0; i < captures.size(); ++i) {
            if (captures[i].cut_off_in == 0) continue;
            measured->remarks.push_back(
                fmt::format("{} is cut off within packet {}: only what comes before is learned",
                            files[i]->name, captures[i].cut_off_in));
        }
        return measured;
    }
    const auto second = files.size() == 1 ? "" : fmt::format(" and {}", files.back()->name);
    return base::fail(
        fmt::format("{}{}: {}", files.front()->name, second, measured.error().message));
}

/// Returns why a text is refused. If it begins with words, it is in no known format, and the error
/// lists the formats that can be read.
tl::unexpected<base::Error> refusal_of(std::string_view text, const base::Error& error)
{
    base::LineReader lines{text};
    const auto first = lines.next().value_or("");
    const bool is_line = error.message.starts_with(fmt::format("line {}: '", lines.number()));
    if (!is_line || first.empty() || base::number_in(first)) return tl::unexpected{error};
    return base::fail(fmt::format("line {}: '{}' is no measurement: {}; probe, irtt, captures and "
                                  "tables with a column such as delay_ms can be read",
                                  lines.number(), base::shortened(first), pings_that_are_read));
}

} // namespace

base::Result<Measurement> read_measurement(std::string_view text, const base::Columns& columns)
{
    if (const auto zero = text.find('\0'); zero != std::string_view::npos)
        return base::fail(
            fmt::format("line {}: this is no text and no capture: what belongs here is what ping, "
                        "irtt or hapnet-emulator probe have written, or a CSV",
                        base::line_number_at(text, zero)));
    const auto first = base::LineReader{text}.next().value_or("");
    if (first.starts_with("{")) return read_irtt(text);
    const bool is_probe = columns.empty() && first.starts_with("sequence,") &&
                          first.find(",round_trip_ms,") != std::string_view::npos;
    if (is_probe) return read_probe(text);
    if (columns.empty() && is_ping(text)) return read_ping(text);
    const auto rows = read_trace_rows(text, Measure::delay, {columns});
    if (!rows) return refusal_of(text, rows.error());
    return Measurement{.round_trip = way_of(*rows)};
}

base::Result<Measurement> read_measurements(std::span<const MeasuredFile> files,
                                            const base::Columns& columns)
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
        const auto text = base::plain_text(file.bytes);
        auto measurement = text ? read_measurement(*text, columns)
                                : base::Result<Measurement>{tl::unexpected{text.error()}};
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
