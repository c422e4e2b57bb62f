// SPDX-FileCopyrightText: 2026 The Hapnet authors
// SPDX-License-Identifier: MIT
#include "scene/hand/constant_contact.hpp"

#include "scene/hand/surface.hpp"
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

/// One spring and the face that it presses. Set before it is read.
// NOLINTNEXTLINE(cppcoreguidelines-pro-type-member-init)
struct Contact {
    glm::dvec3 hand; // seen from the body's centre, at the start
    glm::dvec3 away; // the body's velocity over the hand's, at the start
    glm::dvec3 normal;
    glm::dvec3 lever;
    double own = 0.0; // 1/kg
    double depth = 0.0;
    double closing = 0.0;
    double acceleration = 0.0; // of the depth, by everything but the springs
    double impulse = 0.0;      // of the force, N s
    double moment = 0.0;       // the integral of the impulse, N s^2
};

template <std::size_t count>
class ConstantContact {
public:
    ConstantContact(MovingBody& body, const BodyDynamics& dynamics, const HandSpring* springs,
                    double tick)
        : body_{body},
          dynamics_{dynamics},
          springs_{springs},
          tick_{tick},
          ease_{diagonal_of(dynamics.inverse_inertia)}
    {}

    /// False: it is not steady.
    bool advance(SpringImpulse* work, PressedModes& modes)
    {
        if (!set_geometry_halfway()) return false;
        set_couplings();
        return integrate_contacts(modes) && finish(work);
    }

private:
    bool set_geometry_halfway();
    void set_couplings();
    bool integrate_contacts(PressedModes& modes);
    bool finish(SpringImpulse* work);
    [[nodiscard]] double depth_change(std::size_t i) const;

    MovingBody& body_;
    const BodyDynamics& dynamics_;
    const HandSpring* springs_;
    double tick_;
    glm::dvec3 ease_; // 1/(kg m^2), about each axis
    std::array<Contact, count> contacts_;
    double mutual_ = 0.0; // 1/kg
};

/// Turns what is held to where it is halfway at the speeds of the start: what the forces change
/// until then is of second order, and where they are in balance nothing.
template <std::size_t count>
bool ConstantContact<count>::set_geometry_halfway()
{
    const double half = 0.5 * tick_;
    const glm::dvec3 angle = half * (ease_ * body_.angular_momentum);
    const double most = sum_of_sizes(angle);
    if (!(most <= half_rotation_max)) return false;
    const bool turns = most > no_rotation;
    for (std::size_t i = 0; i < count; ++i) {
        const HandSpring& spring = springs_[i];
        Contact& contact = contacts_[i];
        contact.hand = spring.arm + (spring.radius + spring.gap) * spring.normal;
        contact.away = body_.velocity - spring.velocity;
        contact.normal = spring.normal;
        if (turns) {
            const glm::dvec3 once = glm::cross(angle, spring.normal);
            contact.normal += once + 0.5 * glm::cross(angle, once);
        }
        contact.lever = glm::cross(contact.hand - half * contact.away, contact.normal);
    }
    return true;
}

template <std::size_t count>
void ConstantContact<count>::set_couplings()
{
    const glm::dvec3& light = dynamics_.inverse_mass;
    for (std::size_t i = 0; i < count; ++i) {
        Contact& contact = contacts_[i];
        const glm::dvec3& normal = contact.normal;
        const glm::dvec3 inverse_inertia_lever = ease_ * contact.lever;
        contact.own =
            glm::dot(normal, light * normal) + glm::dot(contact.lever, inverse_inertia_lever);
        contact.depth = -springs_[i].gap;
        contact.closing = glm::dot(normal, contact.away) +
                          glm::dot(inverse_inertia_lever, body_.angular_momentum);
        contact.acceleration = glm::dot(normal, dynamics_.acceleration) +
                               glm::dot(inverse_inertia_lever, dynamics_.torque);
        if constexpr (count == 2) {
            if (i == 1) {
                mutual_ = glm::dot(contacts_[0].normal, light * normal) +
                          glm::dot(contacts_[0].lever, inverse_inertia_lever);
            }
        }
    }
}

/// False when a force may end or reach its greatest, or the tick is long for the springs.
template <std::size_t count>
bool ConstantContact<count>::integrate_contacts(PressedModes& modes)
{
    const HandSpring& spring = springs_[0];
    PressedModes::Key key{.own = {contacts_[0].own, 0.0},
                          .mutual = mutual_,
                          .stiffness = spring.stiffness,
                          .damping = spring.damping,
                          .tick = tick_};
    if constexpr (count == 2) key.own[1] = contacts_[1].own;
    if (!modes.find(key)) return false;
    PressedModes::Start start{};
    for (std::size_t i = 0; i < count; ++i) {
        const Contact& contact = contacts_[i];
        start.depth[i] = contact.depth;
        start.speed[i] = contact.closing;
        start.acceleration[i] = contact.acceleration;
    }
    const PressedModes::Outcome outcome = modes.outcome(start);
    for (std::size_t i = 0; i < count; ++i) {
        Contact& contact = contacts_[i];
        const double first = spring.stiffness * contact.depth + spring.damping * contact.closing;
        const double change = outcome.change[i];
        if (!(first > change && first + change < springs_[i].force_max)) return false;
        contact.impulse = outcome.impulse[i];
        contact.moment = outcome.moment[i];
    }
    return true;
}

/// By how much a depth has grown, by what was held.
template <std::size_t count>
double ConstantContact<count>::depth_change(std::size_t i) const
{
    const Contact& contact = contacts_[i];
    double pushed = contact.own * contact.moment;
    if constexpr (count == 2) pushed += mutual_ * contacts_[1 - i].moment;
    return tick_ * (contact.closing + (0.5 * tick_) * contact.acceleration) - pushed;
}

template <std::size_t count>
bool ConstantContact<count>::finish(SpringImpulse* work)
{
    const double t = tick_;
    glm::dvec3 impulse{0.0};
    glm::dvec3 moment{0.0};
    glm::dvec3 twist = t * dynamics_.torque;
    glm::dvec3 swept = t * (body_.angular_momentum + (0.5 * t) * dynamics_.torque);
    for (std::size_t i = 0; i < count; ++i) {
        const Contact& contact = contacts_[i];
        work[i].impulse = -contact.impulse * contact.normal; // `advance` clears what is refused
        impulse += work[i].impulse;
        moment -= contact.moment * contact.normal;
        twist -= contact.impulse * contact.lever;
        swept -= contact.moment * contact.lever;
    }
    const glm::dvec3 moved =
        t * (body_.velocity + (0.5 * t) * dynamics_.acceleration) + dynamics_.inverse_mass * moment;
    const glm::dvec3 angle = ease_ * swept;
    // From amid a face to beside it is a tenth of a half edge at least.
    const glm::dvec3& size = dynamics_.half;
    const double room = 0.1 * std::min(size.x, std::min(size.y, size.z));
    const double corner = (size.x + size.y + size.z) * sum_of_sizes(angle);
    for (std::size_t i = 0; i < count; ++i) {
        if (!(sum_of_sizes(t * springs_[i].velocity - moved) + corner <= room)) return false;
    }
    body_.position += moved;
    body_.velocity += t * dynamics_.acceleration + dynamics_.inverse_mass * impulse;
    body_.angular_momentum += twist;
    if (angle == glm::dvec3{0.0}) return true;
    const glm::dquat turn = rotation_by(angle);
    body_.orientation = unit_again(turn * body_.orientation);
    if (glm::dot(angle, angle) < negligible_rotation * negligible_rotation) return true;
    for (std::size_t i = 0; i < count; ++i) {
        const HandSpring& spring = springs_[i];
        const Contact& contact = contacts_[i];
        const glm::dvec3 hand = contact.hand + t * spring.velocity - moved;
        const double above =
            glm::dot(turn * spring.normal, hand) - // the face turns about the centre
            glm::dot(spring.normal, spring.arm);
        correct_energy({body_, dynamics_, dynamics_.inverse_inertia, t}, spring,
                       {contact.depth + depth_change(i), spring.radius - above}, work[i]);
    }
    return true;
}

} // namespace

bool advance_in_constant_contact(MovingBody& body, const BodyDynamics& dynamics,
                                 std::span<const HandSpring> springs, std::span<SpringImpulse> work,
                                 double tick, PressedModes& modes)
{
    if (!dynamics.rotates_uniformly) return false;
    for (const HandSpring& spring : springs) {
        if (!spring.is_amid_face || spring.gap > 0.0 || !(spring.stiffness > 0.0)) return false;
    }
    if (springs.size() == 1)
        return ConstantContact<1>{body, dynamics, springs.data(), tick}.advance(work.data(), modes);
    if (springs.size() != 2 || springs[0].stiffness != springs[1].stiffness ||
        springs[0].damping != springs[1].damping)
        return false;
    return ConstantContact<2>{body, dynamics, springs.data(), tick}.advance(work.data(), modes);
}

} // namespace hapnet::scene
