// SPDX-FileCopyrightText: 2026 The Hapnet authors
// SPDX-License-Identifier: MIT
#include "lab/metrics/verdict.hpp"

#include <numbers>
#include <optional>
#include <spdlog/fmt/fmt.h>

namespace hapnet::lab::metrics {

namespace {

/// How a criterion is put in words.
struct Wording {
    std::string_view name;
    std::string_view unit;
    double scale = 1.0; // of the unit in SI
};

constexpr Wording vibration_words{"vibration", " mm", 1e3};
constexpr Wording stiffness_words{"stiffness ratio", "", 1.0};
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

// A number that is not finite keeps no limit.

void at_most(std::optional<double> value, double limit, const Wording& words,
             std::vector<std::string>& objections)
{
    if (!value || *value <= limit) return;
    objections.push_back(sentence(words, *value, '>', limit));
}

void at_least(std::optional<double> value, double limit, const Wording& words,
              std::vector<std::string>& objections)
{
    if (!value || *value >= limit) return;
    objections.push_back(sentence(words, *value, '<', limit));
}

/// What a text may leave out.
void at_most(const std::optional<Spread>& value, std::optional<double> limit, const Wording& words,
             std::vector<std::string>& objections)
{
    if (value && limit) at_most(value->mean, *limit, words, objections);
}

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
    const auto stiffness = scores.stiffness_ratio[judged_press];
    Judgement judgement;
    auto& failures = judgement.failures;
    at_least(scores.scored_share, criteria.usable.scored_share_min, scored_words, failures);
    at_most(judged(scores.vibration_m, order), at_order(criteria.usable.vibration_max_m, order),
            vibration_words, failures);
    at_least(stiffness, criteria.usable.stiffness_ratio_min, stiffness_words, failures);
    at_most(judged(scores.force_vibration_added_n, order), criteria.usable.force_vibration_max_n,
            force_vibration_words, failures);
    at_most(scores.discrepancy_m, criteria.usable.discrepancy_max_m, discrepancy_words, failures);
    at_most(scores.turned_apart_rad, criteria.usable.turned_apart_max_rad, turned_apart_words,
            failures);

    auto& shortcomings = judgement.shortcomings;
    at_least(stiffness, criteria.good.stiffness_ratio_min, stiffness_words, shortcomings);
    at_most(scores.force_discrepancy, criteria.good.force_discrepancy_max, force_discrepancy_words,
            shortcomings);
    at_most(scores.contact_lost, criteria.good.contact_lost_max, contact_words, shortcomings);
    at_most(scores.drag_n, criteria.good.drag_max_n, drag_words, shortcomings);
    at_most(scores.discrepancy_m, criteria.good.discrepancy_max_m, discrepancy_words, shortcomings);
    at_most(scores.turned_apart_rad, criteria.good.turned_apart_max_rad, turned_apart_words,
            shortcomings);
    if (failures.empty()) judgement.tier = shortcomings.empty() ? Tier::good : Tier::usable;
    return judgement;
}

} // namespace hapnet::lab::metrics
