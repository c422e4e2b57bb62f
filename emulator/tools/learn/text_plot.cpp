// SPDX-FileCopyrightText: 2026 The Hapnet authors
// SPDX-License-Identifier: MIT
#include "emulator/tools/learn/text_plot.hpp"

#include <algorithm>
#include <cmath>
#include <spdlog/fmt/fmt.h>
#include <vector>

namespace hapnet::emulator::tools {

namespace {

/// A line of a plot: the measured share, and that of the law.
struct Bar {
    std::string label;
    double measured = 0.0;
    double expected = 0.0;
};

std::string drawn(const std::string& title, const std::vector<Bar>& bars)
{
    constexpr std::size_t columns = 52;
    double largest = 1e-12;
    for (const Bar& bar : bars) largest = std::max({largest, bar.measured, bar.expected});
    const auto place = [&](double share) {
        return static_cast<std::size_t>(std::lround(share / largest * columns));
    };
    std::string text = title + "\n";
    for (const Bar& bar : bars) {
        std::string row(place(bar.measured), '#');
        row.resize(columns + 1, ' ');
        row[place(bar.expected)] = '|';
        row.erase(row.find_last_not_of(' ') + 1);
        text += fmt::format("{:>12} {:>5.1f} % {}\n", bar.label, 100.0 * bar.measured, row);
    }
    return text;
}

/// Returns the share of the ascending values from `from` to below `to`.
double share_between(const std::vector<double>& sorted, double from, double to)
{
    const auto first = std::lower_bound(sorted.begin(), sorted.end(), from);
    const auto last = std::lower_bound(first, sorted.end(), to);
    return static_cast<double>(last - first) / static_cast<double>(sorted.size());
}

} // namespace

std::string delay_plot(const MeasuredWay& way, const DelayModel& model)
{
    constexpr int classes = 16;
    constexpr int points = 4000;
    std::vector<double> delays;
    for (const auto& delay : way.delays) {
        if (delay) delays.push_back(base::to_nanoseconds(*delay));
    }
    std::sort(delays.begin(), delays.end());
    const auto at = [&](double share) {
        return delays[static_cast<std::size_t>(share * static_cast<double>(delays.size() - 1))];
    };
    const double from = at(0.005);
    const double width = std::max((at(0.995) - from) / classes, 1.0);
    const auto quantiles = quantiles_of(model, points);
    std::vector<Bar> bars;
    for (int i = 0; i < classes; ++i) {
        const double left = from + i * width;
        bars.push_back({fmt::format("{:.3f}", 1e-6 * left),
                        share_between(delays, left, left + width),
                        share_between(quantiles, left, left + width)});
    }
    return drawn(fmt::format("delays from ... ms: # measured, | {}", model.name), bars);
}

std::string loss_plot(const MeasuredWay& way, const LossModel& model)
{
    constexpr std::size_t lengths = 8;
    std::vector<double> counts(lengths);
    double count = 0.0;
    for (const LossRun& run : runs_of(way.lost)) {
        if (!run.is_lost) continue;
        counts[std::min(run.length, lengths) - 1] += 1.0;
        count += 1.0;
    }
    auto at_least = run_lengths(model.chain, true, lengths);
    at_least.resize(lengths);
    std::vector<Bar> bars;
    for (std::size_t i = 0; i < lengths; ++i) {
        const bool is_last = i + 1 == lengths;
        bars.push_back({fmt::format("{}{}", i + 1, is_last ? " or more" : ""), counts[i] / count,
                        at_least[i] - (is_last ? 0.0 : at_least[i + 1])});
    }
    return drawn(fmt::format("losses in a row: # measured, | {}", model.name), bars);
}

} // namespace hapnet::emulator::tools
