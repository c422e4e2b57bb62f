// SPDX-FileCopyrightText: 2026 The Hapnet authors
// SPDX-License-Identifier: MIT
#include "emulator/commands.hpp"
#include "emulator/core/trace/rows.hpp"
#include "emulator/tools/learn/learn.hpp"
#include "proto/base/document.hpp"
#include "proto/base/fields_json.hpp"
#include "proto/base/visible.hpp"
#include "proto/disk/result_file.hpp"
#include "proto/net/program.hpp"
#include "proto/net/text_file.hpp"

#include <algorithm>
#include <cstdio>
#include <filesystem>
#include <nlohmann/json.hpp>
#include <optional>
#include <spdlog/fmt/fmt.h>
#include <string>
#include <string_view>
#include <unistd.h>
#include <utility>
#include <variant>
#include <vector>

namespace hapnet::emulator {

namespace {

/// True if a text consists of keys and values, like a profile. No measurement can be read as such.
bool is_toml(std::string_view text)
{
    const auto document = base::parse_document(text);
    return document && !std::get<base::Node::Table>(document->value).empty();
}

base::Result<tools::Measurement> measurement_of(const std::vector<tools::MeasuredFile>& files,
                                                const LearnOptions& options)
{
    const auto named = parse_columns(options.columns);
    if (!named) return base::fail(fmt::format("--columns: {}", named.error().message));
    auto measurement = tools::read_measurements(files, *named);
    if (!measurement) {
        for (const tools::MeasuredFile& file : files) {
            if (!is_toml(file.bytes)) continue;
            return base::fail(fmt::format("{0}: this is a profile or another text in TOML, not a "
                                          "measurement; hapnet-emulator check {0} describes a "
                                          "profile",
                                          file.name));
        }
        return tl::unexpected{measurement.error()};
    }
    if (options.is_one_way) {
        if (!measurement->round_trip) {
            return base::fail("--one-way is for a table: these files say themselves which way "
                              "they measured");
        }
        measurement->up = std::exchange(measurement->round_trip, std::nullopt);
    }
    if (options.spacing) {
        for (auto* way : {&measurement->round_trip, &measurement->up, &measurement->down}) {
            if (*way) (*way)->spacing = options.spacing;
        }
    }
    return measurement;
}

/// Returns the measured directions, by their names in remarks.
std::vector<std::pair<const char*, const tools::MeasuredWay*>>
ways_of(const tools::Measurement& measurement)
{
    std::vector<std::pair<const char*, const tools::MeasuredWay*>> ways;
    if (measurement.round_trip) ways.emplace_back("round trip", &*measurement.round_trip);
    if (measurement.up) ways.emplace_back("up", &*measurement.up);
    if (measurement.down) ways.emplace_back("down", &*measurement.down);
    return ways;
}

/// Returns "pings-up.csv" for "pings.csv", if there are two directions.
std::string name_for(const std::string& file, const char* way, bool is_only_one)
{
    if (is_only_one) return file;
    const std::filesystem::path path{file};
    const auto name = fmt::format("{}-{}{}", path.stem().string(), way, path.extension().string());
    return (path.parent_path() / name).string();
}

/// Writes the files of --trace. Throws std::system_error.
tools::LearnSettings write_traces(const tools::Measurement& measurement, const std::string& file)
{
    tools::LearnSettings settings{.replays = true};
    const auto ways = ways_of(measurement);
    for (const auto& [name, way] : ways) {
        auto table = tools::named_table(name_for(file, name, ways.size() == 1), *way);
        disk::ResultFile{table.file, "--trace"}.commit(table.text);
        settings.tables.emplace(name, std::move(table));
    }
    return settings;
}

/// Sets the table, if there is only one, so that the profile can name it.
tools::LearnSettings with_table(const tools::Measurement& measurement,
                                const std::vector<tools::MeasuredFile>& files,
                                const LearnOptions& options)
{
    tools::LearnSettings settings;
    const auto ways = ways_of(measurement);
    if (files.size() != 1 || ways.size() != 1) return settings;
    const auto format = parse_format(options.columns);
    const auto rows = format ? read_trace_rows(files.front().bytes, Measure::delay, *format)
                             : base::Result<TraceRows>{tl::unexpected{format.error()}};
    if (!rows) return settings;
    const auto& [name, way] = ways.front();
    const bool has_times = !rows->times.empty();
    settings.tables.emplace(
        name, tools::MeasuredTable{
                  .file = files.front().name,
                  .text = files.front().bytes,
                  .columns = options.columns,
                  .slot = has_times ? base::Duration{0} : way->spacing.value_or(base::Duration{0}),
                  .is_timed = has_times || way->spacing,
                  .has_losses = std::ranges::find(way->lost, true) != way->lost.end()});
    return settings;
}

void tell(const tools::Lesson& lesson, bool with_plots)
{
    if (with_plots) {
        for (const std::string& plot : lesson.plots) net::tell(base::visible_lines(plot) + "\n");
    }
    for (const std::string& remark : lesson.remarks) net::tell(base::visible_lines(remark) + "\n");
}

} // namespace

base::Result<int> run(const LearnOptions& options)
{
    std::vector<tools::MeasuredFile> files;
    for (const std::string& file : options.files) {
        auto bytes = net::text_of_file(file);
        if (!bytes) return tl::unexpected{bytes.error()};
        files.push_back({file, *std::move(bytes)});
    }
    const auto measurement = measurement_of(files, options);
    if (!measurement) return tl::unexpected{measurement.error()};
    const auto settings = options.trace ? write_traces(*measurement, *options.trace)
                                        : with_table(*measurement, files, options);
    const auto lesson = tools::learn(*measurement, settings);
    if (!lesson) {
        return base::fail(fmt::format("{}: {}", options.files.front(), lesson.error().message));
    }
    tell(*lesson, options.with_plots || isatty(STDERR_FILENO) != 0);
    if (options.as_json) {
        const auto json = base::json_of(tools::LearnReport{&*lesson});
        net::print(json.dump(2, ' ', false, nlohmann::json::error_handler_t::replace) + "\n");
    } else {
        net::print(tools::to_text(*lesson));
    }
    return 0;
}

} // namespace hapnet::emulator
