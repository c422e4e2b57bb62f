// SPDX-FileCopyrightText: 2026 The Hapnet authors
// SPDX-License-Identifier: MIT
#include "emulator/core/loss/steps.hpp"
#include "emulator/core/loss/theory.hpp"

namespace hapnet::emulator {

namespace {

using MaybeRunLaw = std::optional<RunLaw>;

MaybeRunLaw geometric(double goes_on, std::size_t most)
{
    if (!(goes_on >= 0.0 && goes_on < 1.0)) return std::nullopt;
    RunLaw law;
    double at_least = 1.0;
    for (std::size_t i = 0; i < most; ++i) {
        law.at_least.push_back(at_least);
        at_least *= goes_on;
    }
    return law;
}

MaybeRunLaw run_law(const RandomLoss& law, base::Duration, std::size_t most)
{
    if (law.share.fraction() <= 0.0) return std::nullopt;
    return geometric(law.share.fraction(), most);
}

/// Masses of the good and the bad state.
struct States {
    double good, bad;
};

States step(const States& states, const TwoStateSteps& s)
{
    return {states.good * (1.0 - s.good_to_bad) + states.bad * s.bad_to_good,
            states.good * s.good_to_bad + states.bad * (1.0 - s.bad_to_good)};
}

/// What of the masses is lost, or passes.
States lost(const States& states, const TwoStateSteps& s)
{
    return {states.good * s.loss_good, states.bad * s.loss_bad};
}
States passed(const States& states, const TwoStateSteps& s)
{
    return {states.good * (1.0 - s.loss_good), states.bad * (1.0 - s.loss_bad)};
}

/// The second eigenvalue of the chain of the states in which runs begin, with the eigenvalue 1 of a
/// chain: the determinant of A (1 - A)^-1 B (1 - B)^-1, where A is "lost, then a step" and B is
/// "passes, then a step".
double memory_of(const TwoStateSteps& s)
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

MaybeRunLaw run_law(const TwoStateSteps& s, std::size_t most)
{
    const double bad = s.bad_share();
    const States beginning = step(passed({1.0 - bad, bad}, s), s);
    States run = lost(beginning, s);
    const double all = run.good + run.bad;
    if (!(all > 0.0)) return std::nullopt;
    RunLaw law{.at_least = {}, .memory = memory_of(s)};
    for (std::size_t i = 0; i < most; ++i) {
        law.at_least.push_back((run.good + run.bad) / all);
        run = lost(step(run, s), s);
    }
    return law;
}

MaybeRunLaw run_law(const Gilbert& law, base::Duration, std::size_t most)
{
    return run_law(steps_of(law), most);
}
MaybeRunLaw run_law(const GilbertElliott& law, base::Duration, std::size_t most)
{
    return run_law(steps_of(law), most);
}
MaybeRunLaw run_law(const TimedGilbertElliott& law, base::Duration spacing, std::size_t most)
{
    return run_law(steps_of(law, spacing), most);
}

MaybeRunLaw run_law(const FourState& law, base::Duration, std::size_t most)
{
    // An isolated loss is a run of one; a run in a burst is geometric.
    const auto steps = steps_of(law);
    const auto shares = steps.shares();
    const double stays = 1.0 - steps.burst_to_gap - steps.burst_to_good_run;
    const double in_burst = shares.lost_in_burst * (1.0 - stays); // runs per datagram
    const double isolated_part = shares.lost_in_gap / (shares.lost_in_gap + in_burst);
    auto result = geometric(stays < 0.0 ? 0.0 : stays, most);
    if (!result) return std::nullopt;
    for (std::size_t i = 1; i < most; ++i) result->at_least[i] *= 1.0 - isolated_part;
    return result;
}

/// The other laws.
template <typename Law>
MaybeRunLaw run_law(const Law&, base::Duration, std::size_t)
{
    return std::nullopt;
}

} // namespace

std::optional<RunLaw> run_law_of(const LossLaw& law, base::Duration spacing, std::size_t most)
{
    return std::visit([&](const auto& one) { return run_law(one, spacing, most); }, law);
}

} // namespace hapnet::emulator
