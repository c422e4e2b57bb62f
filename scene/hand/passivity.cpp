// SPDX-FileCopyrightText: 2026 The Hapnet authors
// SPDX-License-Identifier: MIT
#include "scene/hand/passivity.hpp"

#include "scene/hand/contact_phases.hpp"
#include "scene/hand/surface.hpp"
#include "scene/maths/energy_share.hpp"
#include "scene/maths/rotation.hpp"
#include "scene/maths/vector.hpp"

#include <algorithm>
#include <type_traits>

namespace hapnet::scene {

namespace {

// The error of differences of energies, as a share of all energies in the sum.
constexpr double energy_rounding = 1e-9;
// The energy gain of a rule that holds directions while they turn, as a share of the stored and
// exchanged energy.
constexpr double second_order = 0.03;
// The rounding of a sum of phases, as a share of the greatest force.
constexpr double force_rounding = 1e-9;
// The turn in a tick, in radians, beyond which the inertia at the start is no estimate of that at
// the end.
constexpr double far_turn_of_pressed = 0.25;

/// Returns the energy of a spring at the start of its tick.
double stored_energy(const HandSpring& spring)
{
    if (!spring.holds) return spring_energy(spring, -spring.gap);
    return spring_energy(spring, length(spring.stretch));
}

/// Returns the energy that the springs store at the start, and the work of the hands' motion on
/// these impulses.
HandEnergy energy_of(std::span<const HandSpring> springs, std::span<const SpringImpulse> work)
{
    HandEnergy energy;
    for (std::size_t i = 0; i < springs.size(); ++i) {
        energy.stored += stored_energy(springs[i]);
        energy.driven += glm::dot(work[i].impulse, springs[i].velocity);
    }
    return energy;
}

struct MomentsRatio {
    double spread = 0.0; // the largest moment of inertia over the smallest, less 1
    double range = 0.0;  // range of 1/2 L I^-1 L for |L| = 1
};
MomentsRatio moments_of(const BodyDynamics& dynamics)
{
    const glm::dmat3& light = dynamics.inverse_inertia;
    const double trace = light[0].x + light[1].y + light[2].z;
    if (dynamics.rotates_uniformly || trace == 0.0) return {};
    const glm::dvec3 squares = dynamics.half * dynamics.half;
    glm::dvec3 about{squares.y + squares.z, squares.z + squares.x, squares.x + squares.y};
    if (dynamics.moments.x > 0.0) about = dynamics.moments;
    const double most = std::max(std::max(about.x, about.y), about.z);
    const double least = std::min(std::min(about.x, about.y), about.z);
    const double sum = 1.0 / about.x + 1.0 / about.y + 1.0 / about.z;
    return {most / least - 1.0, 0.5 * trace / sum * (1.0 / least - 1.0 / most)};
}

/// Returns the energy of a pull along a surface that the push at a depth can hold. It is zero where
/// they are apart.
double pull_energy(const HandSpring& spring, const FrictionSpring& friction, double stretch,
                   double depth)
{
    return spring_energy(spring, std::min(stretch, friction.limits.sticking * depth));
}

struct Smooth {};

template <bool rubs>
class PassivityCheck {
public:
    using Frictions = std::conditional_t<rubs, std::span<const FrictionSpring>, Smooth>;

    PassivityCheck(const HandTick& body, std::span<const HandSpring> springs,
                   std::span<const SpringImpulse> work, double driven, Frictions frictions = {})
        : body_{body},
          springs_{springs},
          frictions_{frictions},
          free_{body.start},
          mass_{mass_of(body.dynamics)},
          driven_{driven}
    {
        for (std::size_t i = 0; i < springs.size(); ++i) {
            if (!springs[i].holds) continue;
            grips_.impulse += length(work[i].impulse);
            grips_.stored += stored_energy(springs[i]);
            grips_.driven += glm::dot(work[i].impulse, springs[i].velocity);
        }
        advance_freely(free_, body.dynamics, body.tick);
        velocity_ = body.end.velocity - free_.velocity;
        angular_momentum_ = body.end.angular_momentum - free_.angular_momentum;
        before_ = kinetic_energy(body.start);
        after_ = kinetic_energy(body.end);
    }

    /// Returns the largest passive share of the impulses.
    [[nodiscard]] double share(double stored, SpringsAtEnd at_end) const
    {
        const double there = before_ + after_ + std::abs(driven_);
        const double rounding = energy_rounding * (there + stored);
        const glm::dmat3& light = body_.dynamics.inverse_inertia;
        const EnergyOfShare at_start = energy_with(light, light);
        double share = 1.0;
        // The uncertainty from rotation shrinks with the share.
        for (int round = 0; round < share_rounds_max; ++round) {
            const double turning = turning_slack(share);
            double within = at_start.share_within(stored + rounding + turning);
            if (grips_.impulse > 0.0) {
                EnergyOfShare gripped = at_start;
                gripped.linear -= grips_.most(fastest(share)) - grips_.driven;
                // A grip may have stored megajoules, of which the share gives almost nothing.
                const double others = stored - grips_.stored;
                const double slack =
                    turning + energy_rounding * (before_ + share * (there - before_) + others);
                within = std::min(within, gripped.share_within(others + slack));
            }
            if (within >= share) break;
            share = next_share(share, within, round);
        }
        if (at_end == SpringsAtEnd::ignored) return share;
        // The energy stored at the end follows from the body's place and orientation at that time,
        // and so does its inertia.
        const EnergyOfShare energy =
            energy_with(inverse_inertia_of(body_.end), inverse_inertia_of(free_));
        const double then = stored_at(body_.end);
        const double vague = second_order * std::max(std::max(stored, then), 0.25 * energy.square);
        return std::min(share, energy.share_within(stored - then + rounding + vague));
    }

    /// Scales the effect of the hands on the body. The body ends where the springs store less: at
    /// the place to which the full push moved it, or at that of the smaller push.
    void scale(double share)
    {
        MovingBody& end = body_.end;
        MovingBody less = free_;
        less.position += share * (end.position - free_.position);
        less.velocity += share * velocity_;
        less.angular_momentum += share * angular_momentum_;
        if (free_.orientation != end.orientation) {
            const double along = glm::dot(free_.orientation, end.orientation);
            const double other = along < 0.0 ? -share : share;
            less.orientation =
                glm::normalize((1.0 - share) * free_.orientation + other * end.orientation);
        }
        if (stored_at(less) > stored_at(end)) {
            less.position = end.position;
            less.orientation = end.orientation;
        }
        end = less;
    }

    [[nodiscard]] const GripEnergy& grips() const { return grips_; }

private:
    /// Returns the energy with the inverse inertia at the end, and with the one that the body would
    /// have there without hands.
    [[nodiscard]] EnergyOfShare energy_with(const glm::dmat3& light,
                                            const glm::dmat3& light_free) const
    {
        const BodyDynamics& dynamics = body_.dynamics;
        const glm::dvec3& momentum = free_.angular_momentum;
        const glm::dvec3 gained = (0.5 * body_.tick) * dynamics.acceleration;
        const glm::dvec3 twist = (0.5 * body_.tick) * dynamics.torque;
        EnergyOfShare energy;
        energy.none = 0.5 * glm::dot(momentum, (light - light_free) * momentum);
        if (dynamics.drag > 0.0) energy.none += std::min(lost_by_drag(), 0.0);
        energy.linear = glm::dot(mass_ * velocity_, free_.velocity - gained) +
                        glm::dot(angular_momentum_, light * (momentum - twist)) - driven_;
        energy.square = 0.5 * (glm::dot(mass_ * velocity_, velocity_) +
                               glm::dot(angular_momentum_, light * angular_momentum_));
        return energy;
    }

    [[nodiscard]] glm::dmat3 inverse_inertia_of(const MovingBody& body) const
    {
        const glm::dmat3& light = body_.dynamics.inverse_inertia;
        if (body_.dynamics.rotates_uniformly) return light;
        const glm::dmat3 turn =
            axes_of(body.orientation) * glm::transpose(axes_of(body_.start.orientation));
        return turn * light * glm::transpose(turn);
    }

    [[nodiscard]] double kinetic_energy(const MovingBody& body) const
    {
        return 0.5 * (glm::dot(mass_ * body.velocity, body.velocity) +
                      glm::dot(body.angular_momentum,
                               body_.dynamics.inverse_inertia * body.angular_momentum));
    }

    [[nodiscard]] double lost_by_drag() const
    {
        const double tick = body_.tick;
        const BodyDynamics& dynamics = body_.dynamics;
        const glm::dvec3 force = mass_ * dynamics.acceleration;
        const glm::dvec3 steady = (0.5 * tick) * (body_.start.velocity + free_.velocity);
        const double work =
            std::max(glm::dot(force, steady),
                     glm::dot(force, free_.position - body_.start.position)) +
            (0.5 * tick) * glm::dot(dynamics.torque,
                                    dynamics.inverse_inertia *
                                        (body_.start.angular_momentum + free_.angular_momentum));
        return kinetic_energy(free_) - before_ - work;
    }

    /// Returns the speed of the fastest corner, at the start or at the end with a share of the
    /// impulses.
    [[nodiscard]] double fastest(double share) const
    {
        const glm::dmat3& light = body_.dynamics.inverse_inertia;
        const double radius = length(body_.dynamics.half);
        const double before =
            length(body_.start.velocity) + radius * length(light * body_.start.angular_momentum);
        const double after =
            length(free_.velocity + share * velocity_) +
            radius * length(light * (free_.angular_momentum + share * angular_momentum_));
        return std::max(before, after);
    }

    /// Returns how wrong the rotational energy may be when it is computed with the inertia at the
    /// start, J.
    [[nodiscard]] double turning_slack(double share) const
    {
        const MomentsRatio moments = moments_of(body_.dynamics);
        if (moments.spread == 0.0) return 0.0;
        const glm::dmat3& light = body_.dynamics.inverse_inertia;
        const glm::dvec3& before = body_.start.angular_momentum;
        const glm::dvec3 given = share * angular_momentum_;
        const glm::dvec3 after = free_.angular_momentum + given;
        const double spin = std::max(length(light * before), length(light * after));
        const double angle = spin * body_.tick;
        // Half of the greatest possible error: the spin at the end may be the smaller one.
        const double slack = 0.5 * moments.spread * std::min(angle, 1.0) * spin * length(given);
        if (angle <= far_turn_of_pressed) return slack;
        return slack + 0.5 * moments.range * (glm::dot(before, before) + glm::dot(after, after));
    }

    [[nodiscard]] double stored_at(const MovingBody& body) const
    {
        const glm::dmat3 axes_before = axes_of(body_.start.orientation);
        const glm::dmat3 axes = axes_of(body.orientation);
        const glm::dvec3 moved = body.position - body_.start.position;
        double sum = 0.0;
        if constexpr (rubs) sum += stored_along(axes * glm::transpose(axes_before), moved);
        for (const HandSpring& spring : springs_) {
            const glm::dvec3 hand = body_.tick * spring.velocity - moved;
            if (spring.holds) {
                const glm::dvec3 arm = axes * (spring.arm * axes_before);
                sum += spring_energy(spring, length(hand + spring.stretch + spring.arm - arm));
            } else {
                const BoxSurface surface{spring, body_.dynamics, axes_before};
                const glm::dvec3 from = spring.arm + (spring.radius + spring.gap) * spring.normal;
                sum += spring_energy(spring, surface.at(axes, from + hand).depth);
            }
        }
        return sum;
    }

    /// Returns the energy stored along the surfaces of a body that has turned and moved.
    [[nodiscard]] double stored_along(const glm::dmat3& turn,
                                      const glm::dvec3& moved) const requires rubs
    {
        double sum = 0.0;
        for (std::size_t i = 0; i < springs_.size(); ++i) {
            const HandSpring& spring = springs_[i];
            const FrictionSpring& friction = frictions_[i];
            if (spring.holds || !friction.limits.is_rough()) continue;
            const glm::dvec3 proxy = spring.arm - friction.stretch;
            const glm::dvec3 stretch = friction.stretch + body_.tick * spring.velocity - moved -
                                       (turn * proxy - proxy) - friction.slid;
            const BoxSurface surface{spring, body_.dynamics, axes_of(body_.start.orientation)};
            const glm::dvec3 hand = spring.arm + (spring.radius + spring.gap) * spring.normal +
                                    body_.tick * spring.velocity - moved;
            const ContactGeometry now = surface.at(turn * axes_of(body_.start.orientation), hand);
            const glm::dvec3 along = stretch - glm::dot(stretch, now.normal) * now.normal;
            sum += pull_energy(spring, friction, length(along), now.depth);
        }
        return sum;
    }

    HandTick body_;
    std::span<const HandSpring> springs_;
    [[no_unique_address]] Frictions frictions_;
    MovingBody free_; // the body at the end without hands
    glm::dvec3 mass_;
    double driven_;
    glm::dvec3 velocity_{0.0};         // change by the hands
    glm::dvec3 angular_momentum_{0.0}; // change by the hands
    double before_ = 0.0;
    double after_ = 0.0;
    GripEnergy grips_;
};

/// Returns the share with which no spring gives more than it can.
double share_within_forces(std::span<const HandSpring> springs, std::span<const SpringImpulse> work,
                           double tick)
{
    double share = 1.0;
    for (std::size_t i = 0; i < springs.size(); ++i) {
        const double most = springs[i].force_max * tick;
        const double given = length(work[i].impulse);
        if (given > (1.0 + force_rounding) * most) share = std::min(share, most / given);
    }
    return share;
}

template <bool rubs>
void brake(PassivityCheck<rubs>& check, double share, std::span<SpringImpulse> work,
           HandEnergy& energy)
{
    if (share < 1.0) {
        check.scale(share);
        for (SpringImpulse& each : work) each.impulse *= share;
        energy.driven *= share;
        energy.is_braked = true;
    }
    energy.grips = check.grips();
    energy.grips.scale(share);
    energy.stored -= energy.grips.stored;
}

} // namespace

HandEnergy keep_passive(const HandTick& body, std::span<const HandSpring> springs,
                        std::span<SpringImpulse> work, SpringsAtEnd at_end)
{
    HandEnergy energy = energy_of(springs, work);
    PassivityCheck<false> check{body, springs, work, energy.driven};
    const double share =
        std::min(check.share(energy.stored, at_end), share_within_forces(springs, work, body.tick));
    brake(check, share, work.first(springs.size()), energy);
    return energy;
}

HandEnergy keep_passive(const HandTick& body, const FrictionContacts& contacts)
{
    const auto [springs, frictions, work] = contacts;
    HandEnergy energy = energy_of(springs, work);
    for (std::size_t i = 0; i < springs.size(); ++i)
        energy.stored +=
            pull_energy(springs[i], frictions[i], length(frictions[i].stretch), -springs[i].gap);
    PassivityCheck<true> check{body, springs, work, energy.driven, frictions};
    const double share = std::min(check.share(energy.stored, SpringsAtEnd::counted),
                                  share_within_forces(springs, work, body.tick));
    brake(check, share, work.first(springs.size()), energy);
    return energy;
}

} // namespace hapnet::scene
