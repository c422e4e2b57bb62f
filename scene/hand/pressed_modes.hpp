// SPDX-FileCopyrightText: 2026 The Hapnet authors
// SPDX-License-Identifier: MIT
#pragma once

#include "scene/maths/lanes.hpp"

namespace hapnet::scene {

/// The motion of one or two equal springs that press a body throughout a tick, for any depth and
/// speed. The depths obey d'' = a - G f with the forces f = stiffness d + damping d' and the matrix
/// G of the depths' response to them, 1/kg. Each of G's two modes is an oscillator. The tick needs
/// three integrals of each, which are Taylor's series to rounding. The integrals follow from the
/// key alone, so find() keeps them for the next tick without changing a bit.
class PressedModes {
public:
    /// All values that the modes depend on.
    struct Key {
        Two own{};           // response of a depth to its own force; 0: no second spring
        double mutual = 0.0; // response of a depth to the other spring's force
        double stiffness = 0.0;
        double damping = 0.0;
        double tick = 0.0;

        friend bool operator==(const Key& a, const Key& b)
        {
            return a.own[0] == b.own[0] && a.own[1] == b.own[1] && a.mutual == b.mutual &&
                   a.stiffness == b.stiffness && a.damping == b.damping && a.tick == b.tick;
        }
    };

    /// Finds the modes of a key. Returns false when the tick is too long for such stiff springs.
    [[nodiscard]] bool find(const Key& key)
    {
        if (!(key == key_)) renew(key);
        return is_short_;
    }

    /// The depths, their speeds and their accelerations at the start.
    struct Start {
        Two depth, speed, acceleration;
    };
    /// The forces' impulses over the tick, N s, the integrals of the impulses, N s^2, and bounds of
    /// how far the forces can depart from their values at the start, N.
    struct Outcome {
        Two impulse, moment, change;
    };
    /// Returns the outcome for each spring. A second spring that does not exist has zeros.
    [[nodiscard]] Outcome outcome(const Start& start) const
    {
        const Two depth = to_modes(start.depth);
        const Two speed = to_modes(start.speed);
        // A constant depth presses evenly. The part of `a` that this force does not balance
        // accelerates the depth.
        const Two force = both(key_.stiffness) * depth;
        const Two left = to_modes(start.acceleration) - response_ * force;
        const Two change = change_by_speed_ * sizes(speed) + change_by_left_ * sizes(left);
        return {to_springs(both(key_.tick) * force + once_ * speed + twice_ * left),
                to_springs(both(half_square_) * force + twice_ * speed + thrice_ * left),
                sizes(both(cosine_)) * change + sizes(sine_) * swapped(change)};
    }

private:
    /// An oscillator that begins at zero with speed 1: the integral of its force, the integral of
    /// that integral, and so on; then bounds of the change of its force and of the change of the
    /// force's integral.
    struct Mode {
        double once = 0.0, twice = 0.0, thrice = 0.0;
        double change_by_speed = 0.0, change_by_left = 0.0;
    };

    // Convert a vector between the frame of the modes and that of the springs.
    [[nodiscard]] Two to_modes(Two springs) const
    {
        return both(cosine_) * springs - sine_ * swapped(springs);
    }
    [[nodiscard]] Two to_springs(Two modes) const
    {
        return both(cosine_) * modes + sine_ * swapped(modes);
    }
    void renew(const Key& key);
    [[nodiscard]] bool set(Mode& mode, double response) const;

    Key key_{.tick = -1.0}; // the key of no tick
    bool is_short_ = false;
    double cosine_ = 1.0;
    Two sine_{}; // the sine and its negative
    double half_square_ = 0.0;
    Two response_{}; // 1/kg
    Two once_{}, twice_{}, thrice_{};
    Two change_by_speed_{}, change_by_left_{};
};

} // namespace hapnet::scene
