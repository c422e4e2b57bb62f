// SPDX-FileCopyrightText: 2026 The Hapnet authors
// SPDX-License-Identifier: MIT
#include "emulator/core/delay/theory.hpp"
#include "emulator/tools/run_page/figures.hpp"
#include "proto/base/histogram.hpp"

#include <cmath>
#include <nlohmann/json.hpp>
#include <spdlog/fmt/fmt.h>
#include <vector>

namespace hapnet::emulator::tools {

namespace {

using Json = nlohmann::ordered_json;
using page::Curve;
using page::Point;

constexpr page::Size half_page{520.0, 280.0};

/// A stretch of values, and how many lie in it.
struct Bin {
    double low = 0.0;
    double high = 0.0;
    double count = 0.0;
};

/// What the statistics have written of a histogram: [[low, high, count], ...].
std::vector<Bin> bins_of(const Json& place)
{
    std::vector<Bin> bins;
    if (!place.is_object() || !place.contains("distribution")) return bins;
    for (const Json& one : place["distribution"]) {
        if (!one.is_array() || one.size() != 3) continue;
        bins.push_back({one[0].get<double>(), one[1].get<double>(), one[2].get<double>()});
    }
    return bins;
}

double ms_of(base::Duration duration) { return 1e3 * base::to_seconds(duration); }

std::vector<Bin> drawn_bins(std::span<const Fate> fates)
{
    base::DurationHistogram histogram;
    for (const Fate& fate : fates) {
        if (!fate.drop) histogram.add(fate.delay);
    }
    std::vector<Bin> bins;
    for (const auto& bin : histogram.filled_bins()) {
        bins.push_back({ms_of(bin.low), ms_of(bin.high), static_cast<double>(bin.count)});
    }
    return bins;
}

/// A density as stairs: no bin is hidden in a slope.
std::vector<Point> stairs_of(const std::vector<Bin>& bins)
{
    double all = 0.0;
    for (const Bin& bin : bins) all += bin.count;
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

/// The law's density over the same bins; empty where delay and jitter both vary, or neither does.
std::vector<Point> law_of(const Conditions& conditions, const std::vector<Bin>& bins)
{
    DelayTheory delay{conditions.delay.law};
    DelayTheory jitter{conditions.jitter.law};
    if (delay.constant().has_value() == jitter.constant().has_value()) return {};
    DelayTheory& varying = delay.constant() ? jitter : delay;
    const base::Duration shift = delay.constant() ? *delay.constant() : *jitter.constant();
    const auto below = [&](double ms) {
        return ms <= 0.0 ? 0.0 : varying.share_below(base::from_seconds(ms * 1e-3) - shift);
    };
    std::vector<Point> points;
    for (const Bin& bin : bins) {
        if (bin.high <= bin.low) continue;
        points.push_back({(bin.low + bin.high) / 2.0,
                          (below(bin.high) - below(bin.low)) / (bin.high - bin.low)});
    }
    return points;
}

} // namespace

std::optional<page::Figure> delay_figure(const RunDirection& run)
{
    const Json lens = run.statistics.value("lens", Json::object());
    const auto measured = bins_of(lens.value("delay_ms", Json{}));
    const auto drawn = drawn_bins(run.fates);
    if (measured.empty() && drawn.empty()) return std::nullopt;
    std::vector<Curve> curves{
        {.name = "as drawn", .colour = "left", .points = stairs_of(drawn), .width = 2.4},
        {.name = "as it came out", .colour = "right", .points = stairs_of(measured), .width = 1.6}};
    if (run.conditions != nullptr) {
        auto law = law_of(*run.conditions, drawn.empty() ? measured : drawn);
        if (!law.empty()) {
            curves.insert(
                curves.begin(),
                {.name = "law", .colour = "muted", .points = std::move(law), .is_dashed = true});
        }
    }
    return page::Figure{.id = fmt::format("delay-{}", to_text(run.direction)),
                        .title = fmt::format("Delay, {}", to_text(run.direction)),
                        .x = {"delay", "ms"},
                        .y = {"share per ms", "", page::Scale::linear, {0.0, 0.0}},
                        .content = page::Curves{std::move(curves)},
                        .size = half_page,
                        .caption =
                            "As drawn from the law, and as it came out after queues, order and the "
                            "emulator's own lateness. The bins are 1.6 % wide."};
}

std::optional<page::Figure> lateness_figure(const RunDirection& run, double budget_us)
{
    const auto bins = bins_of(run.statistics.value("lateness_us", Json{}));
    if (bins.empty()) return std::nullopt;
    double all = 0.0;
    for (const Bin& bin : bins) all += bin.count;
    std::vector<Point> points;
    double seen = 0.0;
    for (const Bin& bin : bins) {
        seen += bin.count;
        points.push_back({bin.high, seen / all});
    }
    std::vector<Curve> curves{{.name = "share at most so late",
                               .colour = "left",
                               .points = std::move(points),
                               .width = 2.0},
                              {.name = "budget",
                               .colour = "missed",
                               .points = {{budget_us, 0.0}, {budget_us, 1.0}},
                               .is_dashed = true}};
    return page::Figure{
        .id = fmt::format("lateness-{}", to_text(run.direction)),
        .title = fmt::format("Lateness of the emulator, {}", to_text(run.direction)),
        .x = {"lateness", "µs", page::Scale::logarithmic},
        .y = {"share", "", page::Scale::linear, {0.0, 1.0}},
        .content = page::Curves{std::move(curves), {{0.99, "99 %"}}},
        .size = half_page,
        .caption = "Time sent minus time due. The run is valid when the curve has reached 99 % at "
                   "the budget."};
}

} // namespace hapnet::emulator::tools
