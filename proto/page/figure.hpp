// SPDX-FileCopyrightText: 2026 The Hapnet authors
// SPDX-License-Identifier: MIT
#pragma once

#include "proto/page/blocks.hpp"

#include <cstddef>
#include <limits>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <variant>
#include <vector>

namespace hapnet::page {

// Figures as data, which web/page/figures draws. Colours are names from palette.css, such as
// "left".

/// The range of some values. It is empty until a value is included.
struct Range {
    double low = std::numeric_limits<double>::infinity();
    double high = -std::numeric_limits<double>::infinity();

    [[nodiscard]] bool is_empty() const { return !(low <= high); }
    /// Extends the range to a value. A value that is not finite changes nothing.
    void include(double value);
};

enum class Scale : std::uint8_t { linear, logarithmic };

/// One axis of a figure.
struct Axis {
    std::string label;
    std::string unit{};
    Scale scale = Scale::linear;
    Range range{}; // range that the axis covers in addition to the values
};

struct Point {
    double x = 0.0;
    double y = 0.0;
};

/// The range of a curve's values at x.
struct BandPoint {
    double x = 0.0;
    Range y;
};

/// The place where a curve crosses the height y. It is drawn as a horizontal line with ends, from
/// `low` to `high`.
struct Crossing {
    double y = 0.0;
    Range x;
};

/// A curve with ascending x. Values that are not finite are left out.
struct Curve {
    std::string name; // name in the legend; empty: none
    std::string_view colour;
    std::vector<Point> points{};
    std::vector<Point> scatter{}; // dots beside the curve that belong to it
    std::vector<BandPoint> band{};
    std::optional<Crossing> crossing{};
    double width = 1.2; // line width, pixels; 0: only dots
    bool is_dashed = false;
    bool shows_points = false; // true: a dot at each point
};

/// A value to compare curves with. It is drawn as a dashed line across the figure.
struct Level {
    double y = 0.0;
    std::string_view name;
};

struct Curves {
    std::vector<Curve> curves;
    std::vector<Level> levels{};
    std::vector<double> moments{}; // values of x with a dashed vertical line
};

/// A bar from zero to a value that is not negative. Its text gives the value.
struct Bar {
    std::string series; // name of the bars with the same place in each group
    double value = 0.0;
    std::string text;
    std::string_view colour;
    bool is_outlined = false;        // for values from other sources
    bool is_open = false;            // the true value is larger: the bar ends in an arrow
    bool is_missed = false;          // the text is red
    std::optional<Range> interval{}; // interval in which the value lies
    std::string tip{};               // tooltip
};

struct BarGroup {
    std::string name;
    std::vector<Bar> bars;
};
using Bars = std::vector<BarGroup>;

/// A cell of a heat map. The symbol has the same meaning as the colour.
struct HeatCell {
    std::size_t column = 0;
    std::size_t row = 0; // 0: lowest
    std::string_view colour;
    double opacity = 1.0;
    std::string_view symbol{};
    std::string tip;
};

/// A row of a dot plot: a value, its interval, and the accepted range.
struct DotRow {
    std::string name;
    std::string_view colour;
    std::optional<double> value{};
    std::optional<Range> interval{};
    std::optional<Range> accepted{}; // an infinite end is open
    std::vector<double> single{};    // single values, as small dots
    bool is_missed = false;
    std::string tip{}; // tooltip
};
using Dots = std::vector<DotRow>;

struct HeatMap {
    std::vector<std::string> columns; // labels below the columns
    std::vector<std::string> rows;    // labels beside the rows, from the bottom up
    std::vector<HeatCell> cells;
};

/// The width and height that a figure is designed for, in pixels. A page may draw it wider or
/// narrower.
struct Size {
    double width = 900.0;
    double height = 280.0;
};

struct Figure {
    std::string id; // letters, digits and hyphens: see plain_id()
    std::string title;
    Axis x;
    Axis y;
    std::variant<Curves, Bars, HeatMap, Dots> content;
    Size size{};
    Json caption = "";
    std::vector<std::string> sources{}; // files with the figure's numbers, as paths from the page
};

/// Returns the text with a hyphen in place of each character that an id must not contain.
[[nodiscard]] std::string plain_id(std::string text);

/// Reduces a curve to about `count_max` points at most: the lowest and the highest of each section,
/// so that no peak is lost.
[[nodiscard]] std::vector<Point> thinned(std::span<const Point> points, std::size_t count_max);

/// Returns the figure as pages contain it: `{id, kind, title, x, y, series, ...}`. Points have
/// seven digits.
[[nodiscard]] Json json_of(const Figure& figure);

/// Returns the numbers of a figure that json_of() returned, as CSV. The header names the quantities
/// of the axes with their units: "curve,time_s,delay_ms", "group,bar,value_mm,low_mm,high_mm" or
/// "row,value_mm,low_mm,high_mm".
[[nodiscard]] std::string csv_of(const Json& figure);

} // namespace hapnet::page
