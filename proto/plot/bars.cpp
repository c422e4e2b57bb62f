// SPDX-FileCopyrightText: 2026 The Hapnet authors
// SPDX-License-Identifier: MIT
#include "proto/plot/bars.hpp"

#include <algorithm>
#include <cmath>
#include <spdlog/fmt/fmt.h>

namespace hapnet::plot {

namespace {

constexpr double bar_width_max = 48.0; // pixels
constexpr double head_room = 1.12;     // for the label above the highest bar

/// A bar's place: its left edge and width, its top and its bottom, in pixels.
struct Place {
    double left;
    double width;
    double top;
    double bottom;
};

std::string shape(const Bar& bar, const Place& place)
{
    const double right = place.left + place.width;
    // An open bar ends in an arrow and has no edge there.
    const double shoulder = bar.is_open ? std::min(place.top + 8.0, place.bottom) : place.top;
    const std::string outline =
        bar.is_open
            ? fmt::format("M{0:.1f} {3:.1f}V{2:.1f}L{4:.1f} {5:.1f}L{1:.1f} {2:.1f}V{3:.1f}",
                          place.left, right, shoulder, place.bottom, place.left + place.width / 2.0,
                          place.top)
            : fmt::format("M{0:.1f} {3:.1f}V{2:.1f}H{1:.1f}V{3:.1f}", place.left, right, shoulder,
                          place.bottom);
    return fmt::format("<path d='{}' fill='{}' fill-opacity='{}' stroke='{}'{}/>", outline,
                       bar.colour, bar.is_outlined ? 0.12 : 0.85, bar.colour,
                       bar.is_outlined ? " stroke-dasharray='4 2'" : "");
}

/// So small that a label is about as wide as its bar, but not illegible.
double font_size(const Bar& bar, const Place& place)
{
    constexpr double usual = 12.0, least = 8.0, width_per_size = 0.62; // of a character
    const auto characters = static_cast<double>(std::max<std::size_t>(bar.label.size(), 1));
    return std::clamp(1.1 * place.width / (width_per_size * characters), least, usual);
}

/// The two ends of an interval, in pixels, and the line between them.
std::string whisker(const Bar& bar, const Place& place, const Axis& y)
{
    if (!bar.interval) return "";
    const double middle = place.left + place.width / 2.0;
    return fmt::format("<path d='M{0:.1f} {1:.1f}V{2:.1f}M{3:.1f} {1:.1f}h8M{3:.1f} {2:.1f}h8' "
                       "stroke='currentColor' stroke-width='1.2' fill='none'/>",
                       middle, y.pixel(bar.interval->low), y.pixel(bar.interval->high),
                       middle - 4.0);
}

std::string drawn_bar(const Bar& bar, const Place& place, const Axis& y)
{
    const double top = bar.interval ? std::min(place.top, y.pixel(bar.interval->high)) : place.top;
    return fmt::format(
        "<g><title>{}</title>{}{}<text x='{:.1f}' y='{:.1f}' text-anchor='middle' "
        "font-size='{:.1f}'{}>{}</text></g>\n",
        escaped(bar.tip.empty() ? bar.label : bar.tip), shape(bar, place), whisker(bar, place, y),
        place.left + place.width / 2.0, top - 4.0, font_size(bar, place),
        bar.is_missed ? " fill='var(--missed)' font-weight='bold'" : "", escaped(bar.label));
}

} // namespace

std::string svg_bars(const PlotTitles& titles, const std::vector<BarGroup>& groups,
                     const std::vector<LegendEntry>& legend, Size size)
{
    const Margins margins = margins_for(size, !legend.empty());
    Range range{0.0, 0.0};
    for (const BarGroup& group : groups) {
        for (const Bar& bar : group.bars) {
            range.include(head_room * bar.value);
            if (bar.interval) range.include(head_room * bar.interval->high);
        }
    }
    const Axis y{Scale::linear,
                 {0.0, range.high > 0.0 ? range.high : 1.0},
                 {size.height - margins.bottom, margins.top}};
    const Pixels across{margins.left, size.width - margins.right};
    std::string out = svg_head(size, titles, legend) + svg_grid(y, across);
    const auto count = static_cast<double>(std::max<std::size_t>(groups.size(), 1));
    const double room = (across.to - across.from) / count;
    double left = across.from;
    for (const BarGroup& group : groups) {
        const auto bars = static_cast<double>(std::max<std::size_t>(group.bars.size(), 1));
        const double step = std::min(0.85 * room / bars, bar_width_max);
        double at = left + (room - step * bars) / 2.0;
        for (const Bar& bar : group.bars) {
            if (std::isfinite(bar.value)) {
                const Place place{at + 0.05 * step, 0.9 * step, y.pixel(bar.value),
                                  y.pixels().from};
                out += drawn_bar(bar, place, y);
            }
            at += step;
        }
        out += fmt::format("<text x='{:.1f}' y='{:.1f}' text-anchor='middle'>{}</text>\n",
                           left + room / 2.0, y.pixels().from + 16.0, escaped(group.name));
        left += room;
    }
    return out + "</svg>\n";
}

} // namespace hapnet::plot
