// SPDX-FileCopyrightText: 2026 The Hapnet authors
// SPDX-License-Identifier: MIT
#pragma once

#include "scene/maths/first_root.hpp"
#include "scene/one_box/obstacles.hpp"
#include "scene/one_box/spring.hpp"

#include <array>
#include <limits>
#include <span>

namespace hapnet::scene {

/// The laws that an axis can be under: with any number of springs, with or without drag.
class SlideLaws {
public:
    SlideLaws(const HandDescription& hands, const BodyProperties& body, double tick);

    [[nodiscard]] double inverse_mass() const { return inverse_mass_; }
    /// Of one spring.
    [[nodiscard]] const Oscillator& spring() const { return propagators_[0][1].oscillator; }

    [[nodiscard]] const Propagator& of(std::size_t springs, bool with_drag) const
    {
        return propagators_[with_drag ? 1 : 0][springs];
    }

private:
    double inverse_mass_;
    std::array<std::array<Propagator, hands_max + 1>, 2> propagators_;
};

/// What one axis of the box does.
struct SlideAxis {
    double steady; // acceleration of the forces that hold for the tick
    bool stopped;  // locked, or for the rest of the tick
    bool leaving;  // its support has just lost it

    const Obstacle* below; // at whose high face it is
    const Obstacle* above;
    const Obstacle* carrier; // one of them, when it presses on that
    double load;             // by which it presses, per mass; >= 0; only with a carrier
    double load_ramp;        // m/s^3

    double acceleration; // at the start of the stretch
    Bounds most;         // for what is left of the tick
    double reach;        // how far it can come in what is left of the tick

    /// Whether it is kept where it is by something else than dry friction.
    [[nodiscard]] bool is_held() const { return stopped || carrier; }
};

/// Dry friction on what carries the box.
struct Rubbing {
    enum class State : std::uint8_t { none, stuck, sliding };
    State state = State::none;
    bool slips = false;  // it has just begun to slide
    PerAxis direction{}; // of the sliding
    double limit = 0.0;  // the greatest friction, per mass
    double limit_ramp = 0.0;
};

/// A box within a tick. The tick is cut into stretches at what begins or ends in it; in each of
/// them every axis runs a closed form.
struct Slide {
    // Without values until they are set: clearing all of them would cost more than the tick.
    // NOLINTNEXTLINE(cppcoreguidelines-pro-type-member-init)
    Slide(const HandDescription& of_hips, const SlideLaws& of_laws, Obstacles& those)
        : hands{of_hips}, laws{of_laws}, obstacles{those}
    {}

    /// Another one like it, to try the tick again.
    [[nodiscard]] Slide copy() const;

    const HandDescription& hands;
    const SlideLaws& laws;
    Obstacles& obstacles;
    std::span<const std::uint32_t> near{};
    double room = 0.0; // how far the box may go until something else is near

    double left = 0.0; // of the tick, s
    bool calm = false; // too much has happened in this tick: no more changes, no more bounces
    PerAxis place;
    PerAxis velocity;
    std::array<SlideAxis, 3> axes;
    Trajectories trajectories;
    Rubbing rubbing;

    std::uint32_t spring_count = 0;
    std::uint32_t grip_count = 0;
    std::uint32_t slanted_count = 0;
    std::array<Spring, hands_max> springs;
    std::array<Grip, hands_max> grips;
    std::array<SlantedSpring, hands_max> slanted;

    [[nodiscard]] std::span<Spring> active_springs() { return {springs.data(), spring_count}; }
    [[nodiscard]] std::span<const Spring> active_springs() const
    {
        return {springs.data(), spring_count};
    }
    [[nodiscard]] std::span<Grip> active_grips() { return {grips.data(), grip_count}; }
    [[nodiscard]] std::span<const Grip> active_grips() const { return {grips.data(), grip_count}; }
    [[nodiscard]] std::span<SlantedSpring> active_slanted()
    {
        return {slanted.data(), slanted_count};
    }
    [[nodiscard]] std::span<const SlantedSpring> active_slanted() const
    {
        return {slanted.data(), slanted_count};
    }
};

/// Finds what the box touches, what carries it, and the courses of its axes for the next stretch;
/// then with_friction() where there is any, then with_bounds().
void set_courses(Slide& slide);
void with_friction(Slide& slide);
void with_bounds(Slide& slide);

/// Runs the courses for `time` seconds.
void advance(Slide& slide, double time);

} // namespace hapnet::scene
