// SPDX-FileCopyrightText: 2026 The Hapnet authors
// SPDX-License-Identifier: MIT
#pragma once

#include <array>
#include <cmath>
#include <cstddef>

namespace hapnet::scene {

/// What one or two alike springs do that press a body throughout a tick, for any depth and speed.
/// The depths d are d'' = a - G f with the forces f = stiffness d + damping d' and the matrix G of
/// how they respond, 1/kg. G's two modes are oscillators of their own; of each the tick needs three
/// integrals, which are Taylor's series to rounding. They follow from the key alone: find() keeps
/// them for the next tick, and with or without that the bits are the same.
class PressedModes {
public:
    /// Everything that they depend on.
    struct Key {
        std::array<double, 2> own{}; // how a depth responds to its own force; 0: no second spring
        double mutual = 0.0;         // ... and to the other's
        double stiffness = 0.0;
        double damping = 0.0;
        double tick = 0.0;

        friend bool operator==(const Key&, const Key&) = default;
    };
    /// One number of each mode.
    using Each = std::array<double, 2>;

    /// False when the tick is long for the springs.
    [[nodiscard]] bool find(const Key& key)
    {
        if (!(key == key_)) renew(key);
        return is_short_;
    }

    /// The same vector seen from the springs and from the modes.
    [[nodiscard]] Each to_modes(const Each& springs) const
    {
        return {cosine_ * springs[0] - sine_ * springs[1],
                sine_ * springs[0] + cosine_ * springs[1]};
    }
    [[nodiscard]] Each to_springs(const Each& modes) const
    {
        return {cosine_ * modes[0] + sine_ * modes[1], cosine_ * modes[1] - sine_ * modes[0]};
    }

    /// Depth, speed and acceleration at the start.
    struct Start {
        Each depth, speed, acceleration;
    };
    /// Over the tick: the forces' impulses, N s, their integrals, N s^2, and the most by which the
    /// forces can leave what they are at the start, N.
    struct Outcome {
        Each impulse, moment, change;
    };
    /// Of the springs; a second one that is not there has zeros.
    [[nodiscard]] Outcome outcome(const Start& start) const
    {
        const Each depth = to_modes(start.depth);
        const Each speed = to_modes(start.speed);
        const Each acceleration = to_modes(start.acceleration);
        Each impulse, moment, change;
        for (std::size_t j = 0; j < 2; ++j) {
            const Mode& mode = modes_[j];
            // A depth that stays presses evenly; what it does not hold in balance accelerates.
            const double force = key_.stiffness * depth[j];
            const double left = acceleration[j] - mode.response * force;
            impulse[j] = key_.tick * force + mode.once * speed[j] + mode.twice * left;
            moment[j] = half_square_ * force + mode.twice * speed[j] + mode.thrice * left;
            change[j] = mode.change_by_speed * std::abs(speed[j]) + mode.change_by_left * std::abs(left);
        }
        const double c = std::abs(cosine_), s = std::abs(sine_);
        return {to_springs(impulse), to_springs(moment),
                {c * change[0] + s * change[1], s * change[0] + c * change[1]}};
    }

private:
    /// An oscillator that begins at zero: of its force when it begins with speed 1.
    struct Mode {
        double response = 0.0; // 1/kg
        double once = 0.0, twice = 0.0, thrice = 0.0; // the integral, the integral of that, ...
        double change_by_speed = 0.0;
        double change_by_left = 0.0; // of the force's integral
    };

    void renew(const Key& key);
    [[nodiscard]] bool set(Mode& mode, double response) const;

    Key key_{.tick = -1.0}; // of no tick
    bool is_short_ = false;
    double cosine_ = 1.0, sine_ = 0.0;
    double half_square_ = 0.0;
    std::array<Mode, 2> modes_;
};

} // namespace hapnet::scene
