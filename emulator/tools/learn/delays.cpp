// SPDX-FileCopyrightText: 2026 The Hapnet authors
// SPDX-License-Identifier: MIT
#include "emulator/tools/learn/delays.hpp"

#include "emulator/core/delay/bounds.hpp"
#include "emulator/tools/verify/draws.hpp"
#include "emulator/tools/verify/tails.hpp"
#include "proto/base/ensure.hpp"
#include "proto/base/math.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <utility>

namespace hapnet::emulator::tools {

namespace {

constexpr std::size_t fitted_delays_min = 100; // with fewer the law of the test is not valid

/// Sorted values in nanoseconds, with their moments.
struct Values {
    std::vector<double> sorted;
    double mean = 0.0;
    double sd = 0.0;

    explicit Values(const std::vector<base::Duration>& delays)
    {
        for (const base::Duration delay : delays) sorted.push_back(base::to_nanoseconds(delay));
        std::sort(sorted.begin(), sorted.end());
        const auto n = static_cast<double>(sorted.size());
        for (const double one : sorted) mean += one / n;
        for (const double one : sorted) sd += (one - mean) * (one - mean) / n;
        sd = std::sqrt(sd);
    }
};

/// Returns the time rounded to microseconds, and limited to the longest delay of a profile.
base::Duration in_microseconds(double nanoseconds)
{
    const double most = base::to_nanoseconds(longest_delay);
    return std::chrono::microseconds{std::llround(std::clamp(nanoseconds, -most, most) / 1e3)};
}

/// Returns the largest distance of the distribution of the values from that of a law.
double distance_of(const DelayModel& model, const Values& values)
{
    constexpr int points = 4000;
    const auto quantiles = quantiles_of(model, points);
    const auto share_below = [&](double value) {
        const auto next = std::lower_bound(quantiles.begin(), quantiles.end(), value);
        const auto index = static_cast<double>(next - quantiles.begin());
        if (next == quantiles.begin() || next == quantiles.end()) return index / points;
        const double step = *next - *(next - 1);
        const double part = step > 0.0 ? (value - *(next - 1)) / step : 0.0;
        return std::clamp((index - 0.5 + part) / points, 0.0, 1.0);
    };
    const auto n = static_cast<double>(values.sorted.size());
    double distance = 0.0;
    for (std::size_t i = 0; i < values.sorted.size(); ++i) {
        const double share = share_below(values.sorted[i]);
        const auto rank = static_cast<double>(i);
        distance = std::max({distance, share - rank / n, (rank + 1.0) / n - share});
    }
    return distance;
}

/// Finds the parameters of each law, and its distance from the values.
class Candidates {
public:
    explicit Candidates(const Values& values) : values_{values} {}

    [[nodiscard]] std::vector<DelayModel> all()
    {
        const double least = values_.sorted.front();
        const double greatest = values_.sorted.back();
        const auto n = static_cast<double>(values_.sorted.size());
        const double middle = 0.5 * (least + greatest);
        const double half = 0.5 * (greatest - least) * (n + 1.0) / std::max(n - 1.0, 1.0);
        try_out("uniform", middle, UniformLaw{{}, in_microseconds(half)});
        try_out("normal", values_.mean, NormalLaw{{}, in_microseconds(values_.sd)});
        const double start = std::max(least - (values_.mean - least) / n, 0.0);
        try_out("exponential", start, ExponentialLaw{in_microseconds(values_.mean - start)});
        try_before(least);
        // A few delays that do not belong to the law, such as those of another regime, are far
        // below it.
        const double few = values_.sorted[values_.sorted.size() / 500];
        if (few - least > values_.sd) try_before(few);
        std::stable_sort(models_.begin(), models_.end(),
                         [](const auto& a, const auto& b) { return a.distance < b.distance; });
        return std::move(models_);
    }

private:
    /// Fits laws that begin at `least`, and laws that begin earlier. Where a law begins is not one
    /// of its parameters.
    void try_before(double least)
    {
        for (const double back : {0.0, 0.003, 0.01, 0.03, 0.1, 0.2, 0.4, 0.8, 1.6, 3.2}) {
            const double from = std::max(least - back * values_.sd, 0.0);
            try_from(from);
            if (from == 0.0) break;
        }
    }

    void try_from(double from)
    {
        const double mean = values_.mean - from;
        try_out("gamma", from, GammaLaw{in_microseconds(mean), in_microseconds(values_.sd)});
        const auto begin = std::ranges::lower_bound(values_.sorted, from);
        const auto n = static_cast<double>(values_.sorted.end() - begin);
        const double first = std::max(*begin - from, 1e3);
        double sum = 0.0;
        double squares = 0.0;
        for (auto value = begin; value != values_.sorted.end(); ++value) {
            const double log = base::log(std::max(*value - from, 1e3));
            sum += log;
            squares += log * log;
        }
        const double mu = sum / n;
        const double variance = std::max(squares / n - mu * mu, 0.0);
        const double log_mean = base::exp(std::min(mu + 0.5 * variance, 50.0));
        const double log_sd = log_mean * std::sqrt(base::exp(std::min(variance, 50.0)) - 1.0);
        try_out("log-normal", from,
                LogNormalLaw{in_microseconds(log_mean), in_microseconds(log_sd)});
        const double shape = 1.0 / std::max(mu - base::log(first), 1e-9);
        if (shape <= 1.01 || shape > 1000.0) return;
        try_out("pareto", from, ParetoLaw{in_microseconds(first * shape / (shape - 1.0)), shape});
    }

    /// Keeps the best candidate of each name.
    void try_out(std::string_view name, double from, const DelayLaw& law)
    {
        if (!validate(Variation{law, {}})) return;
        DelayModel model{name, in_microseconds(from), law};
        model.distance = distance_of(model, values_);
        const auto same = std::find_if(models_.begin(), models_.end(),
                                       [&](const DelayModel& one) { return one.name == name; });
        if (same == models_.end()) {
            models_.push_back(model);
        } else if (model.distance < same->distance) {
            *same = model;
        }
    }

    const Values& values_;
    std::vector<DelayModel> models_;
};

/// Returns the correlation of the scores of neighbours that both arrived.
double correlation_of(const MeasuredWay& way, const std::vector<base::Duration>& arrived)
{
    const auto scores = rank_scores(arrived);
    double products = 0.0;
    double squares = 0.0;
    std::size_t index = 0;
    for (std::size_t i = 0; i < way.delays.size(); ++i) {
        if (!way.delays[i]) continue;
        const bool has_neighbour = i > 0 && way.delays[i - 1];
        if (has_neighbour) {
            products += scores[index - 1] * scores[index];
            squares +=
                0.5 * (scores[index - 1] * scores[index - 1] + scores[index] * scores[index]);
        }
        ++index;
    }
    return squares > 0.0 ? products / squares : 0.0;
}

} // namespace

std::vector<double> quantiles_of(const DelayModel& model, int points)
{
    std::vector<double> quantiles;
    auto sampler = make_sampler(model.jitter);
    for (int i = 0; i < points; ++i) {
        const double u = (i + 0.5) / points;
        quantiles.push_back(std::visit(
            [&](auto& law) {
                if constexpr (requires { law.quantile(u); }) {
                    return base::to_nanoseconds(model.base + law.quantile(u));
                } else {
                    base::ensure(false); // no trace is fitted
                    return 0.0;
                }
            },
            sampler));
    }
    return quantiles;
}

DelayFit fit_delays(const MeasuredWay& way)
{
    const auto& spacing = way.spacing;
    std::vector<base::Duration> arrived;
    for (const auto& delay : way.delays) {
        if (delay) arrived.push_back(*delay);
    }
    base::ensure(!arrived.empty());
    DelayFit fit{.independent = arrived.size()};
    const auto [least, greatest] = std::minmax_element(arrived.begin(), arrived.end());
    if (*greatest - *least < std::chrono::microseconds{2}) {
        fit.models.push_back({"constant", in_microseconds(Values{arrived}.mean), ConstantLaw{}});
        return fit;
    }
    fit.correlation = correlation_of(way, arrived);
    const double noise = 4.0 / std::sqrt(static_cast<double>(arrived.size()));
    std::size_t stride = 1;
    if (fit.correlation > noise && spacing) {
        const double rho = std::min(fit.correlation, 0.9999);
        const double time = -base::to_nanoseconds(*spacing) / base::log(rho);
        fit.correlation_time = in_microseconds(time);
        // exp(-5) = 0.7 % of the correlation is left.
        stride = static_cast<std::size_t>(5.0 * time / base::to_nanoseconds(*spacing)) + 1;
    }
    fit.models = Candidates{Values{arrived}}.all();
    std::vector<base::Duration> apart;
    for (std::size_t i = 0; i < arrived.size(); i += stride) apart.push_back(arrived[i]);
    fit.independent = apart.size();
    if (apart.size() < fitted_delays_min || (fit.correlation > noise && !spacing)) return fit;
    const Values independent{apart};
    for (DelayModel& model : fit.models) {
        model.distance = distance_of(model, independent);
        model.p_value = kolmogorov_tail(model.distance, static_cast<double>(apart.size()));
    }
    std::stable_sort(fit.models.begin(), fit.models.end(),
                     [](const auto& a, const auto& b) { return a.distance < b.distance; });
    return fit;
}

} // namespace hapnet::emulator::tools
