// SPDX-FileCopyrightText: 2026 The Hapnet authors
// SPDX-License-Identifier: MIT
#include "lab/metrics/verdict.hpp"

#include <numbers>
#include <optional>
#include <spdlog/fmt/fmt.h>
#include <utility>

namespace hapnet::lab::metrics {

namespace {

/// The wording of a criterion.
struct Wording {
    std::string_view name;
    std::string_view unit;
    double scale = 1.0; // factor from SI units to `unit`
};

constexpr Wording vibration_words{"vibration", " mm", 1e3};
constexpr Wording stiffness_words{"stiffness error", " %", 1e2};
constexpr Wording slow_stiffness_words{"stiffness error at 0.5 Hz", " %", 1e2};
constexpr Wording force_vibration_words{"force vibration added", " N", 1.0};
constexpr Wording scored_words{"time together", " %", 1e2};
constexpr Wording force_discrepancy_words{"force discrepancy", " %", 1e2};
constexpr Wording contact_words{"contact lost", " %", 1e2};
constexpr Wording drag_words{"drag", " N", 1.0};
constexpr Wording discrepancy_words{"copies apart", " mm", 1e3};
constexpr Wording turned_apart_words{"copies turned apart", " deg", 180.0 / std::numbers::pi};

std::string sentence(const Wording& words, double value, char relation, double limit)
{
    return fmt::format("{} {:.3g}{} {} {:.3g}{}", words.name, value * words.scale, words.unit,
                       relation, limit * words.scale, words.unit);
}

/// The limits of a tier that a session does not keep, as texts, and their metrics.
struct Objections {
    std::vector<std::string> sentences;
    std::vector<std::string_view> metrics;

    // A number that is not finite exceeds every limit.

    void at_most(std::optional<double> value, double limit, const Wording& words)
    {
        if (value && !(*value <= limit)) add(*value, '>', limit, words);
    }
    void at_least(std::optional<double> value, double limit, const Wording& words)
    {
        if (value && !(*value >= limit)) add(*value, '<', limit, words);
    }
    void at_most(const std::optional<Spread>& value, std::optional<double> limit,
                 const Wording& words)
    {
        if (value && limit) at_most(value->mean, *limit, words);
    }

private:
    void add(double value, char relation, double limit, const Wording& words)
    {
        sentences.push_back(sentence(words, value, relation, limit));
        metrics.push_back(words.name);
    }
};

std::optional<double> judged(const std::optional<ByOrder>& values, FilterOrder order)
{
    if (!values) return std::nullopt;
    return at_order(*values, order);
}

} // namespace

std::string_view to_text(Tier tier)
{
    switch (tier) {
    case Tier::unusable: return "unusable";
    case Tier::usable: return "usable";
    case Tier::good: return "good";
    }
    return "?";
}

Judgement judge(const Scores& scores, const Criteria& criteria)
{
    const FilterOrder order = criteria.filter_order;
    const UsableCriteria& usable = criteria.usable;
    Objections failures;
    failures.at_least(scores.scored_share, usable.scored_share_min, scored_words);
    failures.at_most(judged(scores.vibration_m, order), at_order(usable.vibration_max_m, order),
                     vibration_words);
    failures.at_most(scores.slow_stiffness_error, usable.slow_stiffness_error_max,
                     slow_stiffness_words);
    failures.at_most(judged(scores.force_vibration_added_n, order), usable.force_vibration_max_n,
                     force_vibration_words);
    failures.at_most(scores.discrepancy_m, usable.discrepancy_max_m, discrepancy_words);
    failures.at_most(scores.turned_apart_rad, usable.turned_apart_max_rad, turned_apart_words);

    const GoodCriteria& good = criteria.good;
    Objections shortcomings;
    shortcomings.at_most(scores.stiffness_error, good.stiffness_error_max, stiffness_words);
    shortcomings.at_most(scores.force_discrepancy, good.force_discrepancy_max,
                         force_discrepancy_words);
    shortcomings.at_most(scores.contact_lost, good.contact_lost_max, contact_words);
    shortcomings.at_most(scores.drag_n, good.drag_max_n, drag_words);
    shortcomings.at_most(scores.discrepancy_m, good.discrepancy_max_m, discrepancy_words);
    shortcomings.at_most(scores.turned_apart_rad, good.turned_apart_max_rad, turned_apart_words);

    Judgement judgement{.failures = std::move(failures.sentences),
                        .failed = std::move(failures.metrics),
                        .shortcomings = std::move(shortcomings.sentences),
                        .short_of = std::move(shortcomings.metrics)};
    if (judgement.failures.empty())
        judgement.tier = judgement.shortcomings.empty() ? Tier::good : Tier::usable;
    return judgement;
}

} // namespace hapnet::lab::metrics
