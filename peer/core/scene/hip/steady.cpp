// SPDX-FileCopyrightText: 2026 The Hapnet authors
// SPDX-License-Identifier: MIT
#include "peer/core/scene/hip/steady.hpp"

#include "peer/core/scene/hip/settle.hpp"
#include "peer/core/scene/motion/per_axis.hpp"
#include "peer/core/scene/motion/rotation.hpp"

#include <array>
#include <cmath>
#include <glm/geometric.hpp>

namespace hapnet::scene {

namespace {

// How far a normal may turn in half a tick: then its mean is right to 1e-5.
constexpr double turn_max = 0.01;
// What turns less than this has kept its directions, to rounding.
constexpr double unturned = 1e-10;
// A hand this far from the middle of a face, in half edges, does not leave it soon.
constexpr double amid = 0.9;

constexpr std::size_t terms_max = 24;
constexpr std::array<double, terms_max> shares = [] {
    std::array<double, terms_max> r{};
    for (std::size_t n = 0; n < terms_max; ++n)
        r[n] = 1.0 / (static_cast<double>(n + 1) * static_cast<double>(n + 2));
    return r;
}();

/// One spring and the face that it presses.
struct Contact {
    std::size_t axis = 0; // of the face
    double side = 1.0;
    glm::dvec3 hand;   // seen from the body's centre, at the start
    glm::dvec3 normal; // at the start, then halfway
    glm::dvec3 lever;
    glm::dvec3 swung; // the inverse inertia times the lever
    double depth = 0.0;
    double closing = 0.0;
    double acceleration = 0.0; // of the depth, by everything but the springs
    double after = 0.0;        // the depth at the end
};

/// The face, when the hand is amid one and presses it.
bool find_face(Contact& contact, const HipSpring& spring, const glm::dvec3& half,
               const glm::dmat3& axes)
{
    if (spring.holds || !(spring.stiffness > 0.0) || spring.gap > 0.0) return false;
    contact.hand = spring.arm + (spring.radius + spring.gap) * spring.normal;
    const PerAxis normal{glm::dot(axes[0], spring.normal), glm::dot(axes[1], spring.normal),
                         glm::dot(axes[2], spring.normal)};
    const PerAxis off{std::abs(glm::dot(axes[0], contact.hand)) - amid * half.x,
                      std::abs(glm::dot(axes[1], contact.hand)) - amid * half.y,
                      std::abs(glm::dot(axes[2], contact.hand)) - amid * half.z};
    const PerAxis size{std::abs(normal[0]), std::abs(normal[1]), std::abs(normal[2])};
    constexpr double rounding = 1e-9;
    const std::size_t axis = size[0] > 0.5 ? 0 : size[1] > 0.5 ? 1 : 2;
    const std::size_t u = axis == 0 ? 1 : 0;
    const std::size_t v = axis == 2 ? 1 : 2;
    contact.axis = axis;
    contact.side = normal[axis] < 0.0 ? -1.0 : 1.0;
    contact.normal = spring.normal;
    contact.lever = glm::cross(spring.arm, spring.normal);
    contact.depth = -spring.gap;
    return size[u] + size[v] <= rounding && off[u] <= 0.0 && off[v] <= 0.0;
}

/// What the springs do in the tick.
template <std::size_t count>
struct Pressed {
    std::array<double, count> impulse{}; // of the force, N s
    std::array<double, count> moment{};  // the integral of the impulse, N s^2
};

template <std::size_t count>
class Steady {
public:
    Steady(MovingBody& body, const Answer& answer, const HipSpring* springs, double tick)
        : body_{body}, answer_{answer}, springs_{springs}, tick_{tick}
    {}

    /// False: it is not steady.
    bool pass(HipWork* work);

private:
    bool begin();
    bool turn_halfway();
    void couple();
    bool press();
    bool finish(HipWork* work);

    MovingBody& body_;
    const Answer& answer_;
    const HipSpring* springs_;
    double tick_;
    glm::dmat3 axes_{};
    std::array<Contact, count> contacts_;
    std::array<double, count> own_{}; // 1/kg
    double mutual_ = 0.0;
    Pressed<count> pressed_;
};

template <std::size_t count>
bool Steady<count>::begin()
{
    axes_ = axes_of(body_.orientation);
    for (std::size_t i = 0; i < count; ++i) {
        if (!find_face(contacts_[i], springs_[i], answer_.half, axes_)) return false;
    }
    return true;
}

/// Turns what is held to where it is halfway.
template <std::size_t count>
bool Steady<count>::turn_halfway()
{
    const double half = 0.5 * tick_;
    const glm::dvec3 spin = answer_.inverse_inertia * body_.angular_momentum;
    glm::dvec3 force{0.0};
    glm::dvec3 torque = answer_.torque;
    for (std::size_t i = 0; i < count; ++i) {
        const Contact& contact = contacts_[i];
        const HipSpring& spring = springs_[i];
        const double closing = glm::dot(contact.normal, body_.velocity - spring.velocity) +
                               glm::dot(contact.lever, spin);
        const double pushed = spring.stiffness * contact.depth + spring.damping * closing;
        force -= pushed * contact.normal;
        torque -= pushed * contact.lever;
    }
    const glm::dvec3 moved =
        half *
        (body_.velocity + (0.5 * half) * (answer_.acceleration + answer_.inverse_mass * force));
    const glm::dvec3 angle = half * (spin + (0.5 * half) * (answer_.inverse_inertia * torque));
    if (!(glm::dot(angle, angle) <= turn_max * turn_max)) return false;
    for (std::size_t i = 0; i < count; ++i) {
        Contact& contact = contacts_[i];
        const glm::dvec3 hand = contact.hand + half * springs_[i].velocity - moved;
        const glm::dvec3 once = glm::cross(angle, contact.normal);
        contact.normal += once + 0.5 * glm::cross(angle, once);
        contact.lever = glm::cross(hand, contact.normal);
    }
    return true;
}

template <std::size_t count>
void Steady<count>::couple()
{
    for (std::size_t i = 0; i < count; ++i) {
        Contact& contact = contacts_[i];
        contact.swung = answer_.inverse_inertia * contact.lever;
        own_[i] = glm::dot(contact.normal, answer_.inverse_mass * contact.normal) +
                  glm::dot(contact.lever, contact.swung);
        contact.closing = glm::dot(contact.normal, body_.velocity - springs_[i].velocity) +
                          glm::dot(contact.swung, body_.angular_momentum);
        contact.acceleration = glm::dot(contact.normal, answer_.acceleration) +
                               glm::dot(contact.swung, answer_.torque);
    }
    if constexpr (count == 2) {
        mutual_ = glm::dot(contacts_[0].normal, answer_.inverse_mass * contacts_[1].normal) +
                  glm::dot(contacts_[0].lever, contacts_[1].swung);
    }
}

/// Depths are d'' = acceleration - coupling * force and forces stiffness d + damping d': with
/// d_n = d^(n)(0) tick^n / n! and f_n likewise, d_(n+2) = -tick^2 coupling f_n / ((n+1) (n+2)), and
/// the integrals of the force are the sums of f_n / (n+1) and of f_n / ((n+1) (n+2)). The sum of
/// all |f_n| but the first is the most that the force can change. False when the force may end
/// or reach its greatest, or the tick is long for the springs.
template <std::size_t count>
bool Steady<count>::press()
{
    using Each = std::array<double, count>;
    const double square = tick_ * tick_;
    Each depth, next, stiffness, damping, first;
    Each once{}, twice{}, change{};
    for (std::size_t i = 0; i < count; ++i) {
        const Contact& contact = contacts_[i];
        depth[i] = contact.depth;
        next[i] = tick_ * contact.closing;
        stiffness[i] = springs_[i].stiffness;
        damping[i] = springs_[i].damping / tick_;
        constexpr double slow = 0.5;
        if (!(square * own_[i] * (stiffness[i] + damping[i]) <= slow)) return false;
        first[i] = stiffness[i] * depth[i] + damping[i] * next[i];
    }
    Each force = first;
    for (std::size_t n = 0;; ++n) {
        if (n + 1 == terms_max) return false;
        Each part;
        for (std::size_t i = 0; i < count; ++i) {
            part[i] = shares[n] * force[i];
            twice[i] += part[i];
            once[i] += part[i] * static_cast<double>(n + 2);
        }
        Each then;
        for (std::size_t i = 0; i < count; ++i) {
            double pushed = own_[i] * part[i];
            if constexpr (count == 2) pushed += mutual_ * part[1 - i];
            then[i] = -square * pushed;
            if (n == 0) then[i] += 0.5 * square * contacts_[i].acceleration;
        }
        bool is_done = n > 0;
        for (std::size_t i = 0; i < count; ++i) {
            depth[i] = next[i];
            next[i] = then[i];
            const double now =
                stiffness[i] * depth[i] + static_cast<double>(n + 2) * damping[i] * next[i];
            constexpr double rounding = 1e-18;
            is_done = is_done && std::abs(force[i]) + std::abs(now) <= rounding * first[i];
            force[i] = now;
            change[i] += std::abs(now);
        }
        if (is_done) break;
    }
    for (std::size_t i = 0; i < count; ++i) {
        if (!(first[i] - change[i] > 0.0 && first[i] + change[i] < springs_[i].force_max))
            return false;
        pressed_.impulse[i] = tick_ * once[i];
        pressed_.moment[i] = square * twice[i];
    }
    for (std::size_t i = 0; i < count; ++i) {
        Contact& contact = contacts_[i];
        double pushed = own_[i] * pressed_.moment[i];
        if constexpr (count == 2) pushed += mutual_ * pressed_.moment[1 - i];
        contact.after = contact.depth + tick_ * contact.closing +
                        (0.5 * square) * contact.acceleration - pushed;
    }
    return true;
}

template <std::size_t count>
bool Steady<count>::finish(HipWork* work)
{
    const double t = tick_;
    glm::dvec3 impulse{0.0};
    glm::dvec3 moment{0.0};
    glm::dvec3 twist{0.0};
    glm::dvec3 twist_moment{0.0};
    for (std::size_t i = 0; i < count; ++i) {
        const Contact& contact = contacts_[i];
        impulse -= pressed_.impulse[i] * contact.normal;
        moment -= pressed_.moment[i] * contact.normal;
        twist -= pressed_.impulse[i] * contact.lever;
        twist_moment -= pressed_.moment[i] * contact.lever;
    }
    const glm::dvec3 moved =
        t * (body_.velocity + (0.5 * t) * answer_.acceleration) + answer_.inverse_mass * moment;
    const glm::dvec3 swept =
        t * (body_.angular_momentum + (0.5 * t) * answer_.torque) + twist_moment;
    const glm::dvec3 angle = answer_.inverse_inertia * swept;
    const bool has_turned = glm::dot(angle, angle) >= unturned * unturned;
    const glm::dquat orientation =
        angle == glm::dvec3{0.0} ? body_.orientation : turned(body_.orientation, angle);
    if (has_turned) {
        // Where the hands are in the end on the faces that have turned.
        axes_ = axes_of(orientation);
        for (std::size_t i = 0; i < count; ++i) {
            Contact& contact = contacts_[i];
            const glm::dvec3 hand = contact.hand + t * springs_[i].velocity - moved;
            const PerAxis place{glm::dot(axes_[0], hand), glm::dot(axes_[1], hand),
                                glm::dot(axes_[2], hand)};
            const PerAxis half = per_axis(answer_.half);
            for (std::size_t axis = 0; axis < 3; ++axis) {
                if (axis != contact.axis && std::abs(place[axis]) > half[axis]) return false;
            }
            contact.depth =
                springs_[i].radius + half[contact.axis] - contact.side * place[contact.axis];
        }
    }
    body_.position += moved;
    body_.velocity += t * answer_.acceleration + answer_.inverse_mass * impulse;
    body_.angular_momentum += t * answer_.torque + twist;
    body_.orientation = orientation;
    for (std::size_t i = 0; i < count; ++i)
        work[i].impulse = -pressed_.impulse[i] * contacts_[i].normal;
    if (!has_turned) return true;
    for (std::size_t i = 0; i < count; ++i) {
        settle({body_, answer_, answer_.inverse_inertia, tick_}, springs_[i],
               {contacts_[i].after, contacts_[i].depth}, work[i]);
    }
    return true;
}

template <std::size_t count>
bool Steady<count>::pass(HipWork* work)
{
    if (!begin() || !turn_halfway()) return false;
    couple();
    return press() && finish(work);
}

} // namespace

bool press_steadily(MovingBody& body, const Answer& answer, std::span<const HipSpring> springs,
                    std::span<HipWork> work, double tick)
{
    if (!answer.turns_evenly) return false;
    if (springs.size() == 1) return Steady<1>{body, answer, springs.data(), tick}.pass(work.data());
    if (springs.size() == 2) return Steady<2>{body, answer, springs.data(), tick}.pass(work.data());
    return false;
}

} // namespace hapnet::scene
