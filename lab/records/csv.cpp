// SPDX-FileCopyrightText: 2026 The Hapnet authors
// SPDX-License-Identifier: MIT
#include "lab/records/csv.hpp"

#include "lab/records/bodies.hpp"
#include "lab/records/message_view.hpp"
#include "proto/base/csv.hpp"
#include "proto/record/fields.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <spdlog/fmt/fmt.h>
#include <string_view>
#include <type_traits>

namespace hapnet::lab::records {

namespace {

/// The printed form of a vector: the endings of its columns' names, and the number of its units in
/// one SI unit.
template <typename V>
struct Shown;
template <>
struct Shown<base::Position> {
    static constexpr std::array suffixes{"_x_mm", "_y_mm", "_z_mm"};
    static constexpr double scale = 1e3;
};
template <>
struct Shown<base::Velocity> {
    static constexpr std::array suffixes{"_x_mm_per_s", "_y_mm_per_s", "_z_mm_per_s"};
    static constexpr double scale = 1e3;
};
template <>
struct Shown<record::AngularVelocity> {
    static constexpr std::array suffixes{"_x_rad_per_s", "_y_rad_per_s", "_z_rad_per_s"};
    static constexpr double scale = 1.0;
};
template <>
struct Shown<base::Force> {
    static constexpr std::array suffixes{"_x_n", "_y_n", "_z_n"};
    static constexpr double scale = 1.0;
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

/// Calls add(name, suffix, cell) for every column but the first, which is the time.
template <typename R>
void for_each_column(const R& row, const auto& add)
{
    base::for_each_field(
        [&]<typename Value>(const auto& field, const Value& value) {
            if constexpr (std::is_same_v<Value, base::Duration>) {
                add(field.key, "_us",
                    fmt::format("{:.3f}", 1e-3 * static_cast<double>(value.count())));
            } else if constexpr (requires { Shown<Value>::scale; }) {
                const auto& [x, y, z] = Shown<Value>::suffixes;
                add(field.key, x, decimal(Shown<Value>::scale * value.x()));
                add(field.key, y, decimal(Shown<Value>::scale * value.y()));
                add(field.key, z, decimal(Shown<Value>::scale * value.z()));
            } else if constexpr (std::is_same_v<Value, glm::dquat>) {
                add(field.key, "_w", decimal(value.w));
                add(field.key, "_x", decimal(value.x));
                add(field.key, "_y", decimal(value.y));
                add(field.key, "_z", decimal(value.z));
            } else if constexpr (std::is_same_v<Value, bool>) {
                add(field.key, "", value ? "1" : "0");
            } else if constexpr (std::is_same_v<R, record::BodyRow> &&
                                 std::is_same_v<Value, std::uint16_t>) {
                const bool is_said = field.key != "owner" || value != 0;
                add(field.key, "", is_said ? base::cell_of(value) : "");
            } else if constexpr (!std::is_same_v<Value, base::TimePoint>) {
                add(field.key, "", base::cell_of(value));
            }
        },
        row);
}

template <typename R = record::TickRow>
std::string column_names(std::string_view prefix)
{
    std::string names;
    for_each_column(R{}, [&](std::string_view name, std::string_view suffix, std::string_view) {
        names += fmt::format(",{}{}{}", prefix, name, suffix);
    });
    return names;
}

std::string cells_of(const auto& row)
{
    std::string cells;
    for_each_column(row, [&](std::string_view, std::string_view, std::string_view cell) {
        cells += ',';
        cells += cell;
    });
    return cells;
}

} // namespace

base::TimePoint csv_zero(const record::Record& record)
{
    if (!record.sessions.empty()) return record.sessions.back().start;
    return record.ticks.empty() ? base::TimePoint{} : record.ticks.front().at();
}

NewestSessions newest_sessions(const record::Record& record)
{
    NewestSessions newest;
    for (const record::SessionRow& row : record.sessions) newest[row.other] = row;
    return newest;
}

std::string tick_csv_header() { return "time_s" + column_names(""); }

std::string csv_line(const record::TickRow& row, base::TimePoint zero)
{
    return seconds(row.at() - zero) + cells_of(row);
}

std::string body_csv_header() { return "time_s" + column_names<record::BodyRow>(""); }

void for_each_body_csv_line(const record::Record& record, base::TimePoint zero,
                            const std::function<void(const std::string&)>& take)
{
    const auto line_of = [&](const record::TickRow& tick, const record::BodyRow& row) {
        take(seconds(tick.at() - zero) + cells_of(row));
    };
    const auto only_body = bodies_shared_in(record, record).front().number.value_or(0);
    auto row = record.bodies.begin();
    for (const record::TickRow& tick : record.ticks) {
        if (record.bodies.empty()) {
            line_of(tick, {.tick = tick.tick,
                           .body = only_body,
                           .position = tick.cube,
                           .velocity = tick.cube_velocity});
        }
        while (row != record.bodies.end() && row->tick < tick.tick) ++row;
        for (; row != record.bodies.end() && row->tick == tick.tick; ++row) line_of(tick, *row);
    }
}

std::string joined_csv_header()
{
    return "time_s" + column_names("a_") + ",b_time_s" + column_names("b_");
}

void for_each_joined_csv_line(const Session& session,
                              const std::function<void(const std::string&)>& take)
{
    const base::TimePoint zero = session.a.terms.start;
    const auto names = column_names("");
    const std::string nothing(static_cast<std::size_t>(std::ranges::count(names, ',')), ',');
    auto next = session.b.ticks.begin();
    const record::TickRow* last = nullptr;
    for (const record::TickRow& row : session.a.ticks) {
        for (; next != session.b.ticks.end() && session.clock.to_a(next->at()) <= row.at(); ++next)
            last = &*next;
        std::string line = csv_line(row, zero) + ',';
        if (last != nullptr) {
            line += seconds(session.clock.to_a(last->at()) - zero) + cells_of(*last);
        } else {
            line += nothing;
        }
        take(line);
    }
}

std::string message_csv_header()
{
    return "time_s,tick,size_bytes,session,sequence,sent_s,sent_time_s,from";
}

std::string csv_line(const record::MessageRow& row, base::TimePoint zero,
                     const NewestSessions& sessions)
{
    const std::string from = row.from == 0 ? "" : std::to_string(row.from);
    std::string line =
        fmt::format("{},{},{}", seconds(row.received_at - zero), row.tick, row.bytes.size());
    const auto message = view_of(row);
    if (!message) return line + ",,,,," + from;
    const auto session = sessions.find(row.from);
    const std::string sent = session == sessions.end()
                                 ? ""
                                 : seconds(clock_of(session->second).to_a(message->sent) - zero);
    return line + fmt::format(",{},{},{},{},{}", message->session, message->sequence,
                              seconds(message->sent.time_since_epoch()), sent, from);
}

} // namespace hapnet::lab::records
