// SPDX-FileCopyrightText: 2026 The Hapnet authors
// SPDX-License-Identifier: MIT
#include "lab/report/path_figures.hpp"

#include "proto/page/distribution.hpp"

#include <algorithm>
#include <cmath>
#include <iterator>
#include <limits>
#include <spdlog/fmt/fmt.h>
#include <string>
#include <string_view>
#include <utility>

namespace hapnet::lab::report {

namespace {

using records::PathOverTime;
using records::PathsOverTime;
using records::PathStretch;

constexpr page::Size half_page{520.0, 280.0};
constexpr double gap = std::numeric_limits<double>::quiet_NaN();

/// Calls draw(curve, path) for both directions, each with its own style.
template <typename Draw>
void for_each_way(const PathsOverTime& paths, const Draw& draw)
{
    draw(page::Curve{.name = "A to B", .colour = "left", .width = 2.0}, paths.a_to_b);
    draw(page::Curve{.name = "B to A", .colour = "right", .width = 2.0, .is_dashed = true},
         paths.b_to_a);
}

void add_delay(page::Curve& curve, const PathStretch& stretch)
{
    const double middle = (stretch.from_s + stretch.to_s) / 2.0;
    const auto& delay = stretch.delay_ms;
    curve.points.push_back({middle, delay ? delay->median : gap});
    if (delay) curve.band.push_back({middle, {delay->low, delay->high}});
}

/// Adds a stair: it is unknown when within the stretch the messages were lost.
void add_loss(page::Curve& curve, const PathStretch& stretch)
{
    const double percent = 100.0 * stretch.loss().value_or(gap);
    curve.points.push_back({stretch.from_s, percent});
    curve.points.push_back({stretch.to_s, percent});
}

std::vector<page::Curve> curves_over_time(const PathsOverTime& paths,
                                          void (*add)(page::Curve&, const PathStretch&))
{
    std::vector<page::Curve> curves;
    for_each_way(paths, [&](page::Curve curve, const PathOverTime& path) {
        for (const PathStretch& stretch : path.stretches) add(curve, stretch);
        std::ranges::move(page::parts_of(curve), std::back_inserter(curves));
    });
    return curves;
}

bool is_empty(const PathsOverTime& paths)
{
    return paths.a_to_b.delays_ms.empty() && paths.b_to_a.delays_ms.empty();
}

/// Warns how many messages appear to have arrived before they were sent; "" if none.
std::string warning_of(const PathsOverTime& paths)
{
    std::size_t count = 0;
    for (const PathOverTime* path : {&paths.a_to_b, &paths.b_to_a})
        count += static_cast<std::size_t>(
            std::ranges::count_if(path->delays_ms, [](double ms) { return ms < 0.0; }));
    if (count == 0) return "";
    return fmt::format(" {} messages seem to have come before they were sent: the clocks are not "
                       "known well enough for these delays.",
                       count);
}

} // namespace

std::vector<page::Figure> path_figures(const PathsOverTime& paths, std::string_view arrival)
{
    if (is_empty(paths)) return {};
    std::vector<page::Figure> figures;
    const auto add = [&](std::string_view id, std::string title, page::Axis y,
                         void (*values)(page::Curve&, const PathStretch&), std::string caption) {
        figures.push_back({.id = std::string{id},
                           .title = std::move(title),
                           .x = {.label = "time from the start", .unit = "s"},
                           .y = std::move(y),
                           .content = page::Curves{curves_over_time(paths, values)},
                           .size = plot_size,
                           .caption = std::move(caption)});
    };
    add("delay", "One-way delay", {"delay", "ms", page::Scale::linear, {0.0, 0.0}}, add_delay,
        fmt::format(
            "From the sender’s stamp to {}, of the messages sent in each {:g} s: the line is their "
            "median, the band goes from the lowest to the highest. There is no line where none "
            "came.{}",
            arrival, paths.stretch_s, warning_of(paths)));
    add("loss", "Lost messages", {"lost", "%", page::Scale::linear, {0.0, 1.0}}, add_loss,
        fmt::format("Share of the messages sent in each {:g} s that never came, up to the last one "
                    "that did. There is no line where none was sent.",
                    paths.stretch_s));
    return figures;
}

std::vector<page::Figure> delay_distribution(const PathsOverTime& paths)
{
    if (is_empty(paths)) return {};
    std::vector<page::Curve> curves;
    for_each_way(paths, [&](page::Curve curve, const PathOverTime& path) {
        if (path.delays_ms.empty()) return;
        curve.points = page::shares_at_most(path.delays_ms, share_points_max);
        curves.push_back(std::move(curve));
    });
    return {{.id = "delays",
             .title = "Distribution of the one-way delay",
             .x = {"delay", "ms"},
             .y = {"share of the messages", "1", page::Scale::linear, {0.0, 1.0}},
             .content = page::Curves{std::move(curves)},
             .size = half_page,
             .caption = "Share of the messages that came and took at most so long."}};
}

} // namespace hapnet::lab::report
