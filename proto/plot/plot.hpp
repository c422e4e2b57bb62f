// SPDX-FileCopyrightText: 2026 The Hapnet authors
// SPDX-License-Identifier: MIT
#pragma once

#include "proto/plot/axis.hpp"

#include <cstddef>
#include <cstdint>
#include <span>
#include <string>
#include <string_view>
#include <vector>

namespace hapnet::plot {

struct Point {
    double x = 0.0;
    double y = 0.0;
};

enum class Stroke : std::uint8_t { solid, dashed, dotted };

/// A curve of a plot. Points that are not finite are left out.
struct Curve {
    std::string_view name;   // in the legend; empty: not there
    std::string_view colour; // as CSS writes it
    std::vector<Point> points{};
    Stroke stroke = Stroke::solid;
    double width = 1.2;        // pixels
    bool shows_points = false; // a dot at each
};

/// How the two axes are divided. A logarithmic one leaves out values that are not above zero.
struct Scales {
    Scale x = Scale::linear;
    Scale y = Scale::linear;
};

/// A value that a curve is held against: a dashed line across the plot.
struct Level {
    double y = 0.0;
    std::string_view name;
};

/// A point that is crossed: where something failed.
struct Cross {
    Point at;
    std::string_view colour;
};

struct PlotOptions {
    Scales scales{};
    Size size{};
    std::vector<Level> levels{};
    std::vector<Cross> crosses{};
    Range x{}; // what an axis spans besides the points
    Range y{};
};

/// At most about so many of the points of a curve, ascending in x: the lowest and the highest of
/// each stretch, so that no peak is lost.
[[nodiscard]] std::vector<Point> thinned(std::span<const Point> points, std::size_t count_max);

/// A plot as one SVG element with axes, round tick marks and a legend. The first curve lies on
/// top.
[[nodiscard]] std::string svg_plot(const PlotTitles& titles, std::span<const Curve> curves,
                                   const PlotOptions& options = {});

} // namespace hapnet::plot
