// SPDX-FileCopyrightText: 2026 The Hapnet authors
// SPDX-License-Identifier: MIT
#include "lab/metrics/scores.hpp"

#include "lab/metrics/worse.hpp"
#include "proto/base/ensure.hpp"

#include <cmath>
#include <complex>
#include <cstddef>

namespace hapnet::lab::metrics {

namespace {

// A number that is not finite stays so, and fails when it is judged.

/// Returns the part of `value` beyond `reference`. Both are root mean squares of uncorrelated
/// signals.
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

/// Compares both sides with those on the perfect network; nullopt where one of the two is missing.
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

using Complex = std::complex<double>;

/// The stiffness that both hands feel, and the one that they should feel, at one frequency of
/// pressing. Each is the sum over both hands. Both hands press on the same coupling, and each alone
/// has an error because the hands waver meanwhile. Only one hand counts where the session ended
/// before the other's turn. nullopt: there is no such stiffness.
struct FeltStiffness {
    Complex felt;
    Complex due;
};
std::optional<FeltStiffness> felt_stiffness(const Metrics& impaired, const Metrics& reference,
                                            std::size_t press)
{
    FeltStiffness sum;
    const auto of = [press](const Metrics& metrics, std::size_t side) -> std::optional<Complex> {
        const auto storage = metrics.stiffness_n_per_m[press][side];
        if (!storage) return std::nullopt;
        return Complex{*storage, metrics.loss_stiffness_n_per_m[press][side].value_or(0.0)};
    };
    for (const std::size_t side : {0U, 1U}) {
        const auto felt = of(impaired, side), due = of(reference, side);
        if (!felt || !due) continue;
        sum.felt += *felt;
        sum.due += *due;
    }
    if (!(std::abs(sum.due) > 0.0)) return std::nullopt;
    return sum;
}

void score_stiffness(const Metrics& impaired, const Metrics& reference, Scores& scores)
{
    for (std::size_t press = 0; press < press_hertz.size(); ++press) {
        const auto stiffness = felt_stiffness(impaired, reference, press);
        if (!stiffness) continue;
        const auto& [felt, due] = *stiffness;
        scores.stiffness_ratio[press] = std::abs(felt) / std::abs(due);
        const double error = std::abs(felt - due) / std::abs(due);
        scores.stiffness_error = worse(scores.stiffness_error, std::optional{error});
        if (press == slow_press) scores.slow_stiffness_error = error;
    }
}

} // namespace

Metrics make_reference(Metrics perfect, const Metrics& one_world)
{
    base::ensure(perfect.task == one_world.task);
    perfect.stiffness_n_per_m = one_world.stiffness_n_per_m;
    perfect.loss_stiffness_n_per_m = one_world.loss_stiffness_n_per_m;
    return perfect;
}

Scores scores_of(const Metrics& impaired, const Metrics& reference)
{
    base::ensure(impaired.task == reference.task);
    Scores scores{
        .task = impaired.task,
        .scored_share = reference.scored_s > 0.0 ? impaired.scored_s / reference.scored_s : 0.0,
        .vibration_m = worse_side(
            against(impaired.body_vibration_m, reference.body_vibration_m, in_quadrature)),
        .force_discrepancy = impaired.force_discrepancy,
        .force_discrepancy_added =
            difference(impaired.force_discrepancy, reference.force_discrepancy),
        .discrepancy_m = impaired.discrepancy_m,
        .turned_apart_rad = impaired.turned_apart_rad,
        .force_vibration_n = worse_side(impaired.force_vibration_n),
        .force_vibration_added_n = worse_side(
            against(impaired.force_vibration_n, reference.force_vibration_n, in_quadrature)),
        .force_above_2hz_added_n = worse_side(
            against(impaired.force_above_2hz_n, reference.force_above_2hz_n, in_quadrature)),
        .felt_vibration_n = worse_side(impaired.felt_vibration_n),
        .contact_lost = worse_side(against(impaired.contact_lost, reference.contact_lost, minus)),
        .force_steps = worse_side(impaired.force_steps),
        .energy_taken_j = impaired.energy_taken_j,
        .drag_n = worse_side(against(impaired.drag_n, reference.drag_n, minus)),
        .path_rms_m = worse_side(impaired.path_rms_m),
        .path_rms_ratio = worse_side(against(impaired.path_rms_m, reference.path_rms_m, ratio_of)),
        .drops = impaired.drops,
        .overshoot_m = worse_side(impaired.overshoot_m),
        .response_added_s = difference(impaired.response_s, reference.response_s),
        .similarity = impaired.similarity,
        .rate_bit_per_s = impaired.rate_bit_per_s};
    score_stiffness(impaired, reference, scores);
    return scores;
}

} // namespace hapnet::lab::metrics
