// SPDX-FileCopyrightText: 2026 The Hapnet authors
// SPDX-License-Identifier: MIT
#pragma once

#include "emulator/core/loss/theory.hpp"
#include "emulator/core/packet.hpp"
#include "proto/base/probability.hpp"
#include "proto/base/random.hpp"
#include "proto/base/result.hpp"

namespace hapnet::emulator {

/// The five free probabilities of the four-state chain, per datagram. A datagram is judged after
/// the step. lost_in_gap always goes to received_in_gap.
struct FourStateSteps {
    double gap_to_burst = 0.0;      // p13: received_in_gap to lost_in_burst
    double gap_to_isolated = 0.0;   // p14: received_in_gap to lost_in_gap
    double burst_to_gap = 0.0;      // p31: lost_in_burst to received_in_gap
    double burst_to_good_run = 0.0; // p32: lost_in_burst to received_in_burst
    double good_run_to_burst = 0.0; // p23: received_in_burst to lost_in_burst

    /// The shares of datagrams that are judged in each state.
    struct Shares {
        double received_in_gap, received_in_burst, lost_in_burst, lost_in_gap;
    };
    [[nodiscard]] Shares shares() const;
};

/// The four-state Markov model in its intuitive form (Salsano, Ludovici, Ordine, Giannuzzi,
/// "Definition of a general and intuitive loss model for packet networks", 2012). Its parameters
/// are the total share of losses, the mean length of bursts in datagrams, the share of losses
/// `density` within them, the mean length `good_run` (>= 1) of the runs of received datagrams
/// within bursts, and the share of isolated losses outside of bursts. isolated < share < density.
struct FourState {
    base::Probability share{};
    double burst = 1.0;
    base::Probability density{};
    base::Probability isolated{};
    double good_run = 2.0;

    static constexpr DropCause cause = DropCause::four_state;
    static constexpr bool is_in_time = false;
    class Model;

    /// The inverse of the model's closed forms: p14 = P_I / (1 - P_I), p23 = 1 / E_GB,
    /// p32 = p23 (1 - rho) / rho, p31 = 1 / (rho E_B),
    /// p13 = (P_L - P_I) / (E_B (1 - P_I) (rho - P_L)).
    [[nodiscard]] FourStateSteps steps() const;

    [[nodiscard]] base::Result<void> validate() const;
    [[nodiscard]] LossTheory theory(const Arrivals&) const;
    [[nodiscard]] std::vector<LossProperty> properties(const RunFacts&) const;

    friend bool operator==(const FourState&, const FourState&) = default;
};

constexpr auto fields_of(base::Tag<FourState>)
{
    return base::fields(
        "four-state", base::field("share", &FourState::share, "share that is lost").required(),
        base::field("burst", &FourState::burst, "mean length of a burst, in datagrams").required(),
        base::field("density", &FourState::density, "share lost within a burst").required(),
        base::field("isolated", &FourState::isolated, "share lost outside of bursts").required(),
        base::field("good_run", &FourState::good_run,
                    "mean run of arrivals within a burst, in datagrams"));
}

/// The first state is drawn from the stationary law. A change of the parameters keeps the state.
class FourState::Model {
public:
    Model(const FourState& law, const base::RandomStream& stream);

    [[nodiscard]] bool on_packet(const Packet& packet, const base::RandomStream& stream);
    void change(const FourState& law, const base::RandomStream&) { steps_ = law.steps(); }
    [[nodiscard]] LossState state() const { return state_; }

private:
    [[nodiscard]] LossState step(double u) const;

    FourStateSteps steps_;
    LossState state_;
};

} // namespace hapnet::emulator
