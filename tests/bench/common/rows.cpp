// SPDX-FileCopyrightText: 2026 The Hapnet authors
// SPDX-License-Identifier: MIT
#include "tests/bench/common/rows.hpp"

#include <cmath>
#include <nlohmann/json.hpp>
#include <spdlog/fmt/fmt.h>

namespace hapnet::bench {

namespace {

using Json = nlohmann::ordered_json;

Json number_or_null(std::optional<double> value)
{
    return value && std::isfinite(*value) ? Json(*value) : Json(nullptr);
}

Json json_of(const Row& row)
{
    const auto met = row.met();
    Json json;
    json["case"] = row.name;
    json["subject"] = row.subject;
    json["baseline"] = row.baseline.empty() ? Json(nullptr) : Json(row.baseline);
    json["metric"] = row.metric;
    json["value"] = number_or_null(row.value);
    json["baseline_value"] = number_or_null(row.baseline_value);
    json["ratio"] = number_or_null(row.ratio());
    json["target"] = number_or_null(row.target);
    json["direction"] = row.direction == Direction::at_least ? "min" : "max";
    json["met"] = met ? Json(*met) : Json(nullptr);
    return json;
}

std::string text_of(std::optional<double> value)
{
    if (!value) return "";
    const double size = std::abs(*value);
    if (size != 0.0 && (size < 0.01 || size >= 1e7)) return fmt::format("{:.2g}", *value);
    return fmt::format("{:.{}f}", *value, size < 1000 ? 2 : 0);
}

} // namespace

std::optional<double> Row::ratio() const
{
    if (!baseline_value || value == 0.0) return std::nullopt;
    return *baseline_value / value;
}

std::optional<bool> Row::met() const
{
    if (!target) return std::nullopt;
    const bool is_ratio = metric.ends_with("_ratio");
    // The ratio of a baseline to 0 is infinite, so it is above any target.
    if (is_ratio && baseline_value && value == 0.0) return direction == Direction::at_least;
    const auto judged = is_ratio ? ratio() : std::optional{value};
    if (!judged) return false;
    return direction == Direction::at_least ? *judged >= *target : *judged <= *target;
}

std::string rows_json(const Host& host, std::span<const Row> rows)
{
    Json json;
    json["host"] = {{"cpu", host.cpu},
                    {"cores", host.cores},
                    {"kernel", host.kernel},
                    {"fifo", host.fifo},
                    {"load", host.load}};
    json["rows"] = Json::array();
    for (const Row& row : rows) json["rows"].push_back(json_of(row));
    return json.dump(2) + "\n";
}

std::string rows_table(std::span<const Row> rows)
{
    std::string table =
        fmt::format("{:<34} {:<24} {:<14} {:<20} {:>10} {:>10} {:>8} {:>10}\n", "case", "subject",
                    "baseline", "metric", "value", "baseline", "ratio", "target");
    for (const Row& row : rows) {
        std::string target;
        if (row.target) {
            target = fmt::format(
                "{} {}", row.direction == Direction::at_least ? ">=" : "<=", text_of(row.target));
        }
        const auto met = row.met();
        table += fmt::format("{:<34} {:<24} {:<14} {:<20} {:>10} {:>10} {:>8} {:>10} {}\n",
                             row.name, row.subject, row.baseline, row.metric, text_of(row.value),
                             text_of(row.baseline_value), text_of(row.ratio()), target,
                             !met   ? ""
                             : *met ? "met"
                                    : "MISSED");
    }
    return table;
}

} // namespace hapnet::bench
