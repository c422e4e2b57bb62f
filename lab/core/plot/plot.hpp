// SPDX-FileCopyrightText: 2026 The Hapnet authors
// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <span>
#include <string>
#include <string_view>
#include <vector>

namespace hapnet::lab {

struct Point {
    double x = 0.0;
    double y = 0.0;
};

/// A curve of a plot. Points that are not finite are left out.
struct Curve {
    std::string_view name;
    std::string_view colour; // as CSS writes it
    std::vector<Point> points;
};

struct PlotTitles {
    std::string_view title;
    std::string_view x;
    std::string_view y;
};

enum class Scale : std::uint8_t { linear, logarithmic };

/// How the two axes are divided. On a logarithmic one what is not above zero is left out.
struct Scales {
    Scale x = Scale::linear;
    Scale y = Scale::linear;
};

/// A plot as one SVG element with axes, round tick marks and a legend. Titles and names must not
/// contain <, > or &.
[[nodiscard]] std::string svg_plot(const PlotTitles& titles, std::span<const Curve> curves,
                                   Scales scales = {});

} // namespace hapnet::lab
