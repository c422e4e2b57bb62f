// SPDX-FileCopyrightText: 2026 The Hapnet authors
// SPDX-License-Identifier: MIT
#include "proto/plot/plot.hpp"

#include <algorithm>
#include <cmath>
#include <spdlog/fmt/fmt.h>

namespace hapnet::plot {

namespace {

bool can_show(const Scales& scales, const Point& p)
{
    return std::isfinite(p.x) && std::isfinite(p.y) && (scales.x == Scale::linear || p.x > 0.0) &&
           (scales.y == Scale::linear || p.y > 0.0);
}

std::string_view dashes(Stroke stroke)
{
    switch (stroke) {
    case Stroke::solid: break;
    case Stroke::dashed: return " stroke-dasharray='6 3'";
    case Stroke::dotted: return " stroke-dasharray='2 2'";
    }
    return "";
}

struct Axes {
    Axis x;
    Axis y;
};

Axes axes_of(std::span<const Curve> curves, const PlotOptions& options)
{
    Range x = options.x, y = options.y;
    for (const Curve& curve : curves) {
        for (const Point& p : curve.points) {
            if (!can_show(options.scales, p)) continue;
            x.include(p.x);
            y.include(p.y);
        }
    }
    for (const Level& level : options.levels) y.include(level.y);
    const Margins margins = margins_for(options.size, !curves.empty());
    return {Axis{options.scales.x, x, {margins.left, options.size.width - margins.right}},
            Axis{options.scales.y, y, {options.size.height - margins.bottom, margins.top}}};
}

/// What is drawn between the axes of a plot.
class Canvas {
public:
    Canvas(const Axes& axes, const PlotOptions& options) : options_{options}, x_{axes.x}, y_{axes.y}
    {}

    [[nodiscard]] std::string marks() const
    {
        std::string out;
        for (const Mark& mark : x_.marks(options_.size.width < 600.0 ? 5.0 : 10.0)) {
            out += fmt::format("<text x='{:.1f}' y='{:.1f}' text-anchor='middle'>{}</text>\n",
                               mark.pixel, y_.pixels().from + 16.0, mark.text);
        }
        return out + svg_grid(y_, x_.pixels());
    }

    [[nodiscard]] std::string line(const Curve& curve) const
    {
        std::string points, dots;
        for (const Point& p : curve.points) {
            if (!can_show(options_.scales, p)) continue;
            const double across = x_.pixel(p.x), down = y_.pixel(p.y);
            points += fmt::format("{:.1f},{:.1f} ", across, down);
            if (!curve.shows_points) continue;
            dots += fmt::format("<circle cx='{:.1f}' cy='{:.1f}' r='2.5' fill='{}'/>\n", across,
                                down, curve.colour);
        }
        return fmt::format("<polyline fill='none' stroke='{}' stroke-width='{}'{} "
                           "points='{}'/>\n",
                           curve.colour, curve.width, dashes(curve.stroke), points) +
               dots;
    }

    [[nodiscard]] std::string level(const Level& level) const
    {
        const double down = y_.pixel(level.y);
        if (!std::isfinite(down)) return "";
        return fmt::format("<line x1='{0}' x2='{1}' y1='{2:.1f}' y2='{2:.1f}' "
                           "stroke='currentColor' stroke-dasharray='4 4'/>\n"
                           "<text x='{3}' y='{4:.1f}' text-anchor='end'>{5}</text>\n",
                           x_.pixels().from, x_.pixels().to, down, x_.pixels().to - 4.0, down - 4.0,
                           escaped(level.name));
    }

    [[nodiscard]] std::string cross(const Cross& cross) const
    {
        if (!can_show(options_.scales, cross.at)) return "";
        return fmt::format("<path d='M{:.1f} {:.1f}m-6-6l12 12m0-12l-12 12' stroke='{}' "
                           "stroke-width='2.5' fill='none'/>\n",
                           x_.pixel(cross.at.x), y_.pixel(cross.at.y), cross.colour);
    }

private:
    const PlotOptions& options_;
    Axis x_;
    Axis y_;
};

} // namespace

std::vector<Point> thinned(std::span<const Point> points, std::size_t count_max)
{
    if (points.size() <= count_max) return {points.begin(), points.end()};
    const std::size_t stretches = std::max<std::size_t>(count_max / 2, 1);
    const std::size_t length = (points.size() + stretches - 1) / stretches;
    std::vector<Point> kept;
    for (std::size_t begin = 0; begin < points.size(); begin += length) {
        const auto part = points.subspan(begin, std::min(length, points.size() - begin));
        const auto [low, high] = std::minmax_element(
            part.begin(), part.end(), [](const Point& a, const Point& b) { return a.y < b.y; });
        kept.push_back(*std::min(low, high));
        if (low != high) kept.push_back(*std::max(low, high));
    }
    return kept;
}

std::string svg_plot(const PlotTitles& titles, std::span<const Curve> curves,
                     const PlotOptions& options)
{
    const Canvas canvas{axes_of(curves, options), options};
    std::vector<LegendEntry> legend;
    for (const Curve& curve : curves) {
        if (!curve.name.empty()) legend.push_back({curve.name, curve.colour});
    }
    std::string out = svg_head(options.size, titles, legend);
    out += canvas.marks();
    for (const Level& level : options.levels) out += canvas.level(level);
    std::string lines; // the first last: on top
    for (const Curve& curve : curves) lines.insert(0, canvas.line(curve));
    out += lines;
    for (const Cross& cross : options.crosses) out += canvas.cross(cross);
    return out + "</svg>\n";
}

} // namespace hapnet::plot
