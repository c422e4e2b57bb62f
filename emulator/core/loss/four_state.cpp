// SPDX-FileCopyrightText: 2026 The Hapnet authors
// SPDX-License-Identifier: MIT
#include "emulator/core/loss/four_state.hpp"

#include "proto/base/text.hpp"

#include <cmath>
#include <optional>
#include <spdlog/fmt/fmt.h>

namespace hapnet::emulator {

namespace {

// The index of the draws for one datagram.
constexpr std::uint32_t four_state_step = 1;
constexpr std::uint32_t four_state_start = 2;

/// Returns the value rounded up in its last decimal, so that the result can be copied from the
/// message.
std::string at_least(double value)
{
    constexpr double thousand = 1000.0;
    return fmt::format("{}", std::ceil(value * thousand) / thousand);
}

/// Refuses shares and lengths that are impossible, each by itself or together.
base::Result<void> validate_ranges(const FourState& law)
{
    if (!(law.isolated < law.share && law.share < law.density)) {
        return base::fail(fmt::format(
            "isolated ({}) < share ({}) < density ({}) must hold: bursts lose more "
            "than the whole does, and the gaps between them less",
            base::to_text(law.isolated), base::to_text(law.share), base::to_text(law.density)));
    }
    if (!(std::isfinite(law.burst) && law.burst >= 1.0)) {
        return base::fail("burst must be at least 1 datagram");
    }
    if (!(std::isfinite(law.good_run) && law.good_run >= 1.0)) {
        return base::fail("good_run must be at least 1 datagram");
    }
    if (law.isolated.fraction() >= 0.5) {
        return base::fail("a datagram passes after each isolated loss: write less than 50% for "
                          "isolated");
    }
    return {};
}

/// Computes the variance by renewal: the chain begins again whenever it comes to received_in_gap.
/// Over one cycle of T datagrams with R losses, the variance per datagram is E[(R - share T)^2] /
/// E[T].
double cycle_variance(const FourStateSteps& s, double share)
{
    const auto square = [](double x) { return x * x; };
    // A burst: its first loss, and then a geometric number of further losses, each of them perhaps
    // after a good run.
    const double more = (1.0 - s.burst_to_gap) / s.burst_to_gap;
    const double more_variance = more / s.burst_to_gap;
    const double with_good_run =
        s.burst_to_gap < 1.0 ? s.burst_to_good_run / (1.0 - s.burst_to_gap) : 0.0;
    const double good = with_good_run / s.good_run_to_burst;
    const double good_variance =
        with_good_run * (2.0 - s.good_run_to_burst) / square(s.good_run_to_burst) - square(good);
    const double each = (1.0 - share) - share * good;
    const double burst_mean = (1.0 - 2.0 * share) + more * each;
    const double burst_variance =
        more * square(share) * good_variance + more_variance * square(each);
    return (1.0 - s.gap_to_burst - s.gap_to_isolated) * square(share) +
           s.gap_to_isolated * square(1.0 - 2.0 * share) +
           s.gap_to_burst * (square(burst_mean) + burst_variance);
}

/// Returns the lengths of runs. An isolated loss is a run of one. A run in a burst is geometric.
std::optional<RunLengths> runs_of(const FourStateSteps& steps)
{
    const auto shares = steps.shares();
    const double stays = 1.0 - steps.burst_to_gap - steps.burst_to_good_run;
    const double in_burst = shares.lost_in_burst * (1.0 - stays); // runs per datagram
    const double isolated_part = shares.lost_in_gap / (shares.lost_in_gap + in_burst);
    auto runs = geometric_runs(stays < 0.0 ? 0.0 : stays);
    if (!runs) return std::nullopt;
    for (std::size_t i = 1; i < runs->at_least.size(); ++i)
        runs->at_least[i] *= 1.0 - isolated_part;
    return runs;
}

LossState first_state(const FourStateSteps& steps, double u)
{
    const auto shares = steps.shares();
    if (u < shares.received_in_gap) return LossState::received_in_gap;
    u -= shares.received_in_gap;
    if (u < shares.lost_in_burst) return LossState::lost_in_burst;
    u -= shares.lost_in_burst;
    return u < shares.received_in_burst ? LossState::received_in_burst : LossState::lost_in_gap;
}

} // namespace

FourStateSteps FourState::steps() const
{
    const double lost = share.fraction();
    const double rho = density.fraction();
    const double alone = isolated.fraction();
    const double good_run_to_burst = 1.0 / good_run;
    return {.gap_to_burst = (lost - alone) / (burst * (1.0 - alone) * (rho - lost)),
            .gap_to_isolated = alone / (1.0 - alone),
            .burst_to_gap = 1.0 / (rho * burst),
            .burst_to_good_run = good_run_to_burst * (1.0 - rho) / rho,
            .good_run_to_burst = good_run_to_burst};
}

FourStateSteps::Shares FourStateSteps::shares() const
{
    const double lost_per_gap = gap_to_burst / burst_to_gap;
    const double good_per_gap = lost_per_gap * burst_to_good_run / good_run_to_burst;
    const double gap = 1.0 / (1.0 + lost_per_gap + good_per_gap + gap_to_isolated);
    return {.received_in_gap = gap,
            .received_in_burst = gap * good_per_gap,
            .lost_in_burst = gap * lost_per_gap,
            .lost_in_gap = gap * gap_to_isolated};
}

base::Result<void> FourState::validate() const
{
    if (auto ranges = validate_ranges(*this); !ranges) return ranges;
    const auto chain = steps();
    const double rho = density.fraction();
    constexpr double rounding = 1e-12;
    if (chain.burst_to_gap + chain.burst_to_good_run > 1.0 + rounding) {
        const double thinnest = (1.0 - rho) / good_run;
        if (thinnest >= rho) {
            return base::fail(fmt::format("good runs of mean length {} are too short for a density "
                                          "of {}: write more than {} for good_run",
                                          good_run, base::to_text(density),
                                          at_least((1.0 - rho) / rho)));
        }
        return base::fail(
            fmt::format("burst must be at least {} for a density of {} with good runs "
                        "of {}",
                        at_least(1.0 / (rho - thinnest)), base::to_text(density), good_run));
    }
    if (chain.gap_to_burst + chain.gap_to_isolated > 1.0 + rounding) {
        const double lost = share.fraction();
        const double alone = isolated.fraction();
        return base::fail(fmt::format(
            "bursts of {} are too short for a share of {}, as each is followed by a gap: write at "
            "least {}, or a higher density",
            burst, base::to_text(share),
            at_least((lost - alone) / ((rho - lost) * (1.0 - 2.0 * alone)))));
    }
    return {};
}

LossTheory FourState::theory(const Arrivals& /*arrivals*/) const
{
    const auto chain = steps();
    const auto shares = chain.shares();
    const double lost = shares.lost_in_burst + shares.lost_in_gap;
    const double stays = 1.0 - chain.burst_to_gap - chain.burst_to_good_run;
    auto theory = theory_from_pairs(lost, shares.lost_in_burst * stays);
    theory.variance_inflation =
        cycle_variance(chain, lost) * shares.received_in_gap / (lost * (1.0 - lost));
    return with_memory(theory);
}

std::vector<LossProperty> FourState::properties(const RunFacts& /*facts*/) const
{
    std::vector<LossProperty> properties{LongRunShare{theory({})}};
    const auto chain = steps();
    if (auto runs = runs_of(chain)) properties.emplace_back(*std::move(runs));
    for (const StateStep& step :
         {StateStep{LossState::received_in_gap, LossState::lost_in_burst, chain.gap_to_burst},
          StateStep{LossState::received_in_gap, LossState::lost_in_gap, chain.gap_to_isolated},
          StateStep{LossState::lost_in_burst, LossState::received_in_gap, chain.burst_to_gap},
          StateStep{LossState::lost_in_burst, LossState::received_in_burst,
                    chain.burst_to_good_run},
          StateStep{LossState::received_in_burst, LossState::lost_in_burst,
                    chain.good_run_to_burst},
          StateStep{LossState::lost_in_gap, LossState::received_in_gap, 1.0}}) {
        properties.emplace_back(step);
    }
    return properties;
}

FourState::Model::Model(const FourState& law, const base::RandomStream& stream)
    : steps_{law.steps()}, state_{first_state(steps_, stream.uniform(0, four_state_start))}
{}

bool FourState::Model::on_packet(const Packet& packet, const base::RandomStream& stream)
{
    state_ = step(stream.uniform(packet.number, four_state_step));
    return state_ == LossState::lost_in_burst || state_ == LossState::lost_in_gap;
}

LossState FourState::Model::step(double u) const
{
    switch (state_) {
    case LossState::received_in_burst:
        return u < steps_.good_run_to_burst ? LossState::lost_in_burst : state_;
    case LossState::lost_in_burst:
        if (u < steps_.burst_to_gap) return LossState::received_in_gap;
        u -= steps_.burst_to_gap;
        return u < steps_.burst_to_good_run ? LossState::received_in_burst : state_;
    case LossState::lost_in_gap: return LossState::received_in_gap;
    default:
        if (u < steps_.gap_to_burst) return LossState::lost_in_burst;
        u -= steps_.gap_to_burst;
        return u < steps_.gap_to_isolated ? LossState::lost_in_gap : LossState::received_in_gap;
    }
}

} // namespace hapnet::emulator
