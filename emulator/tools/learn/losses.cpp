// SPDX-FileCopyrightText: 2026 The Hapnet authors
// SPDX-License-Identifier: MIT
#include "emulator/tools/learn/losses.hpp"

#include "emulator/tools/learn/four_state_fit.hpp"
#include "proto/base/math.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <optional>

namespace hapnet::emulator::tools {

namespace {

/// Two states that step once per datagram, each with a share of losses: 0 good, 1 bad.
struct Chain {
    std::array<double, 2> leaves{}; // probability of leaving each state
    std::array<double, 2> loses{};

    [[nodiscard]] std::array<double, 2> stationary() const
    {
        const double sum = leaves[0] + leaves[1];
        if (sum <= 0.0) return {0.5, 0.5};
        return {leaves[1] / sum, leaves[0] / sum};
    }
    [[nodiscard]] double step(std::size_t from, std::size_t to) const
    {
        return from == to ? 1.0 - leaves[from] : leaves[from];
    }
    [[nodiscard]] double emits(std::size_t state, bool is_lost) const
    {
        return is_lost ? loses[state] : 1.0 - loses[state];
    }
    [[nodiscard]] LossChain states() const
    {
        LossChain chain;
        chain.loses = {loses[0], loses[1]};
        chain.steps[0] = {1.0 - leaves[0], leaves[0]};
        chain.steps[1] = {leaves[1], 1.0 - leaves[1]};
        const auto shares = stationary();
        chain.shares = {shares[0], shares[1]};
        return chain;
    }
};

/// The sums of one pass of Baum and Welch's iteration.
struct Expected {
    std::array<double, 2> visits{};
    std::array<double, 2> losses{};
    std::array<double, 2> departures{}; // departures to the other state
    std::array<double, 2> steps{};      // steps from each state to the next datagram
    double log_likelihood = 0.0;
};

class BaumWelch {
public:
    explicit BaumWelch(const std::vector<bool>& lost)
        : lost_{lost}, forward_(lost.size()), scale_(lost.size())
    {}

    [[nodiscard]] Expected expect(const Chain& chain)
    {
        Expected sums;
        go_forward(chain, sums);
        std::array<double, 2> backward{1.0, 1.0};
        for (std::size_t i = lost_.size(); i-- > 0;) {
            for (std::size_t state = 0; state < 2; ++state) {
                const double here = forward_[i][state] * backward[state];
                sums.visits[state] += here;
                if (lost_[i]) sums.losses[state] += here;
            }
            if (i > 0) backward = step_back(chain, i, backward, sums);
        }
        return sums;
    }

private:
    void go_forward(const Chain& chain, Expected& sums)
    {
        std::array<double, 2> before = chain.stationary();
        for (std::size_t i = 0; i < lost_.size(); ++i) {
            std::array<double, 2> now = before;
            if (i > 0) {
                for (std::size_t to = 0; to < 2; ++to) {
                    now[to] = before[0] * chain.step(0, to) + before[1] * chain.step(1, to);
                }
            }
            for (std::size_t state = 0; state < 2; ++state)
                now[state] *= chain.emits(state, lost_[i]);
            scale_[i] = std::max(now[0] + now[1], 1e-300);
            sums.log_likelihood += base::log(scale_[i]);
            for (double& one : now) one /= scale_[i];
            forward_[i] = before = now;
        }
    }

    /// Returns the backward variable of i - 1 from that of i, with the steps between the two.
    std::array<double, 2> step_back(const Chain& chain, std::size_t i,
                                    const std::array<double, 2>& backward, Expected& sums)
    {
        std::array<double, 2> earlier{};
        for (std::size_t from = 0; from < 2; ++from) {
            for (std::size_t to = 0; to < 2; ++to) {
                const double way =
                    chain.step(from, to) * chain.emits(to, lost_[i]) * backward[to] / scale_[i];
                earlier[from] += way;
                const double share = forward_[i - 1][from] * way;
                sums.steps[from] += share;
                if (from != to) sums.departures[from] += share;
            }
        }
        return earlier;
    }

    const std::vector<bool>& lost_;
    std::vector<std::array<double, 2>> forward_;
    std::vector<double> scale_;
};

struct FittedChain {
    Chain chain;
    double log_likelihood = 0.0;
};

FittedChain iterate(BaumWelch& sums, Chain chain)
{
    constexpr int iterations_max = 300;
    double before = -1e300;
    for (int i = 0;; ++i) {
        const Expected expected = sums.expect(chain);
        const bool is_done = expected.log_likelihood - before < 1e-6 || i == iterations_max;
        if (is_done) return {chain, expected.log_likelihood};
        before = expected.log_likelihood;
        for (std::size_t state = 0; state < 2; ++state) {
            chain.leaves[state] =
                expected.departures[state] / std::max(expected.steps[state], 1e-300);
            chain.loses[state] = expected.losses[state] / std::max(expected.visits[state], 1e-300);
        }
    }
}

/// Rounds to the digits that a measurement can have.
base::Probability probability(double share)
{
    return *base::Probability::from_fraction(std::clamp(std::round(share * 1e6) / 1e6, 0.0, 1.0));
}

/// Counts how often each of 0 and 1 follows each of them.
struct Pairs {
    std::array<std::array<double, 2>, 2> counts{};

    explicit Pairs(const std::vector<bool>& lost)
    {
        for (std::size_t i = 1; i < lost.size(); ++i) {
            counts[lost[i - 1] ? 1 : 0][lost[i] ? 1 : 0] += 1.0;
        }
    }
    [[nodiscard]] double leaves(std::size_t state) const
    {
        const double sum = counts[state][0] + counts[state][1];
        return sum > 0.0 ? counts[state][state == 0 ? 1 : 0] / sum : 0.0;
    }
};

/// x ln p, which is 0 for 0 ln 0.
double term(double count, double probability)
{
    return count > 0.0 ? count * base::log(probability) : 0.0;
}

/// Returns the model with its BIC. It was fitted to `count` datagrams.
LossModel rated(LossModel model, double count)
{
    model.bic = model.parameters * base::log(count) - 2.0 * model.log_likelihood;
    return model;
}

void add_gilbert_elliott(std::vector<LossModel>& models, const std::vector<bool>& all,
                         const Chain& gilbert, double share)
{
    // More datagrams make an iteration slow, and improve the parameters little.
    constexpr std::size_t most = 200'000;
    const std::vector<bool> lost(
        all.begin(), all.begin() + static_cast<std::ptrdiff_t>(std::min(all.size(), most)));
    BaumWelch sums{lost};
    const std::array<Chain, 3> starts{Chain{gilbert.leaves, {0.1 * share, 0.9}},
                                      Chain{{0.01, 0.1}, {0.5 * share, std::min(3.0 * share, 0.9)}},
                                      Chain{{0.001, 0.01}, {0.5 * share, 0.5 + 0.5 * share}}};
    std::optional<FittedChain> best;
    for (const Chain& start : starts) {
        const FittedChain fitted = iterate(sums, start);
        if (!best || fitted.log_likelihood > best->log_likelihood) best = fitted;
    }
    Chain chain = best->chain;
    if (chain.loses[0] > chain.loses[1]) {
        std::swap(chain.loses[0], chain.loses[1]);
        std::swap(chain.leaves[0], chain.leaves[1]);
    }
    const GilbertElliott law{probability(chain.leaves[0]), probability(chain.leaves[1]),
                             probability(chain.loses[0]), probability(chain.loses[1])};
    if (!law.validate()) return;
    models.push_back(rated({.name = "gilbert-elliott",
                            .law = law,
                            .chain = chain.states(),
                            .log_likelihood = all.size() == lost.size()
                                                  ? best->log_likelihood
                                                  : BaumWelch{all}.expect(chain).log_likelihood,
                            .parameters = 4},
                           static_cast<double>(all.size())));
}

void add_four_states(std::vector<LossModel>& models, const std::vector<LossRun>& runs, double count)
{
    const auto fit = fit_four_states(runs);
    if (!fit) return;
    models.push_back(rated({.name = "four-state",
                            .law = fit->law,
                            .chain = chain_of(fit->steps),
                            .log_likelihood = fit->log_likelihood,
                            .parameters = 5},
                           count));
}

} // namespace

std::vector<LossModel> fit_losses(const std::vector<bool>& lost)
{
    const auto n = static_cast<double>(lost.size());
    const auto losses = static_cast<double>(std::count(lost.begin(), lost.end(), true));
    if (losses == 0.0) return {};
    std::vector<LossModel> models;
    const double share = losses / n;
    LossChain one_state;
    one_state.loses[0] = share;
    one_state.shares[0] = one_state.steps[0][0] = 1.0;
    models.push_back(rated({.name = "random",
                            .law = RandomLoss{probability(share)},
                            .chain = one_state,
                            .log_likelihood = term(losses, share) + term(n - losses, 1.0 - share),
                            .parameters = 1},
                           n));
    const auto runs = runs_of(lost);
    const Pairs pairs{lost};
    const Chain gilbert{{pairs.leaves(0), pairs.leaves(1)}, {0.0, 1.0}};
    const auto [p, r] = gilbert.leaves;
    if (p > 0.0 && r > 0.0) {
        const Gilbert law{probability(p / (p + r)), std::round(1e4 / r) / 1e4};
        const auto& counts = pairs.counts;
        const double likely = term(counts[0][0], 1.0 - p) + term(counts[0][1], p) +
                              term(counts[1][0], r) + term(counts[1][1], 1.0 - r) +
                              term(1.0, lost.front() ? p / (p + r) : r / (p + r));
        if (law.validate()) {
            models.push_back(rated({.name = "gilbert",
                                    .law = law,
                                    .chain = gilbert.states(),
                                    .log_likelihood = likely,
                                    .parameters = 2},
                                   n));
        }
        add_gilbert_elliott(models, lost, gilbert, share);
        add_four_states(models, runs, n);
    }
    for (LossModel& one : models) {
        one.losses_p_value = test_runs(runs, one.chain, true);
        one.arrivals_p_value = test_runs(runs, one.chain, false);
    }
    std::stable_sort(models.begin(), models.end(),
                     [](const LossModel& a, const LossModel& b) { return a.bic < b.bic; });
    return models;
}

} // namespace hapnet::emulator::tools
