// SPDX-FileCopyrightText: 2026 The Hapnet authors
// SPDX-License-Identifier: MIT
#include "lab/experiment/axes.hpp"

#include "lab/experiment/fields.hpp"
#include "proto/base/latin_hypercube.hpp"

#include <algorithm>
#include <charconv>
#include <cmath>
#include <cstddef>
#include <set>
#include <spdlog/fmt/fmt.h>
#include <string_view>
#include <system_error>
#include <utility>

namespace hapnet::lab::experiment {

namespace {

tl::unexpected<base::Error> refuse_axis(const Axis& axis, std::string_view why)
{
    return base::fail(fmt::format("axis '{}': {}", axis.key, why));
}

/// The parts of a text such as "12.5ms".
struct NumberWithUnit {
    double number = 0.0;
    std::string_view unit;
    int decimals = 0; // number of decimals in the text
};

std::optional<NumberWithUnit> number_with_unit(std::string_view text)
{
    NumberWithUnit parsed;
    const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), parsed.number,
                                              std::chars_format::fixed);
    if (error != std::errc{} || !std::isfinite(parsed.number)) return std::nullopt;
    const auto length = static_cast<std::size_t>(end - text.data());
    const auto point = text.substr(0, length).find('.');
    if (point != std::string_view::npos) parsed.decimals = static_cast<int>(length - point - 1);
    parsed.unit = text.substr(length);
    return parsed;
}

/// The decimal numbers with a unit from one to another, in steps or at any values.
struct NumberRange {
    double from = 0.0;
    double to = 0.0;
    std::optional<double> step{};
    std::string unit{};
    int decimals = 0; // decimals with which values are written

    [[nodiscard]] std::size_t steps() const
    {
        constexpr double slack = 1e-9; // 0.3 / 0.1 is a little less than 3
        return static_cast<std::size_t>((to - from) / step.value_or(to - from) + slack);
    }
    [[nodiscard]] std::string at_step(std::size_t number) const
    {
        return text(from + static_cast<double>(number) * step.value_or(to - from));
    }
    /// Returns the value at a `share`, 0 to 1, of the range.
    [[nodiscard]] std::string at_share(double share) const
    {
        return text(from + share * (to - from));
    }

private:
    /// Returns a value with its unit, without the zeros at the end of its decimals.
    [[nodiscard]] std::string text(double value) const
    {
        std::string number = fmt::format("{:.{}f}", value, decimals);
        if (number.find('.') != std::string::npos) {
            number.erase(number.find_last_not_of('0') + 1);
            if (number.ends_with('.')) number.pop_back();
        }
        return (number == "-0" ? "0" : number) + unit;
    }
};

/// Returns enough decimals for ten thousand different values in a range of this width.
int decimals_for(double width)
{
    constexpr double values = 1e4;
    constexpr int decimals_max = 9;
    int decimals = 0;
    for (double scaled = width; scaled < values && decimals < decimals_max; scaled *= 10.0)
        ++decimals;
    return decimals;
}

base::Result<NumberRange> range_of(const Axis& axis)
{
    const auto from = number_with_unit(*axis.from), to = number_with_unit(*axis.to);
    if (!from || !to || from->unit != to->unit)
        return refuse_axis(axis, "'from' and 'to' are numbers with the same unit: 0ms and 200ms");
    if (from->number >= to->number) return refuse_axis(axis, "'from' has to be less than 'to'");
    NumberRange range{from->number, to->number, {}, std::string{to->unit}, 0};
    range.decimals = std::max(from->decimals, to->decimals);
    if (!axis.step) {
        range.decimals = std::max(range.decimals, decimals_for(to->number - from->number));
        return range;
    }
    const auto step = number_with_unit(*axis.step);
    const bool fits = step && step->unit == to->unit && step->number > 0.0 &&
                      step->number <= to->number - from->number;
    if (!fits) {
        return refuse_axis(axis, "'step' is a number with the unit of 'to', from more than 0 to "
                                 "the length of the range");
    }
    if ((to->number - from->number) / step->number > points_max)
        return refuse_axis(axis, fmt::format("more than {} steps", points_max));
    range.step = step->number;
    range.decimals = std::max(range.decimals, step->decimals);
    return range;
}

base::Result<void> check_form(const Axis& axis)
{
    const bool has_range = axis.from || axis.to || axis.step;
    if (axis.values.empty() == has_range && (!has_range || (axis.from && axis.to))) return {};
    return refuse_axis(axis, "write values = [\"0ms\", \"5ms\"], or from = \"0ms\" and "
                             "to = \"200ms\"");
}

/// Returns all values of an axis, one after the other.
base::Result<std::vector<std::string>> listed(const Axis& axis)
{
    if (!axis.values.empty()) return axis.values;
    if (!axis.step)
        return refuse_axis(axis, "a range needs a step = \"20ms\", or [latin_hypercube]");
    const auto range = range_of(axis);
    if (!range) return tl::unexpected{range.error()};
    std::vector<std::string> values;
    for (std::size_t i = 0; i <= range->steps(); ++i) values.push_back(range->at_step(i));
    return values;
}

/// Draws one value of an axis for each point.
base::Result<std::vector<std::string>> drawn(const Axis& axis, const LatinHypercube& hypercube)
{
    std::vector<std::string> all;
    std::optional<NumberRange> range;
    if (axis.values.empty() && !axis.step) {
        auto read = range_of(axis);
        if (!read) return tl::unexpected{read.error()};
        range = *std::move(read);
    } else {
        auto read = listed(axis);
        if (!read) return read;
        all = *std::move(read);
    }
    const auto stream = base::Seed{hypercube.seed}.stream("latin-hypercube/" + axis.key);
    std::vector<std::string> values;
    for (const double place : base::latin_places(stream, hypercube.points)) {
        const double share = place / hypercube.points;
        if (range) {
            values.push_back(range->at_share(share));
        } else {
            const auto number = static_cast<std::size_t>(share * static_cast<double>(all.size()));
            values.push_back(all[std::min(number, all.size() - 1)]);
        }
    }
    return values;
}

/// Combines each of the points with every value of a further axis.
base::Result<std::vector<AxisValues>> crossed(const std::vector<AxisValues>& points,
                                              const std::vector<std::string>& values)
{
    if (points.size() * values.size() > points_max) {
        return base::fail(fmt::format("the axes have more than {} points: use larger steps, or "
                                      "[latin_hypercube]",
                                      points_max));
    }
    std::vector<AxisValues> all;
    for (const AxisValues& point : points) {
        for (const std::string& value : values) {
            all.push_back(point);
            all.back().push_back(value);
        }
    }
    return all;
}

} // namespace

base::Result<std::vector<AxisValues>> axis_points(const Experiment& experiment)
{
    const auto& hypercube = experiment.latin_hypercube;
    if (hypercube && experiment.axes.empty())
        return base::fail("a latin hypercube needs an [[axis]] with key, from and to");
    std::vector<AxisValues> points(hypercube ? hypercube->points : 1);
    std::set<std::string_view> keys;
    for (const Axis& axis : experiment.axes) {
        if (!keys.insert(axis.key).second) return refuse_axis(axis, "it is there already");
        if (auto form = check_form(axis); !form) return tl::unexpected{form.error()};
        const auto values = hypercube ? drawn(axis, *hypercube) : listed(axis);
        if (!values) return tl::unexpected{values.error()};
        if (hypercube) {
            for (std::size_t i = 0; i < points.size(); ++i) points[i].push_back((*values)[i]);
            continue;
        }
        auto more = crossed(points, *values);
        if (!more) return more;
        points = *std::move(more);
    }
    return points;
}

} // namespace hapnet::lab::experiment
