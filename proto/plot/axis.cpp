// SPDX-FileCopyrightText: 2026 The Hapnet authors
// SPDX-License-Identifier: MIT
#include "proto/plot/axis.hpp"

#include <algorithm>
#include <cmath>
#include <spdlog/fmt/fmt.h>

namespace hapnet::plot {

namespace {

/// The distance of marks that makes about `wanted` of them: 1, 2 or 5 times a power of ten.
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
Range drawable(Range range)
{
    if (range.is_empty()) return {0.0, 1.0};
    if (range.low == range.high) return {range.low - 0.5, range.high + 0.5};
    return range;
}

/// Exponents of whole powers of ten around what went in.
Range decades(Range range)
{
    if (range.is_empty() || !(range.high > 0.0)) return {0.0, 1.0};
    const double high = std::ceil(std::log10(range.high));
    const double low = range.low > 0.0 ? std::floor(std::log10(range.low)) : high - 3.0;
    return {low, std::max(high, low + 1.0)};
}

/// A power of ten: "0.01", "100", beyond a thousand "1e4".
std::string power_text(double exponent)
{
    return std::abs(exponent) <= 3.0 ? fmt::format("{:g}", std::pow(10.0, exponent))
                                     : fmt::format("1e{:g}", exponent);
}

double legend_width(const LegendEntry& entry)
{
    return 8.0 * static_cast<double>(entry.name.size()) + 16.0;
}

} // namespace

void Range::include(double value)
{
    if (!std::isfinite(value)) return;
    low = std::min(low, value);
    high = std::max(high, value);
}

Axis::Axis(Scale scale, Range range, Pixels pixels)
    : scale_{scale},
      range_{scale == Scale::linear ? drawable(range) : decades(range)},
      pixels_{pixels}
{}

double Axis::pixel(double value) const
{
    const double at = scale_ == Scale::linear ? value
                      : value > 0.0           ? std::log10(value)
                                              : std::nan("");
    return pixels_.from +
           (pixels_.to - pixels_.from) * (at - range_.low) / (range_.high - range_.low);
}

std::vector<Mark> Axis::marks(double wanted) const
{
    std::vector<Mark> marks;
    const double span = range_.high - range_.low;
    const double step =
        scale_ == Scale::linear ? round_step(range_, wanted) : std::ceil(span / (2.0 * wanted));
    for (double at = std::ceil(range_.low / step) * step; at <= range_.high; at += step) {
        const double value = std::abs(at) < 1e-9 * step ? 0.0 : at;
        marks.push_back({pixels_.from + (pixels_.to - pixels_.from) * (value - range_.low) / span,
                         scale_ == Scale::linear ? fmt::format("{:g}", value) : power_text(value)});
    }
    return marks;
}

Margins margins_for(Size size, bool has_legend)
{
    Margins margins;
    if (has_legend && size.width < legend_beside_title_min_px) margins.top += 18.0;
    return margins;
}

std::string svg_head(Size size, const PlotTitles& titles, const std::vector<LegendEntry>& legend)
{
    const Margins margins = margins_for(size, !legend.empty());
    const double middle = (margins.top + size.height - margins.bottom) / 2.0;
    std::string out = fmt::format(
        "<svg xmlns='http://www.w3.org/2000/svg' viewBox='0 0 {0} {1}' role='img' "
        "aria-label='{3}'>\n"
        "<text x='{2}' y='16' font-weight='bold'>{3}</text>\n"
        "<text x='{4}' y='{5}' text-anchor='middle'>{6}</text>\n"
        "<text x='14' y='{7}' transform='rotate(-90 14 {7})' text-anchor='middle'>{8}</text>\n",
        size.width, size.height, margins.left, escaped(titles.title),
        (margins.left + size.width) / 2.0, size.height - 8.0, escaped(titles.x), middle,
        escaped(titles.y));
    const bool is_beside = size.width >= legend_beside_title_min_px;
    double across = is_beside ? size.width - margins.right : margins.left;
    if (is_beside) {
        for (const LegendEntry& entry : legend) across -= legend_width(entry);
    }
    for (const LegendEntry& entry : legend) {
        out += fmt::format("<text x='{}' y='{}' fill='{}'>{}</text>\n", across, is_beside ? 16 : 34,
                           entry.colour, escaped(entry.name));
        across += legend_width(entry);
    }
    return out;
}

std::string svg_grid(const Axis& y, Pixels across)
{
    std::string out;
    for (const Mark& mark : y.marks(5.0)) {
        out += fmt::format("<line x1='{0}' x2='{1}' y1='{2:.1f}' y2='{2:.1f}' "
                           "stroke='currentColor' stroke-opacity='.15'/>\n"
                           "<text x='{3}' y='{4:.1f}' text-anchor='end'>{5}</text>\n",
                           across.from, across.to, mark.pixel, across.from - 6.0, mark.pixel + 4.0,
                           mark.text);
    }
    return out;
}

std::string escaped(std::string_view text)
{
    std::string out;
    for (const char c : text) {
        switch (c) {
        case '<': out += "&lt;"; break;
        case '>': out += "&gt;"; break;
        case '&': out += "&amp;"; break;
        case '\'': out += "&#39;"; break;
        case '"': out += "&quot;"; break;
        default: out += c;
        }
    }
    return out;
}

} // namespace hapnet::plot
