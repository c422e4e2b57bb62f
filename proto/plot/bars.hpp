// SPDX-FileCopyrightText: 2026 The Hapnet authors
// SPDX-License-Identifier: MIT
#pragma once

#include "proto/plot/axis.hpp"

#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace hapnet::plot {

/// A bar from zero to a value that is not negative, which its label says in words.
struct Bar {
    double value = 0.0;
    std::string label;
    std::string_view colour;         // as CSS writes it
    bool is_outlined = false;        // for what others measured
    bool is_open = false;            // the value is more than that: an arrow instead of an end
    bool is_missed = false;          // its label is red
    std::optional<Range> interval{}; // in which the value lies: a line with two ends
    std::string tip{};               // shown where a pointer rests
};

struct BarGroup {
    std::string name;
    std::vector<Bar> bars;
};

/// Groups of bars side by side as one SVG element, on a linear axis from zero.
[[nodiscard]] std::string svg_bars(const PlotTitles& titles, const std::vector<BarGroup>& groups,
                                   const std::vector<LegendEntry>& legend, Size size);

} // namespace hapnet::plot
