// SPDX-FileCopyrightText: 2026 The Hapnet authors
// SPDX-License-Identifier: MIT
#include "lab/records/csv.hpp"

#include "lab/records/message_view.hpp"
#include "proto/record/fields.hpp"

#include <cmath>
#include <spdlog/fmt/fmt.h>
#include <string_view>

namespace hapnet::lab::records {

namespace {

/// How people read a vector: unit as the name of a column ends, and that unit per SI unit.
template <typename V>
struct VectorUnit;
template <>
struct VectorUnit<base::Position> {
    static constexpr std::string_view unit = "mm";
    static constexpr double scale = 1e3;
};
template <>
struct VectorUnit<base::Velocity> {
    static constexpr std::string_view unit = "mm_per_s";
    static constexpr double scale = 1e3;
};
template <>
struct VectorUnit<base::Force> {
    static constexpr std::string_view unit = "n";
    static constexpr double scale = 1.0;
};

// Columns and cells both start with a comma: the time stands before them.

struct ColumnNames {
    std::string& line;

    void operator()(std::string_view, const base::TimePoint&) const {} // it is the time
    void operator()(std::string_view name, const base::Duration&) const
    {
        line += fmt::format(",{}_us", name);
    }
    template <typename V>
    requires requires { VectorUnit<V>::unit; }
    void operator()(std::string_view name, const V&) const
    {
        for (const char axis : {'x', 'y', 'z'}) {
            line += fmt::format(",{}_{}_{}", name, axis, VectorUnit<V>::unit);
        }
    }
    void operator()(std::string_view name, const auto&) const { line += fmt::format(",{}", name); }
};

std::string decimal(double value)
{
    return std::isfinite(value) ? fmt::format("{:.6f}", value) : "";
}

std::string seconds(base::Duration duration)
{
    const auto nanoseconds = std::chrono::abs(duration).count();
    return fmt::format("{}{}.{:09}", duration.count() < 0 ? "-" : "", nanoseconds / 1'000'000'000,
                       nanoseconds % 1'000'000'000);
}

struct Cells {
    std::string& line;

    void operator()(std::string_view, const base::TimePoint&) const {}
    void operator()(std::string_view, base::Duration value) const
    {
        line += fmt::format(",{:.3f}", 1e-3 * static_cast<double>(value.count()));
    }
    template <typename V>
    requires requires { VectorUnit<V>::unit; }
    void operator()(std::string_view, const V& vector) const
    {
        for (const double part : {vector.x(), vector.y(), vector.z()}) {
            line += ',' + decimal(VectorUnit<V>::scale * part);
        }
    }
    void operator()(std::string_view, record::Phase phase) const
    {
        line += fmt::format(",{}", name_of(phase));
    }
    void operator()(std::string_view, bool value) const { line += value ? ",1" : ",0"; }
    void operator()(std::string_view, std::uint8_t value) const
    {
        line += fmt::format(",{}", value);
    }
    void operator()(std::string_view, std::uint16_t value) const
    {
        line += fmt::format(",{}", value);
    }
    void operator()(std::string_view, std::uint32_t value) const
    {
        line += fmt::format(",{}", value);
    }
    void operator()(std::string_view, std::uint64_t value) const
    {
        line += fmt::format(",{}", value);
    }
};

} // namespace

base::TimePoint csv_zero(const record::Record& record)
{
    if (!record.sessions.empty()) return record.sessions.back().start;
    return record.ticks.empty() ? base::TimePoint{} : record.ticks.front().at();
}

std::string tick_csv_header()
{
    std::string line = "time_s";
    const record::TickRow row;
    for_each_field(row, ColumnNames{line});
    return line;
}

std::string csv_line(const record::TickRow& row, base::TimePoint zero)
{
    std::string line = seconds(row.at() - zero);
    for_each_field(row, Cells{line});
    return line;
}

std::string message_csv_header() { return "time_s,tick,size_bytes,session,sequence,sent_s"; }

std::string csv_line(const record::MessageRow& row, base::TimePoint zero)
{
    std::string line = fmt::format("{},{},{}", seconds(row.received_at - zero), row.tick, row.size);
    const auto message = view_of(row);
    if (!message) return line + ",,,";
    return line + fmt::format(",{},{},{}", message->session, message->sequence,
                              seconds(message->sent.time_since_epoch()));
}

} // namespace hapnet::lab::records
