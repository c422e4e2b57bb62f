// SPDX-FileCopyrightText: 2026 The Hapnet authors
// SPDX-License-Identifier: MIT
#include "lab/metrics/scores.hpp"

#include "lab/metrics/worse.hpp"
#include "proto/base/ensure.hpp"

#include <cmath>

namespace hapnet::lab::metrics {

namespace {

// A number that is not finite stays so: it fails where it is judged.

/// What is in `value` beyond `reference`, of two root mean squares that do not correlate.
double excess(double value, double reference)
{
    const double squares = value * value - reference * reference;
    return squares < 0.0 ? 0.0 : std::sqrt(squares);
}

ByOrder excess(const ByOrder& value, const ByOrder& reference)
{
    return {.first = excess(value.first, reference.first),
            .second = excess(value.second, reference.second),
            .fourth = excess(value.fourth, reference.fourth)};
}

template <typename Value>
std::optional<Value> worse_side(const BySide<Value>& sides)
{
    return worse(sides[0], sides[1]);
}

/// Side by side against the perfect network; nullopt where either has none.
template <typename Value, typename Compare>
BySide<Value> against(const BySide<Value>& impaired, const BySide<Value>& perfect, Compare compare)
{
    BySide<Value> result;
    for (std::size_t side = 0; side < result.size(); ++side) {
        if (impaired[side] && perfect[side]) {
            result[side] = compare(*impaired[side], *perfect[side]);
        }
    }
    return result;
}

std::optional<double> difference(const std::optional<double>& value,
                                 const std::optional<double>& reference)
{
    if (!value || !reference) return std::nullopt;
    return *value - *reference;
}

const auto in_quadrature = [](const ByOrder& value, const ByOrder& reference) {
    return excess(value, reference);
};
const auto minus = [](double value, double reference) { return value - reference; };
const auto ratio_of = [](double value, double reference) -> std::optional<double> {
    if (!(reference > 0.0)) return std::nullopt;
    return value / reference;
};

/// Of the stiffness that the hands feel when it is their turn to press: the mean of both, as both
/// press on the same coupling, and each on its own is off by how the hands waver meanwhile. Of one
/// alone, where the session ended before the other's turn.
std::optional<double> stiffness_ratio(const BySide<double>& impaired, const BySide<double>& perfect)
{
    double felt = 0.0;
    double reference = 0.0;
    for (std::size_t side = 0; side < impaired.size(); ++side) {
        if (!impaired[side] || !perfect[side]) continue;
        felt += *impaired[side];
        reference += *perfect[side];
    }
    return ratio_of(felt, reference);
}

} // namespace

Scores scores_of(const Metrics& impaired, const Metrics& perfect)
{
    base::ensure(impaired.task == perfect.task);
    Scores scores{
        .task = impaired.task,
        .scored_share = perfect.scored_s > 0.0 ? impaired.scored_s / perfect.scored_s : 0.0,
        .vibration_m =
            worse_side(against(impaired.body_vibration_m, perfect.body_vibration_m, in_quadrature)),
        .force_discrepancy = impaired.force_discrepancy,
        .force_discrepancy_added =
            difference(impaired.force_discrepancy, perfect.force_discrepancy),
        .discrepancy_m = impaired.discrepancy_m,
        .turned_apart_rad = impaired.turned_apart_rad,
        .force_vibration_n = worse_side(impaired.force_vibration_n),
        .force_vibration_added_n = worse_side(
            against(impaired.force_vibration_n, perfect.force_vibration_n, in_quadrature)),
        .force_above_2hz_added_n = worse_side(
            against(impaired.force_above_2hz_n, perfect.force_above_2hz_n, in_quadrature)),
        .felt_vibration_n = worse_side(impaired.felt_vibration_n),
        .contact_lost = worse_side(against(impaired.contact_lost, perfect.contact_lost, minus)),
        .force_steps = worse_side(impaired.force_steps),
        .energy_taken_j = impaired.energy_taken_j,
        .drag_n = worse_side(against(impaired.drag_n, perfect.drag_n, minus)),
        .path_rms_m = worse_side(impaired.path_rms_m),
        .path_rms_ratio = worse_side(against(impaired.path_rms_m, perfect.path_rms_m, ratio_of)),
        .drops = impaired.drops,
        .overshoot_m = worse_side(impaired.overshoot_m),
        .response_added_s = difference(impaired.response_s, perfect.response_s),
        .similarity = impaired.similarity};
    for (std::size_t i = 0; i < press_hertz.size(); ++i) {
        scores.stiffness_ratio[i] =
            stiffness_ratio(impaired.stiffness_n_per_m[i], perfect.stiffness_n_per_m[i]);
    }
    return scores;
}

} // namespace hapnet::lab::metrics
