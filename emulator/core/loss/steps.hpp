// SPDX-FileCopyrightText: 2026 The Hapnet authors
// SPDX-License-Identifier: MIT
#pragma once

#include "emulator/core/loss/law.hpp"

namespace hapnet::emulator {

/// The probabilities of a chain of two states, per datagram. Judged before the step.
struct TwoStateSteps {
    double good_to_bad = 0.0;
    double bad_to_good = 0.0;
    double loss_good = 0.0;
    double loss_bad = 0.0;

    /// The share of datagrams that meet the bad state. A chain that never moves is good.
    [[nodiscard]] double bad_share() const
    {
        const double moves = good_to_bad + bad_to_good;
        return moves > 0.0 ? good_to_bad / moves : 0.0;
    }
};

/// bad_to_good = 1 / L and good_to_bad = P / ((1 - P) L), for a share P and a mean burst L.
[[nodiscard]] TwoStateSteps steps_of(const Gilbert& law);
[[nodiscard]] TwoStateSteps steps_of(const GilbertElliott& law);

/// Those of the timed chain when the next datagram comes `after` so long; sampling it like this is
/// exact, whatever it did in between.
[[nodiscard]] TwoStateSteps steps_of(const TimedGilbertElliott& law, base::Duration after);

/// The five free probabilities of the four-state chain, per datagram, and the shares of datagrams
/// that meet each state. Judged after the step; lost_in_gap always goes to received_in_gap.
struct FourStateSteps {
    double gap_to_burst = 0.0;      // p13: received_in_gap to lost_in_burst
    double gap_to_isolated = 0.0;   // p14: received_in_gap to lost_in_gap
    double burst_to_gap = 0.0;      // p31: lost_in_burst to received_in_gap
    double burst_to_good_run = 0.0; // p32: lost_in_burst to received_in_burst
    double good_run_to_burst = 0.0; // p23: received_in_burst to lost_in_burst

    struct Shares {
        double received_in_gap, received_in_burst, lost_in_burst, lost_in_gap;
    };
    [[nodiscard]] Shares shares() const;
};

/// The inverse of the model's closed forms: p14 = P_I / (1 - P_I), p23 = 1 / E_GB,
/// p32 = p23 (1 - rho) / rho, p31 = 1 / (rho E_B), p13 = (P_L - P_I) / (E_B (1 - P_I) (rho - P_L)).
[[nodiscard]] FourStateSteps steps_of(const FourState& law);

} // namespace hapnet::emulator
