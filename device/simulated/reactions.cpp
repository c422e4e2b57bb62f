// SPDX-FileCopyrightText: 2026 The Hapnet authors
// SPDX-License-Identifier: MIT
#include "device/simulated/reactions.hpp"

#include "proto/base/math.hpp"

#include <algorithm>

namespace hapnet::device {

Reaction Reactions::to(const Perception& felt, base::TimePoint now, base::Duration elapsed)
{
    Reaction reaction;
    const Reflex& reflex = person_.reflex;
    if (reflex.gain > 0.0) {
        stretched_.put(now, felt.deviation);
        const double stiffness = reflex.gain * person_.hand.stiffness_n_per_m;
        reaction.force = -stiffness * stretched_.at(now - reflex.delay);
    }
    if (person_.intent.gain_m_per_ns > 0.0) reaction.farther_m = farther(felt, now, elapsed);
    if (person_.search.speed_m_per_s > 0.0) reaction.farther_m += ahead(felt, now, elapsed);
    return reaction;
}

double Reactions::ahead(const Perception& felt, base::TimePoint now, base::Duration elapsed)
{
    constexpr double touch_n = 0.05; // a smaller force is no touch
    const Search& search = person_.search;
    const double step = search.speed_m_per_s * base::to_seconds(elapsed);
    const double advanced = felt.aim_m && aim_m_ ? *felt.aim_m - *aim_m_ : 0.0;
    aim_m_ = felt.aim_m;
    const bool is_lost = felt.aim_m && felt.pressing_n < touch_n;
    if (!is_lost) {
        untouched_since_.reset();
        const double back = felt.aim_m ? std::max(advanced, 0.0) : step;
        ahead_m_ = std::max(ahead_m_ - back, 0.0);
        return ahead_m_;
    }
    if (!untouched_since_) untouched_since_ = now;
    if (now - *untouched_since_ >= search.after)
        ahead_m_ = std::min(ahead_m_ + step, search.reach_m);
    return ahead_m_;
}

double Reactions::farther(const Perception& felt, base::TimePoint now, base::Duration elapsed)
{
    constexpr double farther_max_m = 0.020;
    const Intent& intent = person_.intent;
    const double seconds = base::to_seconds(elapsed);
    if (elapsed != smoothed_over_) {
        smoothed_over_ = elapsed;
        smoothing_keeps_ = base::exp(-base::two_pi * intent.cutoff_hertz * seconds);
    }
    const double missing = felt.wanted_n ? *felt.wanted_n - felt.pressing_n : 0.0;
    missed_.put(now, {missing, 0.0, 0.0});
    const double known = missed_.at(now - intent.delay).x;
    missing_n_ = known + smoothing_keeps_ * (missing_n_ - known);
    if (felt.wanted_n) {
        const double moved = farther_m_ + intent.gain_m_per_ns * seconds * missing_n_;
        farther_m_ = std::clamp(moved, -farther_max_m, farther_max_m);
    } else {
        farther_m_ *= smoothing_keeps_; // back to the script's target
    }
    return farther_m_;
}

} // namespace hapnet::device
