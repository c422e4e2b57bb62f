// SPDX-FileCopyrightText: 2026 The Hapnet authors
// SPDX-License-Identifier: MIT
#include "proto/page/distribution.hpp"

#include <algorithm>
#include <cmath>
#include <spdlog/fmt/fmt.h>
#include <utility>

namespace hapnet::page {

namespace {

constexpr Size half_page{520.0, 280.0};

double count_of(std::span<const Bin> bins)
{
    double all = 0.0;
    for (const Bin& bin : bins) all += bin.count;
    return all;
}

} // namespace

std::vector<Bin> without_narrow(std::vector<Bin> bins)
{
    constexpr std::size_t count = 200;
    if (bins.empty()) return bins;
    const double begin = bins.front().low;
    const double width = (bins.back().high - begin) / count;
    const auto is_narrow = [&](const Bin& bin) { return bin.high - bin.low < width / 2; };
    if (std::ranges::none_of(bins, is_narrow)) return bins;
    std::vector<Bin> even;
    for (std::size_t i = 0; i < count; ++i) {
        const double low = begin + static_cast<double>(i) * width;
        even.push_back({low, low + width, 0.0});
    }
    const auto place_of = [&](double value) {
        return std::min(static_cast<std::size_t>((value - begin) / width), count - 1);
    };
    for (const Bin& bin : bins) {
        const std::size_t last = place_of(bin.high);
        for (std::size_t i = place_of(bin.low); i <= last; ++i) {
            const double low = std::max(bin.low, even[i].low);
            const double high = i == count - 1 ? bin.high : std::min(bin.high, even[i].high);
            const double share = bin.high > bin.low ? (high - low) / (bin.high - bin.low) : 1.0;
            if (share > 0.0) even[i].count += share * bin.count;
        }
    }
    std::erase_if(even, [](const Bin& bin) { return bin.count == 0.0; });
    return even;
}

std::vector<Point> density_of(std::span<const Bin> bins)
{
    const double all = count_of(bins);
    std::vector<Point> points;
    double last = std::nan("");
    for (const Bin& bin : bins) {
        if (bin.high <= bin.low) continue;
        const double density = bin.count / all / (bin.high - bin.low);
        if (bin.low != last) {
            if (!points.empty()) points.push_back({last, 0.0});
            points.push_back({bin.low, 0.0});
        }
        points.push_back({bin.low, density});
        points.push_back({bin.high, density});
        last = bin.high;
    }
    if (!points.empty()) points.push_back({last, 0.0});
    return points;
}

std::vector<Point> shares_below(std::span<const Bin> bins)
{
    const double all = count_of(bins);
    std::vector<Point> points;
    double seen = 0.0;
    for (const Bin& bin : bins) {
        seen += bin.count;
        points.push_back({bin.high, seen / all});
    }
    return points;
}

std::vector<Point> shares_at_most(std::vector<double> values, std::size_t count_max)
{
    if (values.empty()) return {};
    std::ranges::sort(values);
    std::vector<Point> points{{values.front(), 0.0}};
    for (std::size_t i = 0; i < values.size(); ++i) {
        const double share = static_cast<double>(i + 1) / static_cast<double>(values.size());
        const bool is_last_of_equals = i + 1 == values.size() || values[i + 1] > values[i];
        if (is_last_of_equals) points.push_back({values[i], share});
    }
    return thinned(points, count_max);
}

Figure lateness_figure(std::string id, std::string_view things, std::vector<Curve> shares,
                       double budget_us)
{
    shares.push_back({.name = "budget",
                      .colour = "missed",
                      .points = {{budget_us, 0.0}, {budget_us, 1.0}},
                      .is_dashed = true});
    return {.id = std::move(id),
            .title = "",
            .x = {"lateness", "µs", Scale::logarithmic},
            .y = {fmt::format("share of the {}", things), "1", Scale::linear, {0.0, 1.0}},
            .content = Curves{std::move(shares), {{0.99, "99 %"}}},
            .size = half_page};
}

std::vector<Curve> parts_of(const Curve& curve)
{
    const auto is_value = [](const Point& point) { return std::isfinite(point.y); };
    const auto& points = curve.points;
    std::vector<Curve> parts;
    auto from = std::ranges::find_if(points, is_value);
    while (from != points.end()) {
        const auto to = std::find_if_not(from, points.end(), is_value);
        Curve& part = parts.emplace_back(curve);
        part.points.assign(from, to);
        std::erase_if(part.band, [&](const BandPoint& one) {
            return one.x < part.points.front().x || one.x > part.points.back().x;
        });
        from = std::find_if(to, points.end(), is_value);
    }
    return parts;
}

} // namespace hapnet::page
