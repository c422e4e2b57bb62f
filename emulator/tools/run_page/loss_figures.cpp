// SPDX-FileCopyrightText: 2026 The Hapnet authors
// SPDX-License-Identifier: MIT
#include "emulator/core/loss/loss.hpp"
#include "emulator/tools/run_page/figures.hpp"

#include <algorithm>
#include <cmath>
#include <nlohmann/json.hpp>
#include <spdlog/fmt/fmt.h>
#include <vector>

namespace hapnet::emulator::tools {

namespace {

using page::Point;

constexpr page::Size half_page_of_runs{520.0, 280.0};
constexpr page::Size strip_size{900.0, 96.0};
constexpr std::size_t cells_max = 120;

/// Returns the number of runs of losses of each length; the first place is that of length 1.
std::vector<std::uint64_t> run_lengths(std::span<const Fate> fates)
{
    std::vector<std::uint64_t> counts;
    std::size_t run = 0;
    const auto close = [&] {
        if (run == 0) return;
        if (counts.size() < run) counts.resize(run);
        ++counts[run - 1];
        run = 0;
    };
    for (const Fate& fate : fates) {
        if (fate.is_lost()) {
            ++run;
        } else {
            close();
        }
    }
    close();
    return counts;
}

/// Returns the share of runs that have at least each length.
std::vector<Point> at_least(const std::vector<std::uint64_t>& counts)
{
    double left = 0.0;
    for (const auto count : counts) left += static_cast<double>(count);
    const double all = left;
    std::vector<Point> points;
    for (std::size_t i = 0; i < counts.size(); ++i) {
        if (counts[i] > 0) points.push_back({static_cast<double>(i + 1), left / all});
        left -= static_cast<double>(counts[i]);
    }
    return points;
}

/// Returns the opacity of a field: from nearly nothing without losses to a full colour for losses
/// only.
double opacity_of(std::size_t lost, std::size_t all)
{
    constexpr double steps = 5.0;
    if (lost == 0) return 0.04;
    return std::ceil(steps * static_cast<double>(lost) / static_cast<double>(all)) / steps;
}

} // namespace

std::optional<page::Figure> loss_figure(const RunDirection& run)
{
    if (std::none_of(run.fates.begin(), run.fates.end(),
                     [](const Fate& fate) { return fate.is_lost(); }))
        return std::nullopt;
    const std::size_t length = (run.fates.size() + cells_max - 1) / cells_max;
    page::HeatMap strip;
    strip.rows.emplace_back(to_text(run.direction));
    for (std::size_t begin = 0; begin < run.fates.size(); begin += length) {
        const auto part = run.fates.subspan(begin, std::min(length, run.fates.size() - begin));
        const auto lost = static_cast<std::size_t>(std::count_if(
            part.begin(), part.end(), [](const Fate& fate) { return fate.is_lost(); }));
        const std::size_t column = strip.columns.size();
        strip.columns.push_back(column % 20 == 0 ? fmt::format("{}", begin) : "");
        strip.cells.push_back({.column = column,
                               .colour = "missed",
                               .opacity = opacity_of(lost, part.size()),
                               .tip = fmt::format("datagrams {} to {}: {} of {} lost", begin,
                                                  begin + part.size() - 1, lost, part.size())});
    }
    return page::Figure{
        .id = fmt::format("losses-{}", to_text(run.direction)),
        .title = fmt::format("Losses, {}", words_on(run.direction)),
        .x = {"number of the datagram"},
        .y = {"lost"},
        .content = std::move(strip),
        .size = strip_size,
        .caption = fmt::format("Each field stands for {} datagrams; the redder, the more of them "
                               "the laws dropped. Rest the pointer on a field for its numbers.",
                               length)};
}

std::optional<page::Figure> loss_runs_figure(const RunDirection& run)
{
    const auto counts = run_lengths(run.fates);
    if (counts.empty()) return std::nullopt;
    std::vector<page::Curve> curves{{.name = "this run",
                                     .colour = "missed",
                                     .points = at_least(counts),
                                     .width = 1.6,
                                     .shows_points = true}};
    const bool has_law =
        run.conditions != nullptr && run.conditions->loss.size() == 1 && run.spacing_s > 0.0;
    if (has_law) {
        const auto theory =
            theory_of(run.conditions->loss.front(), {base::from_seconds(run.spacing_s),
                                                     std::max<std::size_t>(run.fates.size(), 1)});
        if (theory.mean_run && *theory.mean_run >= 1.0) {
            const double stays = 1.0 - 1.0 / *theory.mean_run;
            std::vector<Point> points;
            for (std::size_t k = 1; k <= counts.size() + 1; ++k) {
                points.push_back(
                    {static_cast<double>(k), std::pow(stays, static_cast<double>(k - 1))});
            }
            curves.push_back({.name = "geometric, the law's mean",
                              .colour = "muted",
                              .points = std::move(points),
                              .is_dashed = true});
        }
    }
    return page::Figure{.id = fmt::format("loss-runs-{}", to_text(run.direction)),
                        .title = fmt::format("Runs of losses, {}", words_on(run.direction)),
                        .x = {"length", "datagrams"},
                        .y = {"share at least so long", "1", page::Scale::logarithmic},
                        .content = page::Curves{std::move(curves)},
                        .size = half_page_of_runs,
                        .caption = "The runs of independent losses, and of Gilbert's model, are "
                                   "geometric; those of other laws need not be."};
}

} // namespace hapnet::emulator::tools
