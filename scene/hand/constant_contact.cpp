// SPDX-FileCopyrightText: 2026 The Hapnet authors
// SPDX-License-Identifier: MIT
#include "scene/hand/constant_contact.hpp"

#include "scene/hand/surface.hpp"
#include "scene/hand/unlike_springs.hpp"
#include "scene/maths/lanes.hpp"
#include "scene/maths/rotation.hpp"
#include "scene/maths/vector.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <glm/geometric.hpp>

namespace hapnet::scene {

namespace {

// The most that a normal may rotate in half a tick: then its mean is right to 1e-5.
constexpr double half_rotation_max = 0.01;
// A rotation below this is rounding.
constexpr double no_rotation = 1e-13;
// A rotation below this keeps all directions, to rounding.
constexpr double negligible_rotation = 1e-10;

glm::dvec3 diagonal_of(const glm::dmat3& m) { return {m[0].x, m[1].y, m[2].z}; }

/// The springs that press and the faces, both at once; where there is one, the other pushes along
/// nothing. Everything is set before it is read.
// NOLINTNEXTLINE(cppcoreguidelines-pro-type-member-init)
class ConstantContact {
public:
    ConstantContact(MovingBody& body, const BodyDynamics& dynamics,
                    std::span<const HandSpring> springs, double tick)
        : body_{body},
          dynamics_{dynamics},
          springs_{springs},
          has_two_{springs.size() == 2},
          tick_{tick},
          ease_{diagonal_of(dynamics.inverse_inertia)}
    {}

    /// False: it is not steady.
    bool advance(std::span<SpringImpulse> work, PressedModes& modes)
    {
        if (!set_geometry_halfway()) return false;
        set_couplings();
        return integrate_contacts(modes) && finish(work);
    }

private:
    bool set_geometry_halfway();
    void set_couplings();
    bool integrate_contacts(PressedModes& modes);
    bool finish(std::span<SpringImpulse> work);
    [[nodiscard]] Two depth_change() const;

    MovingBody& body_;
    const BodyDynamics& dynamics_;
    std::span<const HandSpring> springs_;
    bool has_two_;
    double tick_;
    glm::dvec3 ease_; // 1/(kg m^2), about each axis
    TwoVectors hand_; // seen from the body's centre, at the start
    TwoVectors away_; // the body's velocity over the hand's, at the start
    TwoVectors normal_, lever_;
    Two own_;              // 1/kg
    double mutual_ = 0.0;  // 1/kg
    Two depth_, closing_;  // at the start
    Two acceleration_;     // of the depths, by everything but the springs
    Two impulse_, moment_; // of the forces, N s, and its integral, N s^2
};

/// Turns what is held to where it is halfway at the speeds of the start: what the forces change
/// until then is of second order, and where they are in balance nothing.
bool ConstantContact::set_geometry_halfway()
{
    const double half = 0.5 * tick_;
    const glm::dvec3 angle = half * (ease_ * body_.angular_momentum);
    const double most = sum_of_sizes(angle);
    if (!(most <= half_rotation_max)) return false;
    const HandSpring& a = springs_.front();
    const HandSpring& b = springs_.back();
    normal_ = both(a.normal, has_two_ ? b.normal : glm::dvec3{0.0});
    hand_ = both(a.arm, b.arm) + Two{a.radius + a.gap, b.radius + b.gap} * normal_;
    away_ = both(body_.velocity) - both(a.velocity, b.velocity);
    depth_ = Two{-a.gap, has_two_ ? -b.gap : 0.0};
    if (most > no_rotation) {
        const TwoVectors turn = both(angle);
        const TwoVectors once = cross(turn, normal_);
        normal_ = normal_ + once + scene::both(0.5) * cross(turn, once);
    }
    lever_ = cross(hand_ - both(half) * away_, normal_);
    return true;
}

void ConstantContact::set_couplings()
{
    const TwoVectors pushed = both(dynamics_.inverse_mass) * normal_;
    const TwoVectors turned = both(ease_) * lever_;
    own_ = dot(normal_, pushed) + dot(lever_, turned);
    closing_ = dot(normal_, away_) + dot(turned, both(body_.angular_momentum));
    acceleration_ =
        dot(normal_, both(dynamics_.acceleration)) + dot(turned, both(dynamics_.torque));
    mutual_ = glm::dot(first(normal_), second(pushed)) + glm::dot(first(lever_), second(turned));
}

/// False when a force may end or reach its greatest, or the tick is long for the springs.
bool ConstantContact::integrate_contacts(PressedModes& modes)
{
    const HandSpring& a = springs_.front();
    const HandSpring& b = springs_.back();
    PressedModes::Outcome outcome;
    Two stiffness = both(a.stiffness), damping = both(a.damping);
    if (a.stiffness == b.stiffness && a.damping == b.damping) {
        if (!modes.find({own_, mutual_, a.stiffness, a.damping, tick_})) return false;
        outcome = modes.outcome({depth_, closing_, acceleration_});
    } else {
        stiffness = Two{a.stiffness, b.stiffness};
        damping = Two{a.damping, b.damping};
        const UnlikeSprings unlike{own_, mutual_, stiffness, damping, tick_};
        const auto found = unlike.outcome({depth_, closing_, acceleration_});
        if (!found) return false;
        outcome = *found;
    }
    const Two start = stiffness * depth_ + damping * closing_;
    const Two least = start - outcome.change, most = start + outcome.change;
    if (!(least[0] > 0.0 && most[0] < a.force_max)) return false;
    if (has_two_ && !(least[1] > 0.0 && most[1] < b.force_max)) return false;
    impulse_ = outcome.impulse;
    moment_ = outcome.moment;
    return true;
}

/// By how much the depths have grown, by what was held.
Two ConstantContact::depth_change() const
{
    const Two pushed = own_ * moment_ + both(mutual_) * swapped(moment_);
    return both(tick_) * (closing_ + both(0.5 * tick_) * acceleration_) - pushed;
}

bool ConstantContact::finish(std::span<SpringImpulse> work)
{
    const double t = tick_;
    const TwoVectors push = impulse_ * normal_;
    const glm::dvec3 moved = t * (body_.velocity + (0.5 * t) * dynamics_.acceleration) -
                             dynamics_.inverse_mass * sum(moment_ * normal_);
    const glm::dvec3 swept =
        t * (body_.angular_momentum + (0.5 * t) * dynamics_.torque) - sum(moment_ * lever_);
    const glm::dvec3 angle = ease_ * swept;
    // From amid a face to beside it is a tenth of a half edge at least.
    const glm::dvec3& size = dynamics_.half;
    const double room = 0.1 * std::min(size.x, std::min(size.y, size.z));
    const double corner = (size.x + size.y + size.z) * sum_of_sizes(angle);
    const HandSpring& a = springs_.front();
    const HandSpring& b = springs_.back();
    const TwoVectors gone = both(t) * both(a.velocity, b.velocity) - both(moved);
    const Two farthest = sum_of_sizes(gone) + both(corner);
    if (!(farthest[0] <= room && farthest[1] <= room)) return false;
    work[0].impulse = -first(push); // `advance` clears what is refused
    if (has_two_) work[1].impulse = -second(push);
    body_.position += moved;
    body_.velocity += t * dynamics_.acceleration - dynamics_.inverse_mass * sum(push);
    body_.angular_momentum += t * dynamics_.torque - sum(impulse_ * lever_);
    if (angle == glm::dvec3{0.0}) return true;
    const glm::dquat turn = rotation_by(angle);
    body_.orientation = unit_again(turn * body_.orientation);
    if (glm::dot(angle, angle) < negligible_rotation * negligible_rotation) return true;
    const TwoVectors hands = hand_ + gone;
    const std::array<glm::dvec3, 2> hand{first(hands), second(hands)};
    const Two depth = depth_ + depth_change();
    for (std::size_t i = 0; i < springs_.size(); ++i) {
        const HandSpring& spring = springs_[i];
        const double above =
            glm::dot(turn * spring.normal, hand[i]) - // the face turns about the centre
            glm::dot(spring.normal, spring.arm);
        correct_energy({body_, dynamics_, dynamics_.inverse_inertia, t}, spring,
                       {depth[i], spring.radius - above}, work[i]);
    }
    return true;
}

} // namespace

bool advance_in_constant_contact(MovingBody& body, const BodyDynamics& dynamics,
                                 std::span<const HandSpring> springs, std::span<SpringImpulse> work,
                                 double tick, PressedModes& modes)
{
    if (!dynamics.rotates_uniformly || springs.empty() || springs.size() > 2) return false;
    for (const HandSpring& spring : springs) {
        if (!spring.is_amid_face || spring.gap > 0.0 || !(spring.stiffness > 0.0)) return false;
    }
    return ConstantContact{body, dynamics, springs, tick}.advance(work, modes);
}

} // namespace hapnet::scene
