// SPDX-FileCopyrightText: 2026 The Hapnet authors
// SPDX-License-Identifier: MIT
#pragma once

#include "tests/support/scene/random_play.hpp"

#include <optional>
#include <string>

namespace hapnet::test {

/// The worst values seen, in units of each law's tolerance: above 1 the law is broken.
struct LawFigures {
    double energy = 0.0;
    double momentum = 0.0;
    double angular_momentum = 0.0;
    double force = 0.0; // of the greatest force that a hand may exert
};

/// The laws that hold for every tick of every world:
/// - Every number is finite, orientations are unit, locked axes and fixed bodies stay where they
///   are, and sleeping bodies have no velocity and do not move. Without hands, no body goes farther
///   in a tick than twice the way of the fastest one and its own size; or, after several touches of
///   continuous collision in a tick, than the present energy can move it.
/// - A hand exerts no more than its greatest force (tolerated: 1e-6 of it).
/// - Kinetic energy grows by no more than the work of gravity, pushes and hands. Tolerated: 1e-6 of
///   the present energy; for each body m v^2 with v twice what its forces add in a tick; and, for a
///   body that turns far, the range of its rotational energy at its angular momentum.
/// - Kinematic bodies give no more energy than they pass on at the speed of their fastest corner.
/// - Where nothing is fixed, momentum changes by what gravity, pushes and hands give. Tolerated:
///   1e-10 of the sum of all amounts and of the hands' total, and the rounding of each amount.
///   Without hands, angular momentum changes by what gravity and pushes give. Tolerated: the motion
///   of bodies past each other in a tick times the impulses.
/// A body moves at the mean of its velocities before and after the tick, except when it bounces. So
/// the work of a steady force and of every impulse is known: with the inertia before the tick, or
/// for torques the inertia after it, or by the angle that the body turned.
class SceneLaws {
public:
    explicit SceneLaws(const RandomPlay& play);

    /// Call it just before a tick, with the inputs given.
    void before(const scene::World& world);
    /// Call it just after the tick. Returns the law that was broken, if any, with numbers.
    [[nodiscard]] std::optional<std::string> after(const scene::World& world);

    [[nodiscard]] const LawFigures& worst() const { return worst_; }

private:
    /// Returns the number of contacts of a hand with a body: one at most, or one with each part.
    [[nodiscard]] double contacts_on(const scene::HandTouch& touch) const
    {
        return 1.0 + static_cast<double>(play_.description.bodies[touch.body].parts.size());
    }
    struct Moment {
        scene::BodyState state;
        glm::dvec3 angular_momentum{0.0};
        bool is_awake = true;
        glm::dvec3 field{0.0}; // N, of the fields on a body
    };
    /// Sums over all bodies for one tick.
    struct Balance {
        double kinetic_before = 0.0;
        double kinetic_after = 0.0;
        double work = 0.0;
        double fastest = 0.0;  // m/s, of any corner
        double farthest = 0.0; // m that a body went beyond its own size
        double fling = 0.0;    // J s^2: the most of 1/2 m of that squared
        double jolt = 0.0;     // N s: the sum of the changes of momentum, or of what others did
        double hurry = 0.0;    // m/s: the most that a field alone changes a velocity by
        double momentum = 0.0; // N s: the sum of the amounts
        double angular = 0.0;  // N m s, likewise
        double astray = 0.0;   // N m s: of moving apart
        double slack = 0.0;    // J
        double driven = 0.0;   // m/s, of any corner of a kinematic body
        double passed = 0.0;   // N s: what contacts and hands passed to the bodies, as linear ones
        glm::dvec3 linear_gain{0.0};
        glm::dvec3 angular_gain{0.0};
        bool any_fell_asleep = false;
    };

    [[nodiscard]] std::optional<std::string> check_body(const scene::World& world,
                                                        scene::BodyId id) const;
    [[nodiscard]] std::optional<std::string> check_hands(const scene::World& world);
    [[nodiscard]] glm::dvec3 steady_force(const scene::World& world, scene::BodyId id,
                                          bool sleeps) const;
    [[nodiscard]] glm::dvec3 steady_torque(const scene::World& world, scene::BodyId id) const;
    void add_torque(Balance& balance, const scene::BodyDescription& form, const Moment& was,
                    const Moment& now, const glm::dvec3& torque) const;
    void add_driven(Balance& balance, const scene::World& world, scene::BodyId id) const;
    [[nodiscard]] static double turning_slack(const scene::BodyDescription& form, const Moment& was,
                                              const Moment& now, double angle);
    void add(Balance& balance, const scene::World& world, scene::BodyId id) const;
    [[nodiscard]] double most_from_hand(const scene::World& world, std::uint32_t hand,
                                        double fastest) const;
    [[nodiscard]] double within_reach(const scene::World& world, std::uint32_t hand) const;
    [[nodiscard]] double driven_energy(const scene::World& world, const Balance& balance) const;
    [[nodiscard]] std::optional<std::string> check_energy(const scene::World& world,
                                                          const Balance& balance);
    [[nodiscard]] std::optional<std::string> check_ways(const scene::World& world,
                                                        const Balance& balance) const;
    [[nodiscard]] std::optional<std::string> check_momentum(const scene::World& world,
                                                            const Balance& balance);
    [[nodiscard]] Moment moment_of(const scene::World& world, scene::BodyId id) const;

    const RandomPlay& play_;
    bool nothing_is_fixed_ = true;
    double movable_ = 0.0;             // how many
    double size_ = scene::size_max_m;  // the smallest half edge, m
    std::uint64_t touches_before_ = 0; // of continuous collision, up to the tick
    std::vector<Moment> moments_;
    LawFigures worst_;
};

/// The result of a play.
struct PlayOutcome {
    std::optional<std::string> complaint; // with the tick
    LawFigures worst;
    scene::Interventions interventions;
    std::uint64_t hash = 0;
};

/// Plays it under the laws, and once more from a snapshot at a drawn tick, which must give the same
/// hash.
[[nodiscard]] PlayOutcome judge(const RandomPlay& play, std::uint64_t seed);

} // namespace hapnet::test
