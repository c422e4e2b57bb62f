// SPDX-FileCopyrightText: 2026 The Hapnet authors
// SPDX-License-Identifier: MIT
#pragma once

#include "scene/description.hpp"
#include "scene/maths/vector.hpp"

#include <algorithm>
#include <cstdint>

namespace hapnet::scene {

/// What the spring and damper between a hand and a face do. The force is
/// clamp(stiffness depth + damping closing speed, 0, force_max) while they overlap, else 0.
enum class SpringPhase : std::uint8_t {
    apart,    // no overlap
    slack,    // they overlap, but it would have to pull
    pressing, // between nothing and the greatest force
    limited,  // the greatest force
};

/// A hand's spring on one face of the box, along one axis.
struct FaceSpring {
    std::uint32_t hand;
    std::size_t axis;
    double sign;    // of the normal, from the box to the hand
    double depth;   // at the start of the stretch of time that is looked at
    double closing; // the hand's share of the closing speed
    SpringPhase phase;
    double impulse; // so far in the tick, N s, >= 0

    /// `speed` is the box's along the axis.
    [[nodiscard]] double closing_at(double speed) const { return closing + sign * speed; }
    [[nodiscard]] double tension(const HandDescription& hands, double speed) const
    {
        return hands.stiffness_n_per_m * depth + hands.damping_ns_per_m * closing_at(speed);
    }
    /// Takes the phase that belongs to the present state; returns the force.
    double update_phase(const HandDescription& hands, double speed)
    {
        phase = SpringPhase::apart;
        if (depth <= 0.0) return 0.0;
        const double wanted = tension(hands, speed);
        if (wanted >= hands.force_max_n) {
            phase = SpringPhase::limited;
            return hands.force_max_n;
        }
        phase = wanted > 0.0 ? SpringPhase::pressing : SpringPhase::slack;
        return std::max(wanted, 0.0);
    }
};

/// A hand that holds the box: a spring and a damper in all directions, which also pull.
struct GripSpring {
    std::uint32_t hand;
    PerAxis stretch; // from where it is held to the hand, at the start of the stretch of time
    PerAxis velocity;
    PerAxis impulse; // on the box, so far in the tick
};

/// A hand at an edge or a corner: its force is the midpoint rule's, held for the tick.
struct EdgeSpring {
    std::uint32_t hand;
    PerAxis normal; // unit, from the box to the hand
    double depth;   // along it, at the start of the tick
    double closing; // the hand's share of the closing speed
    double force;   // on the hand along the normal
};

/// The impulse of the force of a hand on something that stands still, over `time`: exact, since
/// the depth is linear. N s.
[[nodiscard]] double impulse_at_constant_velocity(const HandDescription& hands, double depth,
                                                  double closing, double time);

} // namespace hapnet::scene
