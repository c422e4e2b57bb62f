// SPDX-FileCopyrightText: 2026 The Hapnet authors
// SPDX-License-Identifier: MIT
#include "emulator/core/delay/theory.hpp"
#include "emulator/tools/run_page/figures.hpp"
#include "proto/base/histogram.hpp"
#include "proto/page/distribution.hpp"

#include <nlohmann/json.hpp>
#include <spdlog/fmt/fmt.h>
#include <vector>

namespace hapnet::emulator::tools {

namespace {

using Json = nlohmann::ordered_json;
using page::Bin;
using page::Curve;
using page::Point;

constexpr page::Size half_page{520.0, 280.0};

/// Returns the bins of a histogram in the statistics: [[low, high, count], ...].
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

/// Returns the law's density over the same bins; empty if delay and jitter both vary, or neither
/// does.
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
    const auto measured = page::without_narrow(bins_of(lens.value("delay_ms", Json{})));
    const auto drawn = page::without_narrow(drawn_bins(run.fates));
    if (measured.empty() && drawn.empty()) return std::nullopt;
    std::vector<Curve> curves{
        {.name = "as drawn", .colour = "left", .points = page::density_of(drawn), .width = 2.4},
        {.name = "as it came out",
         .colour = "right",
         .points = page::density_of(measured),
         .width = 1.6}};
    if (run.conditions != nullptr) {
        auto law = law_of(*run.conditions, drawn.empty() ? measured : drawn);
        if (!law.empty()) {
            curves.insert(
                curves.begin(),
                {.name = "law", .colour = "muted", .points = std::move(law), .is_dashed = true});
        }
    }
    return page::Figure{.id = fmt::format("delay-{}", to_text(run.direction)),
                        .title = fmt::format("Delay, {}", words_on(run.direction)),
                        .x = {"delay", "ms"},
                        .y = {"share of the datagrams", "1/ms", page::Scale::linear, {0.0, 0.0}},
                        .content = page::Curves{std::move(curves)},
                        .size = half_page,
                        .caption =
                            fmt::format("{}As drawn from the law, and as it came out after queues, "
                                        "order and the emulator's own lateness. The bins are 1.6 % "
                                        "wide, or a 200th of the axis where those would be too "
                                        "narrow to be seen.",
                                        run.conditions == nullptr
                                            ? "All conditions of the run together: what a change "
                                              "shifts is no jitter. "
                                            : "")};
}

std::optional<page::Figure> lateness_figure(const RunDirection& run, double budget_us)
{
    const auto bins = bins_of(run.statistics.value("lateness_us", Json{}));
    if (bins.empty()) return std::nullopt;
    page::Figure figure =
        page::lateness_figure(fmt::format("lateness-{}", to_text(run.direction)), "datagrams",
                              {{.name = "share at most so late",
                                .colour = "left",
                                .points = page::shares_below(bins),
                                .width = 2.0}},
                              budget_us);
    figure.title = fmt::format("Lateness of the emulator, {}", words_on(run.direction));
    figure.caption = "Time sent minus time due. The run is valid when the curve has reached 99 % "
                     "at the budget.";
    return figure;
}

} // namespace hapnet::emulator::tools
