// SPDX-FileCopyrightText: 2026 The Hapnet authors
// SPDX-License-Identifier: MIT
#include "device/simulated/reactions.hpp"

#include "proto/base/math.hpp"

namespace hapnet::device {

Reaction Reactions::to(const Felt& felt, base::TimePoint now, base::Duration elapsed)
{
    Reaction reaction;
    const Reflex& reflex = person_.reflex;
    if (reflex.gain > 0.0) {
        stretched_.put(now, felt.deviation);
        const double stiffness = reflex.gain * person_.hand.stiffness_n_per_m;
        reaction.force = -stiffness * stretched_.at(now - reflex.delay);
    }
    const Will& will = person_.will;
    if (will.gain_m_per_n > 0.0) {
        const double missing = felt.wanted_n ? *felt.wanted_n - felt.pressing_n : 0.0;
        missed_.put(now, {missing, 0.0, 0.0});
        const double aim = will.gain_m_per_n * missed_.at(now - will.delay).x;
        const double kept =
            base::exp(-base::two_pi * will.cutoff_hertz * base::to_seconds(elapsed));
        smoothed_m_ = kept * smoothed_m_ + (1.0 - kept) * aim;
        reaction.farther_m = smoothed_m_;
    }
    return reaction;
}

} // namespace hapnet::device
