// SPDX-FileCopyrightText: 2026 The Hapnet authors
// SPDX-License-Identifier: MIT
#include "emulator/tools/learn/four_state_fit.hpp"

#include "proto/base/math.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <span>
#include <tuple>

namespace hapnet::emulator::tools {

namespace {

/// The state of a run. usual: arrivals in the gap, or losses in a burst; special: arrivals in a
/// burst, or an isolated loss.
enum Side : std::size_t { usual, special };
using Pair = std::array<double, 2>;

/// The number of times that each step was taken, and that each state stayed.
struct StepCounts {
    double gap_stays = 0.0;
    double gap_to_burst = 0.0;
    double gap_to_isolated = 0.0;
    double burst_stays = 0.0;
    double burst_to_gap = 0.0;
    double burst_to_good_run = 0.0;
    double good_run_stays = 0.0;
    double good_run_to_burst = 0.0;

    [[nodiscard]] FourStateSteps most_likely() const
    {
        const auto share = [](double part, double of) { return of > 0.0 ? part / of : 0.0; };
        const double gap = gap_stays + gap_to_burst + gap_to_isolated;
        const double burst = burst_stays + burst_to_gap + burst_to_good_run;
        return {.gap_to_burst = share(gap_to_burst, gap),
                .gap_to_isolated = share(gap_to_isolated, gap),
                .burst_to_gap = share(burst_to_gap, burst),
                .burst_to_good_run = share(burst_to_good_run, burst),
                .good_run_to_burst = share(good_run_to_burst, good_run_stays + good_run_to_burst)};
    }

    /// Adds the stays of a run that has each of its two states with this probability.
    void add_stay(const LossRun& run, Pair at)
    {
        const auto more = static_cast<double>(run.length - 1);
        if (run.is_lost) {
            burst_stays += at[usual] * more;
        } else {
            gap_stays += at[usual] * more;
            good_run_stays += at[special] * more;
        }
    }
    void add_step(bool from_lost, Side from, Side to, double share)
    {
        // After an isolated loss the chain always returns to the gap.
        if (from_lost && from == special) return;
        double& count = from_lost         ? (to == usual ? burst_to_gap : burst_to_good_run)
                        : from == special ? good_run_to_burst
                        : to == usual     ? gap_to_burst
                                          : gap_to_isolated;
        count += share;
    }
};

double log_of(double probability) { return base::log(std::max(probability, 1e-300)); }

/// The forward and backward algorithm over runs.
class RunSums {
public:
    explicit RunSums(std::span<const LossRun> runs)
        : runs_{runs}, weights_(runs.size()), forward_(runs.size())
    {}

    /// Returns the expected counts under a chain, and its log likelihood.
    [[nodiscard]] StepCounts expect(const FourStateSteps& steps, double& log_likelihood)
    {
        log_likelihood = weigh(steps) + go_forward(steps);
        StepCounts counts;
        Pair backward{1.0, 1.0};
        for (std::size_t i = runs_.size(); i-- > 0;) {
            Pair here{forward_[i][usual] * backward[usual],
                      forward_[i][special] * backward[special]};
            const double sum = std::max(here[usual] + here[special], 1e-300);
            for (double& one : here) one /= sum;
            counts.add_stay(runs_[i], here);
            if (i > 0) backward = step_back(steps, i, backward, counts);
        }
        return counts;
    }

private:
    /// Returns the probability of a step from one state of a run to a state of the next run.
    [[nodiscard]] static double step(const FourStateSteps& steps, bool from_lost, Side from,
                                     Side to)
    {
        if (from_lost && from == usual) {
            return to == usual ? steps.burst_to_gap : steps.burst_to_good_run;
        }
        if (from_lost) return to == usual ? 1.0 : 0.0;
        if (from == special) return to == usual ? steps.good_run_to_burst : 0.0;
        return to == usual ? steps.gap_to_burst : steps.gap_to_isolated;
    }

    /// Sets the weight of both states for the length of each run, scaled so that the larger one is
    /// 1. Returns the sum of the logarithms of the scales.
    double weigh(const FourStateSteps& steps)
    {
        const double gap = log_of(1.0 - steps.gap_to_burst - steps.gap_to_isolated);
        const double good_run = log_of(1.0 - steps.good_run_to_burst);
        const double burst = log_of(1.0 - steps.burst_to_gap - steps.burst_to_good_run);
        double divided_out = 0.0;
        for (std::size_t i = 0; i < runs_.size(); ++i) {
            const auto more = static_cast<double>(runs_[i].length - 1);
            const bool is_alone = runs_[i].length == 1;
            const double first = more * (runs_[i].is_lost ? burst : gap);
            const double second = runs_[i].is_lost ? (is_alone ? 0.0 : -1e300) : more * good_run;
            const double larger = std::max(first, second);
            weights_[i] = {base::exp(std::max(first - larger, -700.0)),
                           second - larger < -700.0 ? 0.0 : base::exp(second - larger)};
            divided_out += larger;
        }
        return divided_out;
    }

    double go_forward(const FourStateSteps& steps)
    {
        const auto shares = steps.shares();
        Pair before = runs_.front().is_lost
                          ? Pair{shares.lost_in_burst, shares.lost_in_gap}
                          : Pair{shares.received_in_gap, shares.received_in_burst};
        double log_likelihood = 0.0;
        for (std::size_t i = 0; i < runs_.size(); ++i) {
            Pair now = before;
            if (i > 0) {
                const bool from_lost = runs_[i - 1].is_lost;
                for (const Side to : {usual, special}) {
                    now[to] = before[usual] * step(steps, from_lost, usual, to) +
                              before[special] * step(steps, from_lost, special, to);
                }
            }
            for (const Side side : {usual, special}) now[side] *= weights_[i][side];
            const double sum = std::max(now[usual] + now[special], 1e-300);
            log_likelihood += base::log(sum);
            for (double& one : now) one /= sum;
            forward_[i] = before = now;
        }
        return log_likelihood;
    }

    /// Returns the backward variable of i - 1 from that of i, up to a factor. Adds the steps
    /// between them to `counts`.
    Pair step_back(const FourStateSteps& steps, std::size_t i, const Pair& backward,
                   StepCounts& counts)
    {
        const bool from_lost = runs_[i - 1].is_lost;
        std::array<Pair, 2> ways{};
        Pair earlier{};
        double all = 0.0;
        for (const Side from : {usual, special}) {
            for (const Side to : {usual, special}) {
                const double way =
                    step(steps, from_lost, from, to) * weights_[i][to] * backward[to];
                earlier[from] += way;
                ways[from][to] = forward_[i - 1][from] * way;
                all += ways[from][to];
            }
        }
        all = std::max(all, 1e-300);
        for (const Side from : {usual, special}) {
            for (const Side to : {usual, special}) {
                counts.add_step(from_lost, from, to, ways[from][to] / all);
            }
        }
        const double scale = std::max({earlier[usual], earlier[special], 1e-300});
        return {earlier[usual] / scale, earlier[special] / scale};
    }

    std::span<const LossRun> runs_;
    std::vector<Pair> weights_;
    std::vector<Pair> forward_;
};

/// Returns the counts if fewer than `gap` consecutive arrivals are within a burst.
StepCounts counted(std::span<const LossRun> runs, std::size_t gap)
{
    const auto is_gap = [&](std::size_t i) { return i >= runs.size() || runs[i].length >= gap; };
    const auto side_of = [&](std::size_t i) {
        if (!runs[i].is_lost) return is_gap(i) ? usual : special;
        const bool is_alone = runs[i].length == 1 && (i == 0 || is_gap(i - 1)) && is_gap(i + 1);
        return is_alone ? special : usual;
    };
    constexpr double a_little = 0.5; // more than 0, so that no step is impossible
    StepCounts counts{a_little, a_little, a_little, a_little,
                      a_little, a_little, a_little, a_little};
    for (std::size_t i = 0; i < runs.size(); ++i) {
        const Side side = side_of(i);
        Pair at{};
        at[side] = 1.0;
        counts.add_stay(runs[i], at);
        if (i + 1 < runs.size()) counts.add_step(runs[i].is_lost, side, side_of(i + 1), 1.0);
    }
    return counts;
}

/// Makes at most `iterations_max` iterations.
void iterate(RunSums& sums, FourStateFit& fit, int iterations_max)
{
    constexpr double enough = 1e-5; // stops when the log likelihood gains less
    double before = -1e300;
    for (int i = 0;; ++i) {
        const StepCounts counts = sums.expect(fit.steps, fit.log_likelihood);
        if (fit.log_likelihood - before < enough || i == iterations_max) return;
        before = fit.log_likelihood;
        fit.steps = counts.most_likely();
    }
}

/// Rounds to the digits that a measurement can have.
base::Probability rounded(double share)
{
    return *base::Probability::from_fraction(std::clamp(std::round(share * 1e6) / 1e6, 0.0, 1.0));
}

} // namespace

FourState law_of(const FourStateSteps& steps)
{
    const double isolated = steps.gap_to_isolated / (1.0 + steps.gap_to_isolated);
    const double density =
        steps.good_run_to_burst / (steps.good_run_to_burst + steps.burst_to_good_run);
    const auto shares = steps.shares();
    // Lengths are rounded up, because shorter ones may be invalid with the other numbers.
    const auto length = [](double value) { return std::ceil(value * 1e4) / 1e4; };
    return {.share = rounded(shares.lost_in_burst + shares.lost_in_gap),
            .burst = length(1.0 / (density * steps.burst_to_gap)),
            .density = rounded(density),
            .isolated = rounded(isolated),
            .good_run = length(1.0 / steps.good_run_to_burst)};
}

LossChain chain_of(const FourStateSteps& steps)
{
    enum State : std::size_t { gap, burst, good_run, isolated };
    LossChain chain{.loses = {0.0, 1.0, 0.0, 1.0}};
    chain.steps[gap] = {1.0 - steps.gap_to_burst - steps.gap_to_isolated, steps.gap_to_burst, 0.0,
                        steps.gap_to_isolated};
    chain.steps[burst] = {steps.burst_to_gap, 1.0 - steps.burst_to_gap - steps.burst_to_good_run,
                          steps.burst_to_good_run, 0.0};
    chain.steps[good_run] = {0.0, steps.good_run_to_burst, 1.0 - steps.good_run_to_burst, 0.0};
    chain.steps[isolated] = {1.0, 0.0, 0.0, 0.0};
    const auto shares = steps.shares();
    chain.shares = {shares.received_in_gap, shares.lost_in_burst, shares.received_in_burst,
                    shares.lost_in_gap};
    return chain;
}

std::optional<FourStateFit> fit_four_states(const std::vector<LossRun>& all)
{
    constexpr std::size_t runs_max = 20'000;
    constexpr std::size_t runs_min = 5;  // with fewer there are more parameters than runs
    constexpr int iterations_first = 15; // for each start
    constexpr int iterations_max = 200;  // for the best start
    if (all.size() < runs_min) return std::nullopt;
    const auto runs = std::span{all}.first(std::min(all.size(), runs_max));
    RunSums sums{runs};
    std::optional<FourStateFit> best;
    for (const std::size_t gap : {4U, 16U, 64U}) {
        FourStateFit fit{.steps = counted(runs, gap).most_likely()};
        iterate(sums, fit, iterations_first);
        if (!best || fit.log_likelihood > best->log_likelihood) best = fit;
    }
    iterate(sums, *best, iterations_max);
    const auto& steps = best->steps;
    constexpr double least = 1e-9;
    if (steps.gap_to_burst < least || steps.burst_to_gap < least ||
        steps.good_run_to_burst < least) {
        return std::nullopt;
    }
    best->law = law_of(steps);
    if (!best->law.validate()) return std::nullopt;
    if (runs.size() < all.size()) {
        std::ignore = RunSums{all}.expect(steps, best->log_likelihood);
    }
    return best;
}

} // namespace hapnet::emulator::tools
