// SPDX-FileCopyrightText: 2026 The Hapnet authors
// SPDX-License-Identifier: MIT
#include "lab/results/paper.hpp"

#include <algorithm>
#include <array>
#include <cmath>

namespace hapnet::lab::results {

namespace {

/// Table 1 and Fig. 6 of the paper. Its TiDeC is compared with our sep. The order of the limits is
/// that of `impairments`.
struct PaperAlgorithm {
    std::string_view name;
    PaperRow table1;
    std::array<std::optional<double>, experiment::impairments.size()> limits;
};

constexpr std::array paper_algorithms{
    PaperAlgorithm{"base", {13.789, 10.986, 46.01}, {160.0, std::nullopt, 93.0, 40.0}},
    PaperAlgorithm{"sep", {13.991, 10.808, 50.12}, {160.0, std::nullopt, 93.0, 45.0}},
    PaperAlgorithm{"dead-reckoning", {3.341, 3.840, 58.85}, {150.0, 5.0, 80.0, 50.0}}};

const PaperAlgorithm* paper_of(std::string_view algorithm)
{
    const auto known =
        std::find_if(paper_algorithms.begin(), paper_algorithms.end(),
                     [&](const PaperAlgorithm& one) { return one.name == algorithm; });
    return known == paper_algorithms.end() ? nullptr : &*known;
}

constexpr double base_share = 0.10;           // tolerance, as a share of the paper's number
constexpr double dead_reckoning_share = 0.15; // tolerance, as a share of the paper's number
constexpr double sep_share = 0.03;            // tolerance, as a share of base's number
constexpr Band dead_reckoning_max_mm{40.0, 65.0};

Band around(double centre, double share)
{
    return {(1.0 - share) * centre, (1.0 + share) * centre};
}

/// The relation of a limit to that of base.
enum class ToBase : std::uint8_t { any, near, at_least, more, less };

/// The range in which a limit agrees, and its relation to that of base.
struct LimitRule {
    std::string_view algorithm;
    experiment::Impairment impairment;
    std::string_view text; // the rule in words, for people
    Band band{};
    ToBase to_base = ToBase::any;
    double near_share = 0.0;  // allowed difference, as a share of base's limit
    double near_points = 0.0; // further allowed difference, in the impairment's unit
};

constexpr double no_end = std::numeric_limits<double>::infinity();

// base: delay within 5 %, random loss within 1, burst loss within 5 of 100, which is the distance
// of the paper's own limits. Dead reckoning: the bands of our first estimates. Those contained only
// an order of the bursts, so bursts must be within a fifth of the paper's 50.
constexpr std::array limit_rules{
    LimitRule{"base", experiment::Impairment::delay, "152 to 168", {152.0, 168.0}},
    LimitRule{"base", experiment::Impairment::random_loss, "92 to 94", {92.0, 94.0}},
    LimitRule{"base", experiment::Impairment::burst_loss, "35 to 45", {35.0, 45.0}},
    LimitRule{"sep", experiment::Impairment::delay, "base’s ± 5 %", {}, ToBase::near, 0.05, 0.0},
    LimitRule{"sep", experiment::Impairment::random_loss, "base’s ± 1", {}, ToBase::near, 0.0, 1.0},
    LimitRule{"sep", experiment::Impairment::burst_loss, "base’s or more", {}, ToBase::at_least},
    LimitRule{"dead-reckoning",
              experiment::Impairment::delay,
              "130 to 155, less than base",
              {130.0, 155.0},
              ToBase::less},
    LimitRule{"dead-reckoning", experiment::Impairment::jitter, "3 to 6", {3.0, 6.0}},
    LimitRule{"dead-reckoning",
              experiment::Impairment::random_loss,
              "60 to 85, less than base",
              {60.0, 85.0},
              ToBase::less},
    LimitRule{"dead-reckoning",
              experiment::Impairment::burst_loss,
              "40 to 60, more than base",
              {40.0, 60.0},
              ToBase::more}};

const LimitRule* rule_of(std::string_view algorithm, std::string_view impairment)
{
    const auto known =
        std::find_if(limit_rules.begin(), limit_rules.end(), [&](const LimitRule& rule) {
            return rule.algorithm == algorithm && name_of(rule.impairment) == impairment;
        });
    return known == limit_rules.end() ? nullptr : &*known;
}

/// The position of a whole interval relative to a band.
enum class Lies : std::uint8_t { within, outside, across };

Lies lies(const metrics::Interval& interval, const Band& band)
{
    if (interval.low >= band.low && interval.high <= band.high) return Lies::within;
    if (interval.high < band.low || interval.low > band.high) return Lies::outside;
    return Lies::across;
}

Lies stands_to_base(const LimitRule& rule, const metrics::Threshold& found,
                    const metrics::Threshold& base)
{
    constexpr double least = std::numeric_limits<double>::min(); // the least number above 0
    const double near = rule.near_share * base.p50 + rule.near_points;
    const auto difference = difference_of(found, base).interval;
    switch (rule.to_base) {
    case ToBase::any: break;
    case ToBase::near: return lies(difference, {-near, near});
    case ToBase::at_least: return lies(difference, {0.0, no_end});
    case ToBase::more: return lies(difference, {least, no_end});
    case ToBase::less: return lies(difference, {-no_end, -least});
    }
    return Lies::within;
}

/// Judges a limit by all parts of a rule.
Lies agrees(const LimitRule& rule, const metrics::Threshold& found, const metrics::Threshold* base)
{
    const Lies in_band = lies({found.low, found.high.value_or(no_end)}, rule.band);
    const Lies to_base =
        rule.to_base == ToBase::any ? Lies::within : stands_to_base(rule, found, *base);
    if (in_band == Lies::outside || to_base == Lies::outside) return Lies::outside;
    return in_band == Lies::within ? to_base : in_band;
}

LimitStatus status_of(Provenance provenance, bool is_met)
{
    switch (provenance) {
    case Provenance::none: break;
    case Provenance::calibrated:
        return is_met ? LimitStatus::calibrated : LimitStatus::calibrated_missed;
    case Provenance::selected:
        return is_met ? LimitStatus::selected_met : LimitStatus::selected_missed;
    case Provenance::by_construction:
        return is_met ? LimitStatus::by_construction_met : LimitStatus::by_construction_missed;
    case Provenance::predicted:
        return is_met ? LimitStatus::predicted_met : LimitStatus::predicted_missed;
    }
    return LimitStatus::none;
}

Provenance base_provenance(experiment::Impairment impairment, std::string_view task)
{
    const bool in_t1 = task == worst_task || task == "T1";
    const bool in_t2 = task == worst_task || task == "T2";
    switch (impairment) {
    case experiment::Impairment::delay:
        return in_t2 ? Provenance::calibrated : Provenance::predicted;
    case experiment::Impairment::random_loss:
        return in_t1 ? Provenance::calibrated : Provenance::predicted;
    case experiment::Impairment::burst_loss:
        return in_t1 ? Provenance::selected : Provenance::predicted;
    case experiment::Impairment::jitter:
    case experiment::Impairment::interval: break;
    }
    return Provenance::predicted;
}

} // namespace

std::optional<PaperRow> paper_table1(std::string_view algorithm)
{
    const PaperAlgorithm* paper = paper_of(algorithm);
    return paper == nullptr ? std::nullopt : std::optional{paper->table1};
}

std::optional<double> paper_limit(std::string_view algorithm, experiment::Impairment impairment)
{
    const PaperAlgorithm* paper = paper_of(algorithm);
    if (paper == nullptr) return std::nullopt;
    return paper->limits[static_cast<std::size_t>(impairment)];
}

Provenance limit_provenance(std::string_view algorithm, experiment::Impairment impairment,
                            std::string_view task)
{
    using experiment::Impairment;
    if (paper_of(algorithm) == nullptr || impairment == Impairment::interval)
        return Provenance::none;
    if (algorithm == "base") return base_provenance(impairment, task);
    if (algorithm == "sep") {
        const bool is_base =
            task == "T1" || (task == worst_task && impairment != Impairment::delay);
        return is_base ? Provenance::by_construction : Provenance::predicted;
    }
    const bool was_seen = impairment == Impairment::jitter || impairment == Impairment::random_loss;
    const bool in_t1 = task == worst_task || task == "T1";
    return was_seen && in_t1 ? Provenance::selected : Provenance::predicted;
}

Table1Provenance table1_provenance(std::string_view algorithm)
{
    if (paper_of(algorithm) == nullptr) return {};
    if (algorithm == "base") return {Provenance::calibrated, Provenance::calibrated};
    if (algorithm == "sep") return {Provenance::by_construction, Provenance::by_construction};
    return {Provenance::selected, Provenance::predicted};
}

std::optional<Table1Bands> table1_bands(std::string_view algorithm,
                                        const std::optional<metrics::Spread>& base_mm)
{
    const auto paper = paper_table1(algorithm);
    if (!paper) return std::nullopt;
    if (algorithm == "sep") {
        if (!base_mm) return std::nullopt;
        return Table1Bands{around(base_mm->mean, sep_share), around(base_mm->std, sep_share),
                           around(base_mm->max, sep_share)};
    }
    const bool is_base = algorithm == "base";
    const double share = is_base ? base_share : dead_reckoning_share;
    return Table1Bands{around(paper->mean_mm, share), around(paper->std_mm, share),
                       is_base ? around(paper->max_mm, share) : dead_reckoning_max_mm};
}

Claim table1_verdict(std::string_view algorithm, const metrics::Spread& mm,
                     const std::optional<metrics::Spread>& base_mm)
{
    if (paper_of(algorithm) == nullptr) return Claim::none;
    const auto bands = table1_bands(algorithm, base_mm);
    const bool is_within = bands && bands->mean_mm.holds(mm.mean) && bands->std_mm.holds(mm.std) &&
                           bands->max_mm.holds(mm.max);
    if (!is_within) return Claim::missed;
    return algorithm == "base" ? Claim::calibrated : Claim::met;
}

std::string_view limit_band(std::string_view algorithm, std::string_view impairment)
{
    const LimitRule* rule = rule_of(algorithm, impairment);
    return rule == nullptr ? std::string_view{} : rule->text;
}

LimitStatus limit_status(std::string_view algorithm, experiment::Impairment impairment,
                         const metrics::Threshold& found, const metrics::Threshold* base)
{
    const LimitRule* rule = rule_of(algorithm, name_of(impairment));
    if (rule == nullptr) return LimitStatus::none;
    if (rule->to_base != ToBase::any && base == nullptr) return LimitStatus::none;
    const Lies stands = agrees(*rule, found, base);
    if (stands == Lies::across) return LimitStatus::undecided;
    return status_of(limit_provenance(algorithm, impairment, worst_task), stands == Lies::within);
}

} // namespace hapnet::lab::results
