// SPDX-FileCopyrightText: 2026 The Hapnet authors
// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <limits>
#include <string>
#include <string_view>
#include <vector>

namespace hapnet::plot {

enum class Scale : std::uint8_t { linear, logarithmic };

/// What values span; empty until one is included.
struct Range {
    double low = std::numeric_limits<double>::infinity();
    double high = -std::numeric_limits<double>::infinity();

    [[nodiscard]] bool is_empty() const { return !(low <= high); }
    /// What is not finite is left out.
    void include(double value);
};

/// Where the two ends of an axis lie, in pixels.
struct Pixels {
    double from = 0.0;
    double to = 1.0;
};

/// A round value of an axis: where it stands, in pixels, and what it says.
struct Mark {
    double pixel = 0.0;
    std::string text;
};

/// One axis of a plot. A linear one spans exactly its range, a logarithmic one whole decades
/// around it; an empty range becomes one that can be drawn.
class Axis {
public:
    Axis(Scale scale, Range range, Pixels pixels);

    /// Not finite for what a logarithmic axis cannot show.
    [[nodiscard]] double pixel(double value) const;
    /// About `wanted` marks at 1, 2 or 5 times a power of ten.
    [[nodiscard]] std::vector<Mark> marks(double wanted) const;
    [[nodiscard]] Pixels pixels() const { return pixels_; }

private:
    Scale scale_;
    Range range_; // of exponents when logarithmic
    Pixels pixels_;
};

struct Size {
    double width = 900.0;
    double height = 280.0;
};

/// What stands around a plot. Any text: it is escaped.
struct PlotTitles {
    std::string_view title;
    std::string_view x;
    std::string_view y;
};

/// A name beside its colour (as CSS writes it) above a plot.
struct LegendEntry {
    std::string_view name;
    std::string_view colour;
};

/// The room that a plot leaves for its drawing, in pixels.
struct Margins {
    double left = 60.0;
    double right = 15.0;
    double top = 34.0;
    double bottom = 44.0;
};

/// A plot narrower than this has its legend in a line of its own below its title.
inline constexpr double legend_beside_title_min_px = 600.0;

/// The room for titles and a legend in a plot of that size.
[[nodiscard]] Margins margins_for(Size size, bool has_legend);

/// The opening of an SVG element with its titles and legend; `</svg>` is left to the caller.
[[nodiscard]] std::string svg_head(Size size, const PlotTitles& titles,
                                   const std::vector<LegendEntry>& legend);

/// Horizontal lines at the marks of a vertical axis, across the drawing, with their texts.
[[nodiscard]] std::string svg_grid(const Axis& y, Pixels across);

/// Text in which nothing is markup, for elements and for attributes in either quotes.
[[nodiscard]] std::string escaped(std::string_view text);

} // namespace hapnet::plot
