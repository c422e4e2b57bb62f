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
#include <limits>

namespace hapnet::scene {

namespace {

// The greatest rotation of a normal in half a tick at which its mean is right to 1e-5.
constexpr double half_rotation_max = 0.01;
// A rotation below this is rounding.
constexpr double no_rotation = 1e-13;
// A rotation below this keeps all directions, to rounding.
constexpr double negligible_rotation = 1e-10;
// A rotation below this changes an orientation by less than the limit of has_hardly_turned().
constexpr double hardly_any_rotation = 5e-11;

glm::dvec3 diagonal_of(const glm::dmat3& m) { return {m[0].x, m[1].y, m[2].z}; }

/// The forces on the body, and the effects of the two pressing springs at once. If there is one
/// spring, the other pushes along a zero vector. Everything is set before it is read.
// NOLINTNEXTLINE(cppcoreguidelines-pro-type-member-init)
class ConstantContact {
public:
    ConstantContact(MovingBody& body, const BodyDynamics& dynamics, const PressingSprings& springs,
                    double tick)
        : body_{body},
          dynamics_{dynamics},
          springs_{springs},
          tick_{tick},
          ease_{diagonal_of(dynamics.inverse_inertia)}
    {}

    /// Moves and turns the body. Returns false and leaves the body as it was when a contact begins
    /// or ends, or when the body turns by more than `rotation_max`.
    bool advance(PressedModes& modes, double rotation_max)
    {
        if (!set_geometry_halfway()) return false;
        set_couplings();
        if (!integrate_contacts(modes) || !stays_amid()) return false;
        if (!(sum_of_sizes(angle_) <= rotation_max)) return false;
        finish();
        return true;
    }
    /// Returns the impulses on the hands.
    [[nodiscard]] const TwoVectors& impulse() const { return push_; }
    /// True if the body turns so little that the directions stay, except for rounding.
    [[nodiscard]] bool turns_negligibly() const
    {
        return glm::dot(angle_, angle_) < negligible_rotation * negligible_rotation;
    }
    /// Corrects body and impulses for the change that the turn makes to the springs' energy.
    void correct(std::span<const HandSpring> springs, std::span<SpringImpulse> work) const;

private:
    bool set_geometry_halfway();
    void set_couplings();
    bool integrate_contacts(PressedModes& modes);
    bool stays_amid();
    void finish();
    [[nodiscard]] Two depth_change() const;

    MovingBody& body_;
    const BodyDynamics& dynamics_;
    const PressingSprings& springs_;
    double tick_;
    glm::dvec3 ease_; // inverse inertia about each axis, 1/(kg m^2)
    TwoVectors hand_; // places of the hands at the start, from the body's centre
    TwoVectors away_; // the body's velocity relative to the hand, at the start
    TwoVectors normal_, lever_;
    Two own_;              // 1/kg
    double mutual_ = 0.0;  // 1/kg
    Two depth_, closing_;  // at the start
    Two acceleration_;     // of the depths, without the springs' forces
    Two impulse_, moment_; // impulses of the forces, N s, and their integrals, N s^2
    glm::dvec3 moved_, angle_;
    TwoVectors gone_; // paths of the hands relative to the body's centre
    TwoVectors push_;
    glm::dquat turn_;
};

/// Turns the held vectors to their orientation halfway at the speeds of the start. The forces'
/// effect until then is of second order, and zero where they are in balance.
bool ConstantContact::set_geometry_halfway()
{
    const double half = 0.5 * tick_;
    const glm::dvec3 angle = half * (ease_ * body_.angular_momentum);
    const double most = sum_of_sizes(angle);
    if (!(most <= half_rotation_max)) return false;
    const Two gap = springs_.gap;
    normal_ = springs_.normal;
    depth_ = -gap;
    if (!springs_.are_two) {
        normal_.x[1] = normal_.y[1] = normal_.z[1] = 0.0;
        depth_[1] = 0.0;
    }
    hand_ = springs_.arm + (springs_.radius + gap) * normal_;
    away_ = both(body_.velocity) - springs_.velocity;
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

/// Returns false when a force may end or reach its greatest value, or when the tick is too long for
/// such stiff springs.
bool ConstantContact::integrate_contacts(PressedModes& modes)
{
    const Two stiffness = springs_.stiffness, damping = springs_.damping;
    const Two force_max = springs_.force_max;
    PressedModes::Outcome outcome;
    if (stiffness[0] == stiffness[1] && damping[0] == damping[1]) {
        if (!modes.find({own_, mutual_, stiffness[0], damping[0], tick_})) return false;
        outcome = modes.outcome({depth_, closing_, acceleration_});
    } else {
        const UnlikeSprings unlike{own_, mutual_, stiffness, damping, tick_};
        const auto found = unlike.outcome({depth_, closing_, acceleration_});
        if (!found) return false;
        outcome = *found;
    }
    const Two start = stiffness * depth_ + damping * closing_;
    const Two least = start - outcome.change, most = start + outcome.change;
    if (!(least[0] > 0.0 && most[0] < force_max[0])) return false;
    if (springs_.are_two && !(least[1] > 0.0 && most[1] < force_max[1])) return false;
    impulse_ = outcome.impulse;
    moment_ = outcome.moment;
    return true;
}

/// Returns the growth of the depths in the tick, with normals and levers held.
Two ConstantContact::depth_change() const
{
    const Two pushed = own_ * moment_ + both(mutual_) * swapped(moment_);
    return both(tick_) * (closing_ + both(0.5 * tick_) * acceleration_) - pushed;
}

bool ConstantContact::stays_amid()
{
    const double t = tick_;
    moved_ = t * (body_.velocity + (0.5 * t) * dynamics_.acceleration) -
             dynamics_.inverse_mass * sum(moment_ * normal_);
    const glm::dvec3 swept =
        t * (body_.angular_momentum + (0.5 * t) * dynamics_.torque) - sum(moment_ * lever_);
    angle_ = ease_ * swept;
    // The hand is amid a face: at least a tenth of a half edge away from leaving it.
    const glm::dvec3& size = dynamics_.half;
    const double room = 0.1 * std::min(size.x, std::min(size.y, size.z));
    const double corner = (size.x + size.y + size.z) * sum_of_sizes(angle_);
    gone_ = both(t) * springs_.velocity - both(moved_);
    const Two farthest = sum_of_sizes(gone_) + both(corner);
    return farthest[0] <= room && farthest[1] <= room;
}

void ConstantContact::finish()
{
    const double t = tick_;
    push_ = impulse_ * normal_;
    body_.position += moved_;
    body_.velocity += t * dynamics_.acceleration - dynamics_.inverse_mass * sum(push_);
    body_.angular_momentum += t * dynamics_.torque - sum(impulse_ * lever_);
    if (angle_ == glm::dvec3{0.0}) return;
    turn_ = rotation_by(angle_);
    body_.orientation = unit_again(turn_ * body_.orientation);
}

void ConstantContact::correct(std::span<const HandSpring> springs,
                              std::span<SpringImpulse> work) const
{
    const TwoVectors hands = hand_ + gone_;
    const std::array<glm::dvec3, 2> hand{first(hands), second(hands)};
    const Two depth = depth_ + depth_change();
    for (std::size_t i = 0; i < springs.size(); ++i) {
        const HandSpring& spring = springs[i];
        const double above =
            glm::dot(turn_ * spring.normal, hand[i]) - // the face turns about the centre
            glm::dot(spring.normal, spring.arm);
        correct_energy({body_, dynamics_, dynamics_.inverse_inertia, tick_}, spring,
                       {depth[i], spring.radius - above}, work[i]);
    }
}

PressingSprings side_by_side(std::span<const HandSpring> springs)
{
    const HandSpring& a = springs.front();
    const HandSpring& b = springs.back();
    return {both(a.normal, b.normal),
            both(a.arm, b.arm),
            both(a.velocity, b.velocity),
            Two{a.radius, b.radius},
            Two{a.gap, b.gap},
            Two{a.stiffness, b.stiffness},
            Two{a.damping, b.damping},
            Two{a.force_max, b.force_max},
            springs.size() == 2};
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
    const PressingSprings pressing = side_by_side(springs);
    ConstantContact contact{body, dynamics, pressing, tick};
    if (!contact.advance(modes, std::numeric_limits<double>::infinity())) return false;
    const TwoVectors& push = contact.impulse();
    work[0].impulse = -first(push); // `advance` clears the work if the tick is refused
    if (pressing.are_two) work[1].impulse = -second(push);
    if (!contact.turns_negligibly()) contact.correct(springs, work);
    return true;
}

bool advance_in_constant_contact(MovingBody& body, const BodyDynamics& dynamics,
                                 const PressingSprings& springs, double tick, PressedModes& modes,
                                 TwoVectors& impulse)
{
    ConstantContact contact{body, dynamics, springs, tick};
    if (!contact.advance(modes, hardly_any_rotation)) return false;
    const TwoVectors& push = contact.impulse();
    impulse = {-push.x, -push.y, -push.z};
    return true;
}

} // namespace hapnet::scene
