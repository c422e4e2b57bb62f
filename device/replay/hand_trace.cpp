// SPDX-FileCopyrightText: 2026 The Hapnet authors
// SPDX-License-Identifier: MIT
#include "device/replay/hand_trace.hpp"

#include <algorithm>
#include <array>
#include <charconv>
#include <cmath>
#include <optional>
#include <spdlog/fmt/fmt.h>

namespace hapnet::device {

namespace {

/// Removes and returns the text before the next `separator`, or all of it. The separator is
/// removed, too.
std::string_view take_until(std::string_view& text, char separator)
{
    const auto end = std::min(text.find(separator), text.size());
    const auto taken = text.substr(0, end);
    text.remove_prefix(std::min(end + 1, text.size()));
    return taken;
}

/// Removes and returns a line without its end, which may be that of another system.
std::string_view take_line(std::string_view& text)
{
    auto line = take_until(text, '\n');
    if (line.ends_with('\r')) line.remove_suffix(1);
    return line;
}

std::optional<double> number_in(std::string_view cell)
{
    double value = 0.0;
    const auto [end, error] = std::from_chars(cell.data(), cell.data() + cell.size(), value);
    const bool is_all = error == std::errc{} && end == cell.data() + cell.size();
    return is_all && std::isfinite(value) ? std::optional{value} : std::nullopt;
}

/// The indices of the cells of a line that have each value, and the units of the columns' names.
struct Columns {
    static constexpr std::size_t none = static_cast<std::size_t>(-1);
    std::size_t count = 0;
    std::size_t time = none;
    std::size_t gripping = none;
    std::size_t docked = none;
    std::array<std::size_t, 3> axes{none, none, none};
    double m_per_unit = 1.0;
};

std::size_t place_of(const std::vector<std::string_view>& names, std::string_view name)
{
    const auto found = std::find(names.begin(), names.end(), name);
    return found == names.end() ? Columns::none : static_cast<std::size_t>(found - names.begin());
}

std::optional<Columns> columns_of(std::string_view header)
{
    struct Naming {
        std::array<std::string_view, 3> axes{};
        double m_per_unit = 1.0;
    };
    constexpr std::array namings{Naming{{"x_m", "y_m", "z_m"}, 1.0},
                                 Naming{{"hip_x_mm", "hip_y_mm", "hip_z_mm"}, 1e-3}};
    std::vector<std::string_view> names;
    while (!header.empty()) names.push_back(take_until(header, ','));
    Columns columns;
    columns.count = names.size();
    columns.time = place_of(names, "time_s");
    columns.gripping = place_of(names, "gripping");
    columns.docked = place_of(names, "docked");
    for (const Naming& naming : namings) {
        if (columns.time == Columns::none || place_of(names, naming.axes[0]) == Columns::none) {
            continue;
        }
        for (std::size_t i = 0; i < 3; ++i) columns.axes[i] = place_of(names, naming.axes[i]);
        columns.m_per_unit = naming.m_per_unit;
        const auto& axes = columns.axes;
        if (std::find(axes.begin(), axes.end(), Columns::none) == axes.end()) return columns;
    }
    return std::nullopt;
}

/// Reads one line of numbers. The error says what was expected.
base::Result<HandMoment> moment_in(std::string_view line, const Columns& columns)
{
    std::size_t cells = 0;
    HandMoment moment;
    for (bool more = true; more; ++cells) {
        more = line.find(',') != std::string_view::npos;
        const auto cell = take_until(line, ',');
        const auto number = number_in(cell);
        if (cells == columns.gripping || cells == columns.docked) {
            const bool is_grip = cells == columns.gripping;
            if (cell != "0" && cell != "1") {
                return base::fail(fmt::format("'{}' does not say 0 or 1 for {}", cell,
                                              is_grip ? "gripping" : "docked"));
            }
            (is_grip ? moment.gripping : moment.docked) = cell == "1";
        }
        if (cells == columns.time) {
            if (!number) return base::fail(fmt::format("'{}' is not a time in seconds", cell));
            moment.time_s = *number;
        }
        for (const int axis : {0, 1, 2}) {
            if (cells != columns.axes[static_cast<std::size_t>(axis)]) continue;
            const double metres = number.value_or(INFINITY) * columns.m_per_unit;
            if (!(std::abs(metres) <= hand_reach_max_m)) {
                return base::fail(
                    fmt::format("'{}' is not a coordinate within {} m", cell, hand_reach_max_m));
            }
            moment.hip.value[axis] = metres;
        }
    }
    if (cells != columns.count) {
        return base::fail(
            fmt::format("{} cells where the first line names {} columns", cells, columns.count));
    }
    return moment;
}

} // namespace

base::Result<HandTrace> parse_hand_trace(std::string_view text, const std::string& source)
{
    std::size_t number = 1;
    const auto complain = [&](std::string_view what) {
        return base::fail(fmt::format("{}:{}: {}", source, number, what));
    };
    const auto columns = columns_of(take_line(text));
    if (!columns) {
        return complain("the first line names the columns: time_s,x_m,y_m,z_m or "
                        "time_s,x_m,y_m,z_m,gripping, or those of hapnet-lab export");
    }
    HandTrace trace;
    while (!text.empty()) {
        ++number;
        auto moment = moment_in(take_line(text), *columns);
        if (!moment) return complain(moment.error().message);
        if (!trace.empty() && !(moment->time_s > trace.back().time_s)) {
            return complain(fmt::format("the time {} s does not come after {} s", moment->time_s,
                                        trace.back().time_s));
        }
        if (trace.size() == hand_moments_max) {
            return complain(fmt::format("more than {} lines", hand_moments_max));
        }
        trace.push_back(*moment);
    }
    if (trace.empty()) return complain("no line of numbers follows");
    return trace;
}

std::string print_hand_trace(const HandTrace& trace)
{
    std::string text = "time_s,x_m,y_m,z_m,gripping,docked\n";
    for (const HandMoment& moment : trace) {
        text += fmt::format("{},{},{},{},{:d},{:d}\n", moment.time_s, moment.hip.x(),
                            moment.hip.y(), moment.hip.z(), moment.gripping, moment.docked);
    }
    return text;
}

HandMoment moment_at(const HandTrace& trace, double seconds)
{
    const auto next =
        std::upper_bound(trace.begin(), trace.end(), seconds,
                         [](double t, const HandMoment& moment) { return t < moment.time_s; });
    if (next == trace.begin()) return {seconds, next->hip, false, next->docked};
    const HandMoment& from = *(next - 1);
    if (next == trace.end()) return {seconds, from.hip, false, from.docked};
    const double share = (seconds - from.time_s) / (next->time_s - from.time_s);
    const base::Position hip{from.hip.value + share * (next->hip - from.hip).value};
    return {seconds, hip, from.gripping, from.docked};
}

} // namespace hapnet::device
