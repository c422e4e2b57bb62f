// SPDX-FileCopyrightText: 2026 The Hapnet authors
// SPDX-License-Identifier: MIT
#pragma once

#include "emulator/core/loss/judgement.hpp"
#include "emulator/core/loss/law.hpp"
#include "emulator/core/loss/steps.hpp"
#include "emulator/core/packet.hpp"
#include "proto/base/random.hpp"
#include "proto/base/time.hpp"

#include <optional>

namespace hapnet::emulator {

// Chains of states. Each begins in a state that is drawn from its stationary law, so that short
// runs lose their share on average as well (tc-netem begins in the good state). A change of the law
// keeps the state.

/// Gilbert and GilbertElliott.
class TwoStateJudge {
public:
    TwoStateJudge(const Gilbert& law, const base::RandomStream& stream);
    TwoStateJudge(const GilbertElliott& law, const base::RandomStream& stream);

    [[nodiscard]] LossJudgement on_packet(const Packet& packet, const base::RandomStream& stream);
    void change(const Gilbert& law, const base::RandomStream&) { steps_ = steps_of(law); }
    void change(const GilbertElliott& law, const base::RandomStream&) { steps_ = steps_of(law); }

private:
    TwoStateSteps steps_;
    bool is_bad_;
};

/// TimedGilbertElliott. The first datagram meets the stationary law, whenever it comes.
class TimedTwoStateJudge {
public:
    TimedTwoStateJudge(const TimedGilbertElliott& law, const base::RandomStream& stream);

    [[nodiscard]] LossJudgement on_packet(const Packet& packet, const base::RandomStream& stream);
    void change(const TimedGilbertElliott& law, const base::RandomStream&);

private:
    TimedGilbertElliott law_;
    bool is_bad_;
    std::optional<base::Duration> last_{}; // arrival
};

/// FourState.
class FourStateJudge {
public:
    FourStateJudge(const FourState& law, const base::RandomStream& stream);

    [[nodiscard]] LossJudgement on_packet(const Packet& packet, const base::RandomStream& stream);
    void change(const FourState& law, const base::RandomStream&) { steps_ = steps_of(law); }

private:
    [[nodiscard]] LossState step(double u) const;

    FourStateSteps steps_;
    LossState state_;
};

} // namespace hapnet::emulator
