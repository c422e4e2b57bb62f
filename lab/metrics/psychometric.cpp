// SPDX-FileCopyrightText: 2026 The Hapnet authors
// SPDX-License-Identifier: MIT
#include "lab/metrics/psychometric.hpp"

#include "proto/base/ensure.hpp"
#include "proto/base/math.hpp"
#include "proto/base/normal.hpp"
#include "proto/base/random.hpp"

#include <algorithm>
#include <array>
#include <cmath>

namespace hapnet::lab::metrics {

namespace {

struct Lapses {
    double early = 0.0;
    double late = 0.0;
};
constexpr std::array<Lapses, 9> lapse_pairs{{{0.0, 0.0},
                                             {0.0, 0.025},
                                             {0.0, 0.05},
                                             {0.025, 0.0},
                                             {0.025, 0.025},
                                             {0.025, 0.05},
                                             {0.05, 0.0},
                                             {0.05, 0.025},
                                             {0.05, 0.05}}};
/// The evidence for the second core that is required to prefer it, as the logarithm of a likelihood
/// ratio. It corresponds to a difference of 4 in Akaike's criterion, from which Burnham and
/// Anderson ("Model Selection and Multimodel Inference", 2002, 2.6) call the other model
/// considerably less supported.
constexpr double evidence = 2.0;
constexpr int steps_max = 40;
constexpr double tenth_of_seeds = 0.1;
constexpr double half_of_seeds = 0.5;

/// A core and its slope.
struct Rise {
    double share = 0.0;
    double slope = 0.0;
};

Rise rise_of(Core core, double z)
{
    constexpr double far = 30.0, top = 3.4; // at `top`, exp(-exp(z)) is 1e-13
    if (core == Core::logistic) {
        const double share = 1.0 / (1.0 + base::exp(-std::clamp(z, -far, far)));
        return {share, share * (1.0 - share)};
    }
    const double rate = base::exp(std::clamp(z, -far, top));
    const double passes = base::exp(-rate);
    return {1.0 - passes, rate * passes};
}

/// The two parameters: location, and the logarithm of the scale.
struct Parameters {
    double location = 0.0;
    double log_scale = 0.0;
};

/// The posterior of a curve with given lapses. Levels are in units of their distance.
class Posterior {
public:
    Posterior(std::span<const FailCount> counts, Core core, double early, double late)
        : counts_{counts}, core_{core}, early_{early}, gain_{1.0 - early - late}
    {}

    [[nodiscard]] double at(const Parameters& p) const
    {
        double sum = -0.5 * p.log_scale * p.log_scale;
        const double scale = base::exp(p.log_scale);
        for (const FailCount& count : counts_) {
            const double share = clamped(rise_of(core_, (count.level - p.location) / scale).share);
            sum += count.failed * base::log(share) +
                   (count.of - count.failed) * base::log(1.0 - share);
        }
        return sum;
    }

    /// Makes one step of Fisher scoring. It uses the expected curvature, so it always climbs.
    [[nodiscard]] Parameters step(const Parameters& p) const
    {
        const double scale = base::exp(p.log_scale);
        double g_a = 0.0, g_t = -p.log_scale; // the gradient
        double h_aa = 1e-6, h_at = 0.0, h_tt = 1.0;
        for (const FailCount& count : counts_) {
            const double z = (count.level - p.location) / scale;
            const Rise rise = rise_of(core_, z);
            const double share = clamped(rise.share);
            const double slope = gain_ * rise.slope;
            const double d_a = -slope / scale, d_t = -slope * z;
            const double spread = share * (1.0 - share);
            const double pull = (count.failed - count.of * share) / spread;
            g_a += pull * d_a;
            g_t += pull * d_t;
            const double weight = count.of / spread;
            h_aa += weight * d_a * d_a;
            h_at += weight * d_a * d_t;
            h_tt += weight * d_t * d_t;
        }
        const double determinant = h_aa * h_tt - h_at * h_at;
        return {(h_tt * g_a - h_at * g_t) / determinant, (h_aa * g_t - h_at * g_a) / determinant};
    }

private:
    [[nodiscard]] double clamped(double f) const
    {
        constexpr double least = 1e-9;
        return std::clamp(early_ + gain_ * f, least, 1.0 - least);
    }

    std::span<const FailCount> counts_;
    Core core_;
    double early_;
    double gain_;
};

/// Climbs until the posterior is flat. A step that leads down, or far away, is halved.
Parameters climbed(const Posterior& posterior, Parameters p, const Interval& within)
{
    constexpr double flat = 1e-7;
    double height = posterior.at(p);
    for (int i = 0; i < steps_max; ++i) {
        const Parameters step = posterior.step(p);
        double share = 1.0;
        Parameters next = p;
        double gained = 0.0;
        for (int halving = 0; halving < 12; ++halving, share /= 2.0) {
            next = {std::clamp(p.location + share * step.location, within.low, within.high),
                    std::clamp(p.log_scale + share * step.log_scale, -4.0, 4.0)};
            gained = posterior.at(next) - height;
            if (gained >= 0.0) break;
        }
        if (gained <= flat) break;
        p = next;
        height += gained;
    }
    return p;
}

/// Returns the level at which half fail if straight lines join the levels. The climb begins there.
double crossing(std::span<const FailCount> counts)
{
    for (std::size_t i = 0; i < counts.size(); ++i) {
        const double share = counts[i].failed / counts[i].of;
        if (share < half_of_seeds) continue;
        if (i == 0) return counts[0].level;
        const double before = counts[i - 1].failed / counts[i - 1].of;
        const double part = (half_of_seeds - before) / std::max(share - before, 1e-9);
        return counts[i - 1].level + part * (counts[i].level - counts[i - 1].level);
    }
    return counts.back().level;
}

std::vector<FailCount> counts_of(std::span<const LevelOutcome> outcomes,
                                 const std::vector<double>& weights)
{
    std::vector<FailCount> counts;
    for (const LevelOutcome& outcome : outcomes) {
        FailCount& count = counts.emplace_back(FailCount{outcome.level, 0.0, 0.0});
        for (std::size_t seed = 0; seed < weights.size(); ++seed) {
            count.of += weights[seed];
            if (outcome.failed[seed]) count.failed += weights[seed];
        }
    }
    return counts;
}

/// Returns the p50 of one sample: `beyond` when it is not within the levels.
double half_of(std::span<const FailCount> counts, const Psychometric& curve)
{
    const double at = std::max(curve.level_of(half_of_seeds), 0.0);
    return at > counts.back().level ? beyond : at;
}

/// Returns the p50 with one level, where there is nothing to fit.
double half_of(std::span<const FailCount> counts)
{
    if (counts.size() > 1) return half_of(counts, fitted(counts));
    return 2.0 * counts[0].failed < counts[0].of ? beyond : counts[0].level;
}

/// Returns the fewest failures, of `of` sessions, that a two-sided sign test at 5 % accepts as one
/// half; at least 1. It is also the fewest passes.
double fewest_for_half(double of)
{
    constexpr double tail = 0.025;
    double one = 1.0; // the probability of k failures, from k = 0 on
    for (double i = 0.0; i < of; i += 1.0) one /= 2.0;
    double sum = one, k = 0.0;
    while (sum <= tail) {
        one *= (of - k) / (k + 1.0);
        k += 1.0;
        sum += one;
    }
    return std::max(k, 1.0);
}

/// Returns the gap between two levels in which one half is crossed. Returns nullopt when one of the
/// levels, or the order of them, leaves its place open.
std::optional<Interval> gap_of(std::span<const FailCount> counts)
{
    const double fewest = fewest_for_half(counts.front().of);
    double low = 0.0, high = beyond;
    for (const FailCount& count : counts) {
        const bool is_below = count.failed < fewest;
        const bool is_above = count.of - count.failed < fewest;
        if (is_below == is_above) return std::nullopt; // compatible with one half, or a single seed
        if (is_below) low = count.level;
        if (is_above) high = std::min(high, count.level);
    }
    if (low > high) return std::nullopt;
    return Interval{low, high};
}

/// Returns Student's 97.5th percentile by the expansion for many degrees of freedom (Abramowitz and
/// Stegun 26.7.5). It is 0.003 too small for three degrees.
double students(double degrees)
{
    const double z = base::normal_quantile(0.975);
    const double z2 = z * z;
    const std::array<double, 4> terms{
        (z2 + 1.0) / 4.0, ((5.0 * z2 + 16.0) * z2 + 3.0) / 96.0,
        (((3.0 * z2 + 19.0) * z2 + 17.0) * z2 - 15.0) / 384.0,
        ((((79.0 * z2 + 776.0) * z2 + 1482.0) * z2 - 1920.0) * z2 - 945.0) / 92160.0};
    double sum = 1.0, power = 1.0;
    for (const double term : terms) {
        power /= degrees;
        sum += power * term;
    }
    return z * sum;
}

/// Returns the share of replicates below a 95 % interval.
double share_below(std::uint32_t seeds)
{
    if (seeds < 2) return 0.025;
    const double degrees = seeds - 1.0;
    return base::normal_cdf(-std::sqrt(seeds / degrees) * students(degrees));
}

} // namespace

std::vector<std::vector<double>> drawn_weights(std::size_t seeds, std::size_t draws)
{
    const auto stream = base::Seed{1}.stream("bootstrap of seeds");
    std::vector<std::vector<double>> weights(bootstrap_replicates, std::vector<double>(seeds, 0.0));
    for (std::uint32_t replicate = 0; replicate < bootstrap_replicates; ++replicate) {
        for (std::size_t draw = 0; draw < draws; ++draw) {
            const auto seed = stream.below(static_cast<std::uint32_t>(seeds), draw, replicate);
            weights[replicate][static_cast<std::size_t>(seed)] += 1.0;
        }
    }
    return weights;
}

double Psychometric::share_at(double level) const
{
    return early + (1.0 - early - late) * rise_of(core, (level - location) / scale).share;
}

double Psychometric::level_of(double share) const
{
    const double f = (share - early) / (1.0 - early - late);
    const double z =
        core == Core::logistic ? base::log(f / (1.0 - f)) : base::log(-base::log(1.0 - f));
    return location + scale * z;
}

Psychometric fitted(std::span<const FailCount> counts)
{
    base::ensure(counts.size() > 1);
    const double unit =
        (counts.back().level - counts.front().level) / static_cast<double>(counts.size() - 1);
    std::vector<FailCount> scaled(counts.begin(), counts.end());
    for (FailCount& count : scaled) count.level = (count.level - counts.front().level) / unit;
    const double width = scaled.back().level;
    std::optional<Psychometric> best;
    double highest = 0.0;
    for (const Core core : {Core::logistic, Core::gumbel}) {
        // Gumbel's core needs evidence: where the levels show no shape, half-way is the honest
        // estimate.
        double to_beat = highest + (core == Core::gumbel ? evidence : 0.0);
        Parameters p{crossing(scaled), 0.0};
        for (const auto& [early, late] : lapse_pairs) {
            const Posterior posterior{scaled, core, early, late};
            p = climbed(posterior, p, {-width, 2.0 * width});
            const double height = posterior.at(p);
            if (best && height <= to_beat + 1e-6) continue; // keep the simpler fit
            to_beat = highest = height;
            best = Psychometric{counts.front().level + unit * p.location,
                                unit * base::exp(p.log_scale), early, late, core};
        }
    }
    return *best;
}

Interval interval_of(std::vector<double> values, std::uint32_t seeds)
{
    base::ensure(!values.empty());
    std::ranges::sort(values);
    const auto count = static_cast<double>(values.size());
    const double rank = std::max(std::ceil(share_below(seeds) * count), 1.0);
    const auto from_end = static_cast<std::size_t>(rank) - 1;
    return {values[from_end], values[values.size() - 1 - from_end]};
}

std::vector<double> p50_replicates(std::span<const LevelOutcome> outcomes, std::size_t draws)
{
    base::ensure(!outcomes.empty() && draws > 0);
    std::vector<double> found;
    for (const auto& weights : drawn_weights(outcomes[0].failed.size(), draws))
        found.push_back(half_of(counts_of(outcomes, weights)));
    return found;
}

Threshold threshold_of(std::span<const LevelOutcome> outcomes, double top)
{
    base::ensure(!outcomes.empty() && !outcomes[0].failed.empty());
    const std::size_t seeds = outcomes[0].failed.size();
    const auto counts = counts_of(outcomes, std::vector<double>(seeds, 1.0));
    Threshold threshold{.seeds = static_cast<std::uint32_t>(seeds)};
    const double found = half_of(counts);
    threshold.is_open = found == beyond;
    threshold.p50 = std::min(found, top);
    if (counts.size() > 1) {
        const double at = std::max(fitted(counts).level_of(tenth_of_seeds), 0.0);
        if (at <= counts.back().level) threshold.p10 = at;
    }
    threshold.replicates = p50_replicates(outcomes, seeds);
    Interval interval = interval_of(threshold.replicates, threshold.seeds);
    if (const auto gap = gap_of(counts)) {
        interval = {std::min(interval.low, gap->low), std::max(interval.high, gap->high)};
    }
    threshold.low = std::min(interval.low, top);
    if (interval.high != beyond && !threshold.is_open) threshold.high = interval.high;
    return threshold;
}

Difference difference_of(const Threshold& a, const Threshold& b)
{
    base::ensure(a.replicates.size() == b.replicates.size());
    const auto apart = [](double x, double y) { return x == y ? 0.0 : x - y; };
    std::vector<double> replicates;
    for (std::size_t i = 0; i < a.replicates.size(); ++i)
        replicates.push_back(apart(a.replicates[i], b.replicates[i]));
    const double value = apart(a.is_open ? beyond : a.p50, b.is_open ? beyond : b.p50);
    return {value, interval_of(std::move(replicates), a.seeds)};
}

} // namespace hapnet::lab::metrics
