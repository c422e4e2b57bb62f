// SPDX-FileCopyrightText: 2026 The Hapnet authors
// SPDX-License-Identifier: MIT
#include "lab/core/plot.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <spdlog/fmt/fmt.h>

namespace hapnet::lab {

namespace {

// Pixels.
constexpr double width = 900.0;
constexpr double height = 280.0;
constexpr double left = 60.0;
constexpr double right = 15.0;
constexpr double top = 34.0;
constexpr double bottom = 44.0;

struct Range {
    double low = std::numeric_limits<double>::infinity();
    double high = -std::numeric_limits<double>::infinity();

    void include(double value)
    {
        low = std::min(low, value);
        high = std::max(high, value);
    }
};

bool is_finite(const Point& p) { return std::isfinite(p.x) && std::isfinite(p.y); }

/// The distance of tick marks that makes about `wanted` of them: 1, 2 or 5 times a power of ten.
double round_step(const Range& range, double wanted)
{
    const double rough = (range.high - range.low) / wanted;
    const double power = std::pow(10.0, std::floor(std::log10(rough)));
    for (const double factor : {1.0, 2.0, 5.0}) {
        if (factor * power >= rough) return factor * power;
    }
    return 10.0 * power;
}

/// A range that is not empty, whatever went in.
Range usable(Range range)
{
    if (!(range.low <= range.high)) return {0.0, 1.0};
    if (range.low == range.high) return {range.low - 0.5, range.high + 0.5};
    return range;
}

double legend_width(const Curve& curve)
{
    return 8.0 * static_cast<double>(curve.name.size()) + 16.0;
}

class Canvas {
public:
    Canvas(Range x, Range y) : x_{x}, y_{y} {}

    [[nodiscard]] double across(double x) const
    {
        return left + (width - left - right) * (x - x_.low) / (x_.high - x_.low);
    }
    [[nodiscard]] double down(double y) const
    {
        return height - bottom - (height - top - bottom) * (y - y_.low) / (y_.high - y_.low);
    }

    [[nodiscard]] std::string marks() const
    {
        std::string out;
        const double x_step = round_step(x_, 10.0), y_step = round_step(y_, 5.0);
        for (double x = std::ceil(x_.low / x_step) * x_step; x <= x_.high; x += x_step) {
            out += fmt::format("<text x='{:.1f}' y='{:.1f}' text-anchor='middle'>{:g}</text>\n",
                               across(x), height - bottom + 16.0, x);
        }
        for (double y = std::ceil(y_.low / y_step) * y_step; y <= y_.high; y += y_step) {
            const double mark = std::abs(y) < 1e-9 * y_step ? 0.0 : y;
            out += fmt::format("<line x1='{0}' x2='{1}' y1='{2:.1f}' y2='{2:.1f}' stroke='#ddd'/>\n"
                               "<text x='{3}' y='{4:.1f}' text-anchor='end'>{5:g}</text>\n",
                               left, width - right, down(y), left - 6.0, down(y) + 4.0, mark);
        }
        return out;
    }

    [[nodiscard]] std::string line(const Curve& curve) const
    {
        std::string points;
        for (const Point& p : curve.points) {
            if (is_finite(p)) points += fmt::format("{:.1f},{:.1f} ", across(p.x), down(p.y));
        }
        return fmt::format("<polyline fill='none' stroke='{}' stroke-width='1.2' points='{}'/>\n",
                           curve.colour, points);
    }

private:
    Range x_;
    Range y_;
};

} // namespace

std::string svg_plot(const PlotTitles& titles, std::span<const Curve> curves)
{
    Range x, y;
    for (const Curve& curve : curves) {
        for (const Point& p : curve.points) {
            if (!is_finite(p)) continue;
            x.include(p.x);
            y.include(p.y);
        }
    }
    const Canvas canvas{usable(x), usable(y)};
    std::string out = fmt::format(
        "<svg xmlns='http://www.w3.org/2000/svg' viewBox='0 0 {0} {1}' role='img'>\n"
        "<text x='{2}' y='16' font-weight='bold'>{3}</text>\n"
        "<text x='{4}' y='{5}' text-anchor='middle'>{6}</text>\n"
        "<text x='14' y='{7}' transform='rotate(-90 14 {7})' text-anchor='middle'>{8}</text>\n",
        width, height, left, titles.title, (left + width) / 2.0, height - 8.0, titles.x,
        (top + height - bottom) / 2.0, titles.y);
    out += canvas.marks();
    for (const Curve& curve : curves) out += canvas.line(curve);
    double legend = width - right;
    for (const Curve& curve : curves) legend -= legend_width(curve);
    for (const Curve& curve : curves) {
        out += fmt::format("<text x='{}' y='16' fill='{}'>{}</text>\n", legend, curve.colour,
                           curve.name);
        legend += legend_width(curve);
    }
    return out + "</svg>\n";
}

} // namespace hapnet::lab
