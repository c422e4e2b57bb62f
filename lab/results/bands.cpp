// SPDX-FileCopyrightText: 2026 The Hapnet authors
// SPDX-License-Identifier: MIT
#include "lab/results/bands.hpp"

#include <array>

namespace hapnet::lab::report {

namespace {

constexpr double base_share = 0.10;           // of the paper's
constexpr double dead_reckoning_share = 0.15; // of the paper's
constexpr double sep_share = 0.03;            // of base's
constexpr Band dead_reckoning_max_mm{40.0, 65.0};

std::optional<Band> around(std::optional<double> centre, double share)
{
    if (!centre) return std::nullopt;
    return Band{(1.0 - share) * *centre, (1.0 + share) * *centre};
}

struct LimitBand {
    std::string_view algorithm;
    std::string_view impairment;
    std::string_view text;
};

constexpr std::array limit_bands{
    LimitBand{"base", "delay", "152 to 168"},
    LimitBand{"base", "jitter", "15 or more"},
    LimitBand{"base", "random-loss", "92 to 94"},
    LimitBand{"base", "burst-loss", "35 to 45"},
    LimitBand{"sep", "delay", "base’s ± 5 %"},
    LimitBand{"sep", "jitter", "15 or more"},
    LimitBand{"sep", "random-loss", "base’s ± 1"},
    LimitBand{"sep", "burst-loss", "base’s or more"},
    LimitBand{"dead-reckoning", "delay", "130 to 155, less than base"},
    LimitBand{"dead-reckoning", "jitter", "3 to 6"},
    LimitBand{"dead-reckoning", "random-loss", "60 to 85, less than base"},
    LimitBand{"dead-reckoning", "burst-loss", "more than base"}};

} // namespace

Table1Bands table1_bands(const Table1Row& row, const Table1Row* base)
{
    if (row.algorithm == "base" || row.algorithm == "dead-reckoning") {
        const bool is_base = row.algorithm == "base";
        const double share = is_base ? base_share : dead_reckoning_share;
        return {.mean_mm = around(row.paper_mean_mm, share),
                .std_mm = around(row.paper_std_mm, share),
                .max_mm = is_base ? around(row.paper_max_mm, share) : dead_reckoning_max_mm};
    }
    if (row.algorithm != "sep" || base == nullptr) return {};
    return {.mean_mm = around(base->mean_mm, sep_share),
            .std_mm = around(base->std_mm, sep_share),
            .max_mm = around(base->max_mm, sep_share)};
}

std::string_view limit_band(std::string_view algorithm, std::string_view impairment)
{
    for (const LimitBand& band : limit_bands) {
        if (band.algorithm == algorithm && band.impairment == impairment) return band.text;
    }
    return "";
}

} // namespace hapnet::lab::report
