// SPDX-FileCopyrightText: 2026 The Hapnet authors
// SPDX-License-Identifier: MIT
#pragma once

#include "scene/hand/spring.hpp"
#include "scene/maths/first_root.hpp"
#include "scene/maths/vector.hpp"
#include "scene/one_box/obstacles.hpp"

#include <array>
#include <limits>
#include <span>

namespace hapnet::scene {

/// The possible oscillators of an axis: with any number of springs, with or without drag.
class AxisOscillators {
public:
    AxisOscillators(const HandDescription& hands, const BodyProperties& body, double tick);

    [[nodiscard]] double inverse_mass() const { return inverse_mass_; }
    /// True if a spring hardly changes the box's velocity in a tick.
    [[nodiscard]] bool are_soft() const { return soft_; }
    /// The oscillator of one spring alone.
    [[nodiscard]] const Oscillator& spring() const { return propagators_[0][1].oscillator; }

    [[nodiscard]] const Propagator& of(std::size_t springs, bool with_drag) const
    {
        return propagators_[with_drag ? 1 : 0][springs];
    }

private:
    double inverse_mass_;
    bool soft_;
    std::array<std::array<Propagator, hands_max + 1>, 2> propagators_;
};

/// The motion of one axis of the box.
struct AxisMotion {
    double applied_acceleration; // by the forces that are constant over the tick
    bool is_locked;
    bool is_stopped;        // the axis does not move in this tick: it is locked
    bool is_losing_support; // the box has just stopped pressing on its support

    const Obstacle* below; // the obstacle at whose high face the box is
    const Obstacle* above;
    const Obstacle* support; // `below` or `above`, if the box presses on it
    double load;             // m/s^2: press on the support, per mass; >= 0; only with a support
    double load_ramp;        // m/s^3: rate at which `load` grows

    double acceleration; // at the start of the interval
    Bounds bounds;       // for the rest of the tick
    double reach;        // how far the box can go along the axis in the rest of the tick

    /// True if something other than dry friction keeps the box where it is along the axis.
    [[nodiscard]] bool is_held() const { return is_stopped || support; }
    /// True if a plane slows the box by its drag. A box that is locked onto a plane cannot be
    /// lifted off the plane, whatever pulls it.
    [[nodiscard]] bool is_dragged() const
    {
        if (!is_locked) return support && support->is_plane;
        return (below && below->is_plane) || (above && above->is_plane);
    }
};

/// Dry friction on what supports the box.
struct DryFriction {
    enum class State : std::uint8_t { none, stuck, sliding };
    State state = State::none;
    bool starts_slipping = false; // the box has just begun to slide
    PerAxis direction{};          // direction of the sliding
    double limit = 0.0;           // the greatest friction, per mass
    double limit_ramp = 0.0;
};

/// A hand's spring on the box: along one axis at a face, along any direction at an edge or a
/// corner. The direction holds for the tick.
struct Spring {
    std::uint32_t hand;
    double depth;   // at the start of the interval
    double closing; // the hand's share of the closing speed
    SpringPhase phase;
    double impulse; // so far in the tick, N s, >= 0

    /// Returns the force without its limits. `speed` is the box's along the normal.
    [[nodiscard]] double tension(const HandDescription& hands, double speed) const
    {
        return hands.stiffness_n_per_m * depth + hands.damping_ns_per_m * (closing + speed);
    }
    /// Sets the phase that belongs to the present state. Returns the force.
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

struct FaceSpring : Spring {
    std::size_t axis;
    double sign; // sign of the normal along `axis`, from the box to the hand

    /// Returns a vector's part along the normal.
    [[nodiscard]] double along(const PerAxis& v) const { return sign * v[axis]; }
    void add_along(PerAxis& v, double size) const { v[axis] += size * sign; }
    /// Returns the part along the normal of a vector whose components `component` returns.
    template <typename Component>
    [[nodiscard]] double along_each(const Component& component) const
    {
        return sign * component(axis);
    }
    /// Returns the greatest possible part along the normal of a vector whose components have these
    /// sizes.
    template <typename Size>
    [[nodiscard]] double most_along(const Size& size) const
    {
        return size(axis);
    }
};

struct SlantedSpring : Spring {
    PerAxis normal; // unit, from the box to the hand

    [[nodiscard]] double along(const PerAxis& v) const { return dot(normal, v); }
    void add_along(PerAxis& v, double size) const
    {
        for (std::size_t i = 0; i < 3; ++i) v[i] += size * normal[i];
    }
    template <typename Component>
    [[nodiscard]] double along_each(const Component& component) const
    {
        return normal[0] * component(0) + normal[1] * component(1) + normal[2] * component(2);
    }
    template <typename Size>
    [[nodiscard]] double most_along(const Size& size) const
    {
        return std::abs(normal[0]) * size(0) + std::abs(normal[1]) * size(1) +
               std::abs(normal[2]) * size(2);
    }
};

/// A soft spring at an edge or a corner. Its force follows the midpoint rule and is held for the
/// tick. That costs less than the closed form and is as accurate while the spring is soft.
struct HeldSpring {
    std::uint32_t hand;
    PerAxis normal; // unit, from the box to the hand
    double depth;   // along the normal, at the start of the tick
    double closing; // the hand's share of the closing speed
    double force;   // on the hand along the normal
};

/// A hand that holds the box: a spring and a damper in all directions, which also pull.
struct GripSpring {
    std::uint32_t hand;
    PerAxis stretch; // from the held point to the hand, at the start of the interval
    PerAxis velocity;
    PerAxis impulse; // on the box, so far in the tick
};

/// The modes of the axes when slanted springs couple them. All hands are equal and drag is the same
/// along every axis, so mass, damping and stiffness are diagonal in the same basis: the
/// eigenvectors of the sum of n n^T over the springs. So each mode is an independent oscillator,
/// however many springs press.
struct CoupledAxes {
    std::array<PerAxis, 3> direction; // direction of each mode, unit
    Trajectories modes;
    std::array<Propagator, 3> propagators;
};

/// Memory that a tick needs only if an event or a slanted spring occurs in it.
struct TickRoom {
    CoupledAxes coupled; // valid only while BoxMotion::is_coupled
    int root_steps = 0;  // steps left for the searches for events
};

/// A box within a tick. Events cut the tick into intervals. In each interval every axis follows a
/// closed form.
struct BoxMotion {
    // Members have no values until they are set: clearing all of them would cost more than the
    // tick.
    // NOLINTNEXTLINE(cppcoreguidelines-pro-type-member-init)
    BoxMotion(const HandDescription& of_hands, const AxisOscillators& of_oscillators,
              Obstacles& those, TickRoom& for_tick)
        : hands{of_hands}, oscillators{of_oscillators}, obstacles{those}, room{for_tick}
    {}

    /// Returns a copy, to try the tick again.
    [[nodiscard]] BoxMotion copy() const;

    const HandDescription& hands;
    const AxisOscillators& oscillators;
    Obstacles& obstacles;
    TickRoom& room;
    std::span<const std::uint32_t> nearby{};
    double clearance = 0.0; // how far the box may move until something else is near

    double time_left = 0.0;  // of the tick, s
    bool is_exact = true;    // exact up to rounding, as is every tick without slanted springs,
                             // grips or many events
    bool is_coupled = false; // a slanted spring presses
    bool is_on_plane;        // the box is on a plane whose drag acts
    PerAxis position;
    PerAxis velocity;
    std::array<AxisMotion, 3> axes;
    Trajectories trajectories;
    std::array<std::size_t, 3> spring_counts; // pressing face springs and grips, per axis
    DryFriction dry_friction;

    std::uint32_t spring_count = 0;
    std::uint32_t grip_count = 0;
    std::uint32_t slanted_count = 0;
    std::uint32_t held_count = 0;
    std::array<FaceSpring, hands_max> springs;
    std::array<GripSpring, hands_max> grips;
    std::array<SlantedSpring, hands_max> slanted;
    std::array<HeldSpring, hands_max> held;

    [[nodiscard]] std::span<FaceSpring> active_springs() { return {springs.data(), spring_count}; }
    [[nodiscard]] std::span<const FaceSpring> active_springs() const
    {
        return {springs.data(), spring_count};
    }
    [[nodiscard]] std::span<GripSpring> active_grips() { return {grips.data(), grip_count}; }
    [[nodiscard]] std::span<const GripSpring> active_grips() const
    {
        return {grips.data(), grip_count};
    }
    [[nodiscard]] std::span<HeldSpring> active_held() { return {held.data(), held_count}; }
    [[nodiscard]] std::span<const HeldSpring> active_held() const
    {
        return {held.data(), held_count};
    }
    [[nodiscard]] std::span<SlantedSpring> active_slanted()
    {
        return {slanted.data(), slanted_count};
    }
    [[nodiscard]] std::span<const SlantedSpring> active_slanted() const
    {
        return {slanted.data(), slanted_count};
    }
};

/// Finds the obstacles that the box touches, the one that supports it, and the trajectories of its
/// axes for the next interval. Call add_friction() next where there is friction, and then
/// set_bounds().
void set_trajectories(BoxMotion& box);
void set_bounds(BoxMotion& box);

/// Advances along the trajectories for `time` seconds.
void advance(BoxMotion& box, double time);

} // namespace hapnet::scene
