// SPDX-FileCopyrightText: 2026 The Hapnet authors
// SPDX-License-Identifier: MIT
#include "lab/core/plot/plot.hpp"

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

/// Whole powers of ten around what went in; the values are their exponents.
Range decades(Range range)
{
    if (!(range.low <= range.high)) return {0.0, 1.0};
    const double low = std::floor(range.low);
    return {low, std::max(std::ceil(range.high), low + 1.0)};
}

/// Where the marks of an axis stand, and what they say.
struct Marks {
    Scale scale;
    double step;

    Marks(Scale of, const Range& range, double wanted)
        : scale{of},
          step{of == Scale::linear ? round_step(range, wanted)
                                   : std::ceil((range.high - range.low) / (2.0 * wanted))}
    {}

    [[nodiscard]] std::string text(double at) const
    {
        if (scale == Scale::logarithmic) return fmt::format("1e{:g}", at);
        return fmt::format("{:g}", at);
    }
};

/// What is drawn of a value.
double drawn(Scale scale, double value)
{
    return scale == Scale::linear ? value : value > 0.0 ? std::log10(value) : std::nan("");
}

double legend_width(const Curve& curve)
{
    return 8.0 * static_cast<double>(curve.name.size()) + 16.0;
}

class Canvas {
public:
    Canvas(Range x, Range y, Scales scales)
        : x_{scales.x == Scale::linear ? usable(x) : decades(x)},
          y_{scales.y == Scale::linear ? usable(y) : decades(y)},
          scales_{scales}
    {}

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
        const Marks x_marks{scales_.x, x_, 10.0}, y_marks{scales_.y, y_, 5.0};
        const double x_step = x_marks.step, y_step = y_marks.step;
        for (double x = std::ceil(x_.low / x_step) * x_step; x <= x_.high; x += x_step) {
            out += fmt::format("<text x='{:.1f}' y='{:.1f}' text-anchor='middle'>{}</text>\n",
                               across(x), height - bottom + 16.0, x_marks.text(x));
        }
        for (double y = std::ceil(y_.low / y_step) * y_step; y <= y_.high; y += y_step) {
            const double mark = std::abs(y) < 1e-9 * y_step ? 0.0 : y;
            out += fmt::format("<line x1='{0}' x2='{1}' y1='{2:.1f}' y2='{2:.1f}' stroke='#ddd'/>\n"
                               "<text x='{3}' y='{4:.1f}' text-anchor='end'>{5}</text>\n",
                               left, width - right, down(y), left - 6.0, down(y) + 4.0,
                               y_marks.text(mark));
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
    Scales scales_;
};

} // namespace

std::string svg_plot(const PlotTitles& titles, std::span<const Curve> curves, Scales scales)
{
    Range x, y;
    std::vector<Curve> drawn_curves{curves.begin(), curves.end()};
    for (Curve& curve : drawn_curves) {
        for (Point& p : curve.points) {
            p = {drawn(scales.x, p.x), drawn(scales.y, p.y)};
            if (!is_finite(p)) continue;
            x.include(p.x);
            y.include(p.y);
        }
    }
    const Canvas canvas{x, y, scales};
    std::string out = fmt::format(
        "<svg xmlns='http://www.w3.org/2000/svg' viewBox='0 0 {0} {1}' role='img'>\n"
        "<text x='{2}' y='16' font-weight='bold'>{3}</text>\n"
        "<text x='{4}' y='{5}' text-anchor='middle'>{6}</text>\n"
        "<text x='14' y='{7}' transform='rotate(-90 14 {7})' text-anchor='middle'>{8}</text>\n",
        width, height, left, titles.title, (left + width) / 2.0, height - 8.0, titles.x,
        (top + height - bottom) / 2.0, titles.y);
    out += canvas.marks();
    for (const Curve& curve : drawn_curves) out += canvas.line(curve);
    double legend = width - right;
    for (const Curve& curve : drawn_curves) legend -= legend_width(curve);
    for (const Curve& curve : drawn_curves) {
        out += fmt::format("<text x='{}' y='16' fill='{}'>{}</text>\n", legend, curve.colour,
                           curve.name);
        legend += legend_width(curve);
    }
    return out + "</svg>\n";
}

} // namespace hapnet::lab
