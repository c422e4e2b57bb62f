// SPDX-FileCopyrightText: 2026 The Hapnet authors
// SPDX-License-Identifier: MIT
#include "emulator/tools/verify/regimes.hpp"

#include "emulator/core/regime_chain.hpp"
#include "emulator/tools/verify/delays.hpp"
#include "emulator/tools/verify/losses.hpp"
#include "emulator/tools/verify/properties.hpp"
#include "emulator/tools/verify/tails.hpp"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <iterator>
#include <spdlog/fmt/fmt.h>
#include <utility>

namespace hapnet::emulator::tools {

namespace {

using Results = std::vector<TestResult>;
using Matrix = std::vector<std::vector<double>>;

void add_all(Results& results, Results more)
{
    std::ranges::move(more, std::back_inserter(results));
}

Matrix matrix_product(const Matrix& a, const Matrix& b)
{
    const std::size_t n = a.size();
    Matrix c(n, std::vector<double>(n));
    for (std::size_t i = 0; i < n; ++i) {
        for (std::size_t k = 0; k < n; ++k) {
            for (std::size_t j = 0; j < n; ++j) c[i][j] += a[i][k] * b[k][j];
        }
    }
    return c;
}

constexpr std::uint64_t stays_min = 10; // fewer stays allow no verdict

std::string regime_words(const Regime& regime) { return fmt::format("regime {}", regime.name); }

/// Tests how often the next datagram after one in the regime `from` was in each other regime.
Results verify_passages(std::span<const Regime> regimes, std::size_t from,
                        std::span<const Fate> fates, const std::vector<double>& expected,
                        double alpha)
{
    std::vector<std::uint64_t> counts(regimes.size());
    std::uint64_t all = 0;
    for (std::size_t i = 0; i + 1 < fates.size(); ++i) {
        if (fates[i].regime != from + 1) continue;
        ++counts[fates[i + 1].regime - 1U];
        ++all;
    }
    Results results;
    for (std::size_t to = 0; to < regimes.size(); ++to) {
        if (to == from) continue;
        auto name = fmt::format("regime {} to {}", regimes[from].name, regimes[to].name);
        if (all == 0) {
            results.push_back(unable(std::move(name), "no datagram met the first of them"));
            continue;
        }
        auto result = by_chance(std::move(name), static_cast<double>(counts[to]),
                                binomial_two_sided(counts[to], all, expected[to]), alpha);
        result.sentence =
            fmt::format("{:.4f} % expected, {:.4f} % of {} neighbours", 100.0 * expected[to],
                        100.0 * static_cast<double>(counts[to]) / static_cast<double>(all), all);
        results.push_back(std::move(result));
    }
    return results;
}

/// Tests the stays in a regime: their lengths have to be geometric, and their number has to agree
/// with the law.
TestResult verify_stays(const Regime& regime, std::size_t index, std::span<const Fate> fates,
                        double remains, double alpha)
{
    LossTally runs; // runs of datagrams in the regime
    std::uint64_t left = 0;
    std::uint64_t stayed = 0;
    for (std::size_t i = 0; i < fates.size(); ++i) {
        const bool is_inside = fates[i].regime == index + 1;
        runs.add(is_inside);
        if (!is_inside || i + 1 == fates.size()) continue;
        ++(fates[i + 1].regime == index + 1 ? stayed : left);
    }
    RunLengths law;
    constexpr double rare = 1e-9;
    for (double at_least = 1.0; at_least > rare; at_least *= remains) {
        law.at_least.push_back(at_least);
    }
    const auto lengths = test_run_lengths(runs, law, alpha);
    const double of_number =
        left + stayed > 0 ? binomial_two_sided(left, left + stayed, 1.0 - remains) : 1.0;
    auto name = regime_words(regime) + " stays";
    if (left < stays_min) return unable(std::move(name), fmt::format("{} stays: too few", left));
    // The test that fails more clearly counts. With two tests a failure is twice as likely.
    const double p = std::min(1.0, 2.0 * std::min(of_number, lengths.p_value.value_or(1.0)));
    auto result = by_chance(std::move(name), static_cast<double>(left), p, alpha);
    result.sentence = fmt::format(
        "{} stays of {:.4g} datagrams on average, {:.4g} expected (exponential)", left,
        static_cast<double>(left + stayed) / static_cast<double>(left), 1.0 / (1.0 - remains));
    return result;
}

/// Returns the losses of one regime. Stretches that do not follow each other are separated by a
/// datagram without a state.
LossRecord separated(std::span<const Fate> fates, std::size_t regime, std::size_t laws)
{
    const Fate none;
    std::vector<Fate> own;
    for (const Fate& fate : fates) {
        if (fate.regime == regime + 1) {
            own.push_back(fate);
        } else if (!own.empty() && own.back() != none) {
            own.push_back(none);
        }
    }
    return loss_record(own, laws);
}

/// Returns datagrams of a regime that are at least `stride` apart.
std::vector<Fate> thinned(std::span<const Fate> fates, std::size_t regime, std::size_t stride)
{
    std::vector<Fate> own;
    std::size_t next = 0;
    for (std::size_t i = 0; i < fates.size(); ++i) {
        if (fates[i].regime != regime + 1 || i < next) continue;
        own.push_back(fates[i]);
        next = i + stride;
    }
    return own;
}

/// Tests losses within a regime. Independent losses are tested as outside of regimes. For other
/// laws only the shares and the steps of their chains are tested, because runs end where the regime
/// ends.
Results verify_losses_within(const std::vector<LossLaw>& laws, std::span<const Fate> fates,
                             std::size_t regime, std::optional<base::Duration> spacing,
                             double alpha)
{
    const auto own = thinned(fates, regime, 1);
    const auto record = loss_record(own, laws.size());
    const bool is_independent =
        laws.empty() || (laws.size() == 1 && std::holds_alternative<RandomLoss>(laws.front()));
    if (is_independent) return verify_losses(laws, record, spacing, alpha);
    const auto apart = separated(fates, regime, laws.size());
    Results results;
    for (std::size_t i = 0; i < laws.size(); ++i) {
        for (const LossProperty& property : properties_of(laws[i], {own.size(), spacing})) {
            const bool is_share = std::holds_alternative<LongRunShare>(property);
            const bool is_of_states = std::holds_alternative<StateStep>(property) ||
                                      std::holds_alternative<LossesInState>(property);
            const bool is_alone = laws.size() == 1 && !record.is_hidden;
            if (is_share && is_alone) {
                add_all(results,
                        verify_properties({property}, record.lost, record.states[i], alpha));
            } else if (std::holds_alternative<StateStep>(property) || (is_of_states && is_alone)) {
                add_all(results, verify_properties({property}, apart.lost, apart.states[i], alpha));
            }
        }
    }
    if (results.empty()) {
        results.push_back(unable("losses", "of these laws only whole runs of datagrams tell, and "
                                           "regimes cut them"));
    }
    return results;
}

Results verify_delays_within(Conditions conditions, std::span<const Fate> fates, std::size_t regime,
                             std::optional<base::Duration> spacing, double alpha)
{
    constexpr base::Duration none{0};
    const auto memory =
        std::max(conditions.delay.correlation_time, conditions.jitter.correlation_time);
    if (memory == none) {
        return verify_delays(conditions, thinned(fates, regime, 1), spacing, alpha);
    }
    if (!spacing) {
        return {unable("delay law", "delays are correlated in time, and the spacing of the "
                                    "datagrams is not known")};
    }
    // exp(-5) = 0.7 % of the correlation is left, which is negligible for the test of the law, but
    // not for the test of the correlation itself.
    const auto stride = static_cast<std::size_t>(5 * memory / *spacing) + 1;
    conditions.delay.correlation_time = conditions.jitter.correlation_time = none;
    auto results = verify_delays(conditions, thinned(fates, regime, stride), spacing, alpha);
    std::erase_if(results, [](const TestResult& one) { return one.name == "delay correlation"; });
    return results;
}

} // namespace

/// Computes the exponential by halving the time until it is short, and squaring (Moler and Van
/// Loan, SIAM Review 45, 2003).
std::vector<std::vector<double>> passages_of(std::span<const Regime> regimes, base::Duration after)
{
    const std::size_t n = regimes.size();
    Matrix rates;
    double fastest = 0.0;
    for (std::size_t i = 0; i < n; ++i) {
        const double rate = base::to_seconds(after) / base::to_seconds(regimes[i].stay);
        rates.push_back(followers_of(regimes, i));
        for (double& one : rates.back()) one *= rate;
        rates[i][i] = -rate;
        fastest = std::max(fastest, rate);
    }
    int halvings = 0;
    for (; fastest > 1e-2; fastest /= 2.0) ++halvings;
    const double scale = std::ldexp(1.0, -halvings);
    Matrix sum(n, std::vector<double>(n));
    Matrix term = sum;
    for (std::size_t i = 0; i < n; ++i) sum[i][i] = term[i][i] = 1.0;
    constexpr int terms = 8; // the next is below 1e-21
    for (int k = 1; k <= terms; ++k) {
        term = matrix_product(term, rates);
        for (std::size_t i = 0; i < n; ++i) {
            for (std::size_t j = 0; j < n; ++j) {
                term[i][j] *= scale / k;
                sum[i][j] += term[i][j];
            }
        }
    }
    for (int i = 0; i < halvings; ++i) sum = matrix_product(sum, sum);
    return sum;
}

std::vector<TestResult> verify_regimes(const Conditions& conditions, std::span<const Fate> fates,
                                       std::optional<base::Duration> spacing, double alpha)
{
    const std::span<const Regime> regimes{conditions.regimes.all.get()};
    const auto is_known = [&](const Fate& fate) {
        return fate.regime > 0 && fate.regime <= regimes.size();
    };
    if (!std::ranges::all_of(fates, is_known)) {
        return {unable("regimes", "the fates do not say which regime each datagram met")};
    }
    Results results;
    if (spacing) {
        const auto passages = passages_of(regimes, *spacing);
        for (std::size_t i = 0; i < regimes.size(); ++i) {
            add_all(results, verify_passages(regimes, i, fates, passages[i], alpha));
            results.push_back(verify_stays(regimes[i], i, fates, passages[i][i], alpha));
        }
    } else {
        results.push_back(unable("regimes", "how long they last tells only the spacing of the "
                                            "datagrams, which is not known: --spacing"));
    }
    for (std::size_t i = 0; i < regimes.size(); ++i) {
        const Conditions own = in_regime(conditions, i);
        auto within = verify_losses_within(own.loss, fates, i, spacing, alpha);
        add_all(within, verify_delays_within(own, fates, i, spacing, alpha));
        for (TestResult& result : within) {
            result.name = fmt::format("{}, {}", regime_words(regimes[i]), result.name);
        }
        add_all(results, std::move(within));
    }
    return results;
}

} // namespace hapnet::emulator::tools
