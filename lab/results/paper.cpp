// SPDX-FileCopyrightText: 2026 The Hapnet authors
// SPDX-License-Identifier: MIT
#include "lab/results/paper.hpp"

#include <array>
#include <cmath>

namespace hapnet::lab {

namespace {

/// Table 1 and Fig. 6 of the paper; its TiDeC stands beside our sep. The order of the limits is
/// that of `impairments`. 15 ms of jitter: the most that the paper tried, still usable.
struct PaperAlgorithm {
    std::string_view name;
    PaperRow table1;
    std::array<double, impairments.size()> limits;
};

constexpr std::array paper_algorithms{
    PaperAlgorithm{"base", {13.789, 10.986, 46.01}, {160.0, 15.0, 93.0, 40.0}},
    PaperAlgorithm{"sep", {13.991, 10.808, 50.12}, {160.0, 15.0, 93.0, 45.0}},
    PaperAlgorithm{"dead-reckoning", {3.341, 3.840, 58.85}, {150.0, 5.0, 80.0, 50.0}}};

const PaperAlgorithm* paper_of(std::string_view algorithm)
{
    for (const PaperAlgorithm& known : paper_algorithms) {
        if (known.name == algorithm) return &known;
    }
    return nullptr;
}

bool within_share(double value, double of, double share)
{
    return std::abs(value - of) <= share * of;
}

bool is_from_to(double value, double least, double most) { return value >= least && value <= most; }

bool base_agrees(const Spread& mm, const PaperRow& paper)
{
    constexpr double tolerance = 0.10;
    return within_share(mm.mean, paper.mean_mm, tolerance) &&
           within_share(mm.std, paper.std_mm, tolerance) &&
           within_share(mm.max, paper.max_mm, tolerance);
}

bool dead_reckoning_agrees(const Spread& mm, const PaperRow& paper)
{
    constexpr double tolerance = 0.15;
    return within_share(mm.mean, paper.mean_mm, tolerance) &&
           within_share(mm.std, paper.std_mm, tolerance) && is_from_to(mm.max, 40.0, 65.0);
}

bool sep_agrees(const Spread& mm, const std::optional<Spread>& base_mm)
{
    constexpr double tolerance = 0.03;
    return base_mm && within_share(mm.mean, base_mm->mean, tolerance) &&
           within_share(mm.std, base_mm->std, tolerance) &&
           within_share(mm.max, base_mm->max, tolerance);
}

constexpr double delay_share = 0.05;       // 8 ms of 160
constexpr double random_loss_points = 1.0; // 92 to 94 of 93 %
constexpr double burst_points = 5.0;       // what the paper's own limits are apart
constexpr double jitter_usable_ms = 15.0;

bool is_near(const FoundLimit& found, double wanted, Impairment impairment)
{
    const double margin = impairment == Impairment::delay         ? delay_share * wanted
                          : impairment == Impairment::random_loss ? random_loss_points
                                                                  : burst_points;
    return found.ever_failed && std::abs(found.limit - wanted) <= margin;
}

bool base_limit_agrees(Impairment impairment, const FoundLimit& found, double paper)
{
    if (impairment == Impairment::jitter) return found.limit >= jitter_usable_ms;
    return is_near(found, paper, impairment);
}

bool sep_limit_agrees(Impairment impairment, const FoundLimit& found,
                      const std::optional<FoundLimit>& base)
{
    if (impairment == Impairment::jitter) return found.limit >= jitter_usable_ms;
    if (!base) return false;
    if (impairment == Impairment::burst_loss) return found.limit >= base->limit;
    if (!found.ever_failed || !base->ever_failed) return found.ever_failed == base->ever_failed;
    return is_near(found, base->limit, impairment);
}

bool dead_reckoning_limit_agrees(Impairment impairment, const FoundLimit& found,
                                 const std::optional<FoundLimit>& base)
{
    if (impairment == Impairment::jitter) {
        return found.ever_failed && is_from_to(found.limit, 3.0, 6.0);
    }
    if (!base) return false;
    if (impairment == Impairment::burst_loss) return found.limit > base->limit;
    const bool is_less = found.ever_failed && found.limit < base->limit;
    return impairment == Impairment::delay ? is_less && is_from_to(found.limit, 130.0, 155.0)
                                           : is_less && is_from_to(found.limit, 60.0, 85.0);
}

} // namespace

std::optional<PaperRow> paper_table1(std::string_view algorithm)
{
    const PaperAlgorithm* paper = paper_of(algorithm);
    return paper == nullptr ? std::nullopt : std::optional{paper->table1};
}

std::optional<double> paper_limit(std::string_view algorithm, Impairment impairment)
{
    const PaperAlgorithm* paper = paper_of(algorithm);
    if (paper == nullptr) return std::nullopt;
    return paper->limits[static_cast<std::size_t>(impairment)];
}

std::string_view table1_verdict(std::string_view algorithm, const Spread& mm,
                                const std::optional<Spread>& base_mm)
{
    const PaperAlgorithm* paper = paper_of(algorithm);
    if (paper == nullptr) return "";
    if (algorithm == "base") return base_agrees(mm, paper->table1) ? "calibrated" : "missed";
    const bool agrees =
        algorithm == "sep" ? sep_agrees(mm, base_mm) : dead_reckoning_agrees(mm, paper->table1);
    return agrees ? "met" : "missed";
}

std::string_view limit_status(std::string_view algorithm, Impairment impairment,
                              const FoundLimit& found, const std::optional<FoundLimit>& base)
{
    const PaperAlgorithm* paper = paper_of(algorithm);
    if (paper == nullptr) return "";
    if (algorithm == "base") {
        const bool agrees = base_limit_agrees(impairment, found,
                                              paper->limits[static_cast<std::size_t>(impairment)]);
        const bool was_calibrated_on =
            impairment == Impairment::delay || impairment == Impairment::random_loss;
        if (!agrees) return "predicted-missed";
        return was_calibrated_on ? "calibrated" : "predicted-met";
    }
    const bool agrees = algorithm == "sep" ? sep_limit_agrees(impairment, found, base)
                                           : dead_reckoning_limit_agrees(impairment, found, base);
    return agrees ? "predicted-met" : "predicted-missed";
}

} // namespace hapnet::lab
