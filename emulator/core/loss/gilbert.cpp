// SPDX-FileCopyrightText: 2026 The Hapnet authors
// SPDX-License-Identifier: MIT
#include "emulator/core/loss/gilbert.hpp"

#include "proto/base/ensure.hpp"
#include "proto/base/math.hpp"
#include "proto/base/text.hpp"

#include <cmath>
#include <spdlog/fmt/fmt.h>

namespace hapnet::emulator {

namespace {

// The indices of the draws for one datagram.
constexpr std::uint32_t judging = 0;
constexpr std::uint32_t stepping = 1;
constexpr std::uint32_t beginning = 2;

bool begins_bad(const TwoStateSteps& steps, const base::RandomStream& stream)
{
    return stream.uniform(0, beginning) < steps.bad_share();
}

bool is_bad_after(bool is_bad, const TwoStateSteps& steps, double u)
{
    return is_bad ? u >= steps.bad_to_good : u < steps.good_to_bad;
}

LossTheory theory_of_chain(const TwoStateSteps& steps)
{
    const auto [p, r, g, b] = steps;
    const double bad = steps.bad_share();
    const double good = 1.0 - bad;
    const double share = good * g + bad * b;
    const double both = good * g * ((1.0 - p) * g + p * b) + bad * b * ((1.0 - r) * b + r * g);
    auto theory = theory_from_pairs(share, both);
    const double decay = 1.0 - p - r;
    theory.decay = decay;
    theory.variance_inflation = 1.0;
    if (share > 0.0 && share < 1.0 && decay < 1.0) {
        const double of_states = (b - g) * (b - g) * good * bad / (share * (1.0 - share));
        theory.variance_inflation += 2.0 * of_states * decay / (1.0 - decay);
    }
    return with_memory(theory);
}

/// Probability masses of the good and the bad state.
struct Masses {
    double good, bad;
};

Masses step(const Masses& masses, const TwoStateSteps& s)
{
    return {masses.good * (1.0 - s.good_to_bad) + masses.bad * s.bad_to_good,
            masses.good * s.good_to_bad + masses.bad * (1.0 - s.bad_to_good)};
}

Masses lost(const Masses& masses, const TwoStateSteps& s)
{
    return {masses.good * s.loss_good, masses.bad * s.loss_bad};
}
Masses passed(const Masses& masses, const TwoStateSteps& s)
{
    return {masses.good * (1.0 - s.loss_good), masses.bad * (1.0 - s.loss_bad)};
}

/// The second eigenvalue of the chain of the states in which runs begin, with the eigenvalue 1 of a
/// chain: the determinant of A (1 - A)^-1 B (1 - B)^-1, where A is "lost, then a step" and B is
/// "passes, then a step".
double memory_of_runs(const TwoStateSteps& s)
{
    const double decay = 1.0 - s.good_to_bad - s.bad_to_good;
    const auto one_minus = [&](double good, double bad) { // det(1 - diag(good, bad) P)
        return 1.0 - good * (1.0 - s.good_to_bad) - bad * (1.0 - s.bad_to_good) +
               good * bad * decay;
    };
    const double g = s.loss_good;
    const double b = s.loss_bad;
    return g * b * decay * (1.0 - g) * (1.0 - b) * decay /
           (one_minus(g, b) * one_minus(1.0 - g, 1.0 - b));
}

std::optional<RunLengths> runs_of_chain(const TwoStateSteps& s)
{
    const double bad = s.bad_share();
    const Masses first = step(passed({1.0 - bad, bad}, s), s);
    Masses run = lost(first, s);
    const double all = run.good + run.bad;
    if (!(all > 0.0)) return std::nullopt;
    RunLengths runs{.at_least = {}, .memory = memory_of_runs(s)};
    for (std::size_t i = 0; i < RunLengths::most; ++i) {
        runs.at_least.push_back((run.good + run.bad) / all);
        run = lost(step(run, s), s);
    }
    return runs;
}

void add_losses_in_states(std::vector<LossProperty>& properties, const TwoStateSteps& steps)
{
    properties.emplace_back(LossesInState{LossState::good, steps.loss_good});
    properties.emplace_back(LossesInState{LossState::bad, steps.loss_bad});
}

std::vector<LossProperty> properties_of_chain(const TwoStateSteps& steps)
{
    std::vector<LossProperty> properties{LongRunShare{theory_of_chain(steps)}};
    if (auto runs = runs_of_chain(steps)) properties.emplace_back(*std::move(runs));
    add_losses_in_states(properties, steps);
    properties.emplace_back(StateStep{LossState::good, LossState::bad, steps.good_to_bad});
    properties.emplace_back(StateStep{LossState::bad, LossState::good, steps.bad_to_good});
    return properties;
}

} // namespace

TwoStateSteps Gilbert::steps() const
{
    const double lost = share.fraction();
    return {.good_to_bad = lost / ((1.0 - lost) * mean_burst),
            .bad_to_good = 1.0 / mean_burst,
            .loss_good = 0.0,
            .loss_bad = 1.0};
}

base::Result<void> Gilbert::validate() const
{
    const double lost = share.fraction();
    if (lost >= 1.0) {
        return base::fail(
            "a share of 100% would be one endless burst: write less, or use the law random");
    }
    const double least = lost / (1.0 - lost);
    if (std::isfinite(mean_burst) && mean_burst >= 1.0 && mean_burst > least) return {};
    if (least < 1.0) return base::fail("mean_burst must be at least 1 datagram");
    return base::fail(
        fmt::format("mean_burst must be more than share / (1 - share) = {1:.4g} datagrams at a "
                    "share of {0}: the good runs between bursts would be shorter than one",
                    base::to_text(share), least));
}

LossTheory Gilbert::theory(const Arrivals& /*arrivals*/) const { return theory_of_chain(steps()); }

std::vector<LossProperty> Gilbert::properties(const RunFacts& /*facts*/) const
{
    return properties_of_chain(steps());
}

TwoStateSteps GilbertElliott::steps() const
{
    return {.good_to_bad = good_to_bad.fraction(),
            .bad_to_good = bad_to_good.fraction(),
            .loss_good = loss_good.fraction(),
            .loss_bad = loss_bad.fraction()};
}

base::Result<void> GilbertElliott::validate() const
{
    if (good_to_bad.fraction() > 0.0 || bad_to_good.fraction() > 0.0) return {};
    return base::fail("the state would never change: write good_to_bad or bad_to_good above 0%");
}

LossTheory GilbertElliott::theory(const Arrivals& /*arrivals*/) const
{
    return theory_of_chain(steps());
}

std::vector<LossProperty> GilbertElliott::properties(const RunFacts& /*facts*/) const
{
    return properties_of_chain(steps());
}

TwoStateSteps TimedGilbertElliott::steps(base::Duration after) const
{
    // The transition probabilities of a chain in continuous time.
    // Its rates are 1 / mean_good and 1 / mean_bad.
    const auto good = static_cast<double>(mean_good.count());
    const auto bad = static_cast<double>(mean_bad.count());
    const double bad_share = bad / (good + bad);
    const auto passed_by = static_cast<double>(after.count());
    const double forgotten = 1.0 - base::exp(-(passed_by / good + passed_by / bad));
    return {.good_to_bad = bad_share * forgotten,
            .bad_to_good = (1.0 - bad_share) * forgotten,
            .loss_good = loss_good.fraction(),
            .loss_bad = loss_bad.fraction()};
}

base::Result<void> TimedGilbertElliott::validate() const
{
    if (mean_good.count() > 0 && mean_bad.count() > 0) return {};
    return base::fail("mean_good and mean_bad must both be longer than 0");
}

LossTheory TimedGilbertElliott::theory(const Arrivals& arrivals) const
{
    return theory_of_chain(steps(arrivals.spacing));
}

std::vector<LossProperty> TimedGilbertElliott::properties(const RunFacts& facts) const
{
    if (facts.spacing) return properties_of_chain(steps(*facts.spacing));
    std::vector<LossProperty> properties{
        Untestable{"the law is in time, and the spacing of the datagrams is not known"}};
    // Any spacing can be used, because the losses in a state do not depend on the steps.
    add_losses_in_states(properties, steps(base::Duration{1}));
    return properties;
}

TwoStateChain::TwoStateChain(const TwoStateSteps& steps, const base::RandomStream& stream)
    : steps_{steps}, is_bad_{begins_bad(steps, stream)}
{}

bool TwoStateChain::on_packet(const Packet& packet, const base::RandomStream& stream)
{
    const double loss = is_bad_ ? steps_.loss_bad : steps_.loss_good;
    state_ = is_bad_ ? LossState::bad : LossState::good;
    is_bad_ = is_bad_after(is_bad_, steps_, stream.uniform(packet.number, stepping));
    return stream.uniform(packet.number, judging) < loss;
}

TimedGilbertElliott::Model::Model(const TimedGilbertElliott& law, const base::RandomStream& stream)
    : law_{law}, is_bad_{begins_bad(law.steps(law.mean_good), stream)}
{
    change(law, stream);
}

bool TimedGilbertElliott::Model::on_packet(const Packet& packet, const base::RandomStream& stream)
{
    const auto since_last = packet.at - last_.value_or(packet.at);
    last_ = packet.at;
    const auto steps = law_.steps(since_last);
    is_bad_ = is_bad_after(is_bad_, steps, stream.uniform(packet.number, stepping));
    return stream.uniform(packet.number, judging) < (is_bad_ ? steps.loss_bad : steps.loss_good);
}

void TimedGilbertElliott::Model::change(const TimedGilbertElliott& law,
                                        const base::RandomStream& /*stream*/)
{
    base::ensure(law.mean_good > base::Duration{0} && law.mean_bad > base::Duration{0});
    law_ = law;
}

} // namespace hapnet::emulator
