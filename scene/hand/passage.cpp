// SPDX-FileCopyrightText: 2026 The Hapnet authors
// SPDX-License-Identifier: MIT
#include "scene/hand/passage.hpp"

#include "scene/hand/settle.hpp"
#include "scene/maths/rotation.hpp"

#include <algorithm>
#include <cmath>

namespace hapnet::scene {

namespace {

constexpr int phases_max = 64;          // of a tick
constexpr double part_min = 1.0 / 32.0; // of a tick, that is cut off only because something turns
// How far a normal may turn in half of what is held: then its mean is right to 1e-5.
constexpr double normal_turn_max = 0.01;

glm::dmat3 turned_inertia(const glm::dmat3& inverse_inertia, const glm::dvec3& angle)
{
    const glm::dmat3 turn = axes_of(rotation_by(angle));
    return turn * inverse_inertia * glm::transpose(turn);
}

bool is_zero(const glm::dmat3& m) { return m[0][0] == 0.0 && m[1][1] == 0.0 && m[2][2] == 0.0; }

} // namespace

void advance_freely(MovingBody& body, const Answer& answer, double tick)
{
    body.position += tick * (body.velocity + (0.5 * tick) * answer.acceleration);
    body.velocity += tick * answer.acceleration;
    if (is_zero(answer.inverse_inertia)) return;
    const glm::dvec3 mean = body.angular_momentum + (0.5 * tick) * answer.torque;
    glm::dvec3 angle = tick * (answer.inverse_inertia * mean);
    if (!answer.rotates_uniformly)
        angle = tick * (turned_inertia(answer.inverse_inertia, 0.5 * angle) * mean);
    body.orientation = rotated(body.orientation, angle);
    body.angular_momentum += tick * answer.torque;
}

template <std::size_t count>
Passage<count>::Passage(MovingBody& body, const Answer& answer, double tick)
    : body_{body},
      answer_{answer},
      tick_{tick},
      left_{tick},
      turns_{!is_zero(answer.inverse_inertia)},
      inverse_inertia_{answer.inverse_inertia},
      axes_{axes_of(body.orientation)}
{}

template <std::size_t count>
void Passage<count>::set(std::size_t i, const HandSpring& spring, SpringImpulse& work)
{
    springs_[i] = &spring;
    works_[i] = &work;
    surfaces_[i] = Surface{spring, answer_.half, axes_};
    hands_[i] = spring.arm + (spring.radius + spring.gap) * spring.normal;
    is_amid_face_[i] = surfaces_[i].is_amid_face(axes_, hands_[i]);
    Hold& hold = holds_[i];
    hold = {spring.normal, glm::cross(spring.arm, spring.normal), -spring.gap};
    Press& press = presses_[i];
    press.stiffness = spring.stiffness;
    press.damping = spring.damping;
    press.force_max = spring.force_max;
    press.depth = -spring.gap;
    press.closing = glm::dot(spring.normal, body_.velocity - spring.velocity) +
                    glm::dot(hold.lever, inverse_inertia_ * body_.angular_momentum);
    press.phase = press.due();
}

template <std::size_t count>
typename Passage<count>::Setting Passage<count>::halfway(double time) const
{
    const double half = 0.5 * time;
    glm::dvec3 force{0.0};
    glm::dvec3 torque = answer_.torque;
    for (std::size_t i = 0; i < count; ++i) {
        const double pushed = presses_[i].force();
        force -= pushed * holds_[i].normal;
        torque -= pushed * holds_[i].lever;
    }
    const glm::dvec3 moved =
        half *
        (body_.velocity + (0.5 * half) * (answer_.acceleration + answer_.inverse_mass * force));
    Setting setting{inverse_inertia_, holds_};
    glm::dvec3 angle{0.0};
    if (turns_) {
        angle = half * (inverse_inertia_ * (body_.angular_momentum + (0.5 * half) * torque));
        if (!answer_.rotates_uniformly)
            setting.inverse_inertia = turned_inertia(inverse_inertia_, angle);
    }
    const bool turns_little = glm::dot(angle, angle) <= normal_turn_max * normal_turn_max;
    for (std::size_t i = 0; i < count; ++i) {
        if (!turns_ && surfaces_[i].is_face()) continue;
        Hold& hold = setting.holds[i];
        const glm::dvec3 hand = hands_[i] + half * springs_[i]->velocity - moved;
        if (is_amid_face_[i] && turns_little) {
            // The face's normal turns with the body; by so little that two terms of the rotation
            // suffice for what is held.
            const glm::dvec3 once = glm::cross(angle, holds_[i].normal);
            hold.normal = holds_[i].normal + once + 0.5 * glm::cross(angle, once);
            hold.lever = glm::cross(hand, hold.normal);
        } else {
            hold = surfaces_[i].at(axes_of(rotation_by(angle) * body_.orientation), hand);
        }
        const glm::dvec3 change = hold.normal - holds_[i].normal;
        setting.rotated = std::max(setting.rotated, glm::dot(change, change));
    }
    return setting;
}

template <std::size_t count>
Coupling Passage<count>::couple(const Setting& setting)
{
    Coupling coupling;
    std::array<glm::dvec3, count> swung{};
    for (std::size_t i = 0; i < count; ++i) {
        const Hold& hold = setting.holds[i];
        Press& press = presses_[i];
        swung[i] = setting.inverse_inertia * hold.lever;
        coupling.own[i] = glm::dot(hold.normal, answer_.inverse_mass * hold.normal) +
                          glm::dot(hold.lever, swung[i]);
        press.closing = glm::dot(hold.normal, body_.velocity - springs_[i]->velocity) +
                        glm::dot(swung[i], body_.angular_momentum);
        press.acceleration =
            glm::dot(hold.normal, answer_.acceleration) + glm::dot(swung[i], answer_.torque);
    }
    if constexpr (count == 2)
        coupling.mutual =
            glm::dot(setting.holds[0].normal, answer_.inverse_mass * setting.holds[1].normal) +
            glm::dot(setting.holds[0].lever, swung[1]);
    return coupling;
}

template <std::size_t count>
bool Passage<count>::pass()
{
    for (int phase = 0; phase < phases_max && left_ > 0.0; ++phase) {
        double time = left_;
        double predicted = time; // what the setting is halfway of
        for (int attempt = 0;; ++attempt) {
            const Setting setting = halfway(predicted);
            const Coupling coupling = couple(setting);
            double shorter = time;
            if (setting.rotated > normal_turn_max * normal_turn_max)
                shorter = predicted * normal_turn_max / std::sqrt(setting.rotated);
            for (std::size_t i = 0; i < count && turns_; ++i) {
                const double square = coupling.own[i] * presses_[i].stiffness;
                if (presses_[i].phase == PressPhase::pressing && square * time * time > 1.0)
                    shorter = std::min(shorter, 1.0 / std::sqrt(square));
            }
            shorter = std::max(shorter, part_min * tick_);
            if (attempt < 3 && shorter < 0.99 * time) {
                time = predicted = shorter;
                continue;
            }
            auto presses = presses_;
            Presses<count> motion{presses, coupling, time};
            if (!motion.is_solved()) return false;
            const Pressed<count> pressed = motion.pass();
            if (attempt < 3 && pressed.time < 0.75 * predicted && turns_) {
                predicted = pressed.time;
                attempt = 3;
                continue;
            }
            std::array<bool, count> was_apart{};
            for (std::size_t i = 0; i < count; ++i)
                was_apart[i] = presses_[i].phase == PressPhase::apart;
            presses_ = presses;
            apply(setting, pressed);
            for (std::size_t i = 0; i < count; ++i) {
                if (was_apart[i]) meet(i);
            }
            break;
        }
    }
    if (left_ > 0.0) return false;
    settle();
    return true;
}

template <std::size_t count>
void Passage<count>::apply(const Setting& setting, const Pressed<count>& pressed)
{
    const double t = pressed.time;
    glm::dvec3 impulse{0.0};
    glm::dvec3 moment{0.0};
    glm::dvec3 twist{0.0};
    glm::dvec3 twist_moment{0.0};
    for (std::size_t i = 0; i < count; ++i) {
        const Hold& hold = setting.holds[i];
        impulse -= pressed.impulse[i] * hold.normal;
        moment -= pressed.moment[i] * hold.normal;
        twist -= pressed.impulse[i] * hold.lever;
        twist_moment -= pressed.moment[i] * hold.lever;
        works_[i]->impulse -= pressed.impulse[i] * hold.normal;
    }
    const glm::dvec3 moved =
        t * (body_.velocity + (0.5 * t) * answer_.acceleration) + answer_.inverse_mass * moment;
    body_.position += moved;
    body_.velocity += t * answer_.acceleration + answer_.inverse_mass * impulse;
    for (std::size_t i = 0; i < count; ++i) hands_[i] += t * springs_[i]->velocity - moved;
    if (turns_) {
        const glm::dvec3 swept =
            t * (body_.angular_momentum + (0.5 * t) * answer_.torque) + twist_moment;
        const glm::dvec3 angle = setting.inverse_inertia * swept;
        body_.angular_momentum += t * answer_.torque + twist;
        body_.orientation = rotated(body_.orientation, angle);
        axes_ = axes_of(body_.orientation);
        if (!answer_.rotates_uniformly) inverse_inertia_ = turned_inertia(inverse_inertia_, angle);
    }
    for (std::size_t i = 0; i < count; ++i) {
        if (!turns_ && surfaces_[i].is_face()) continue;
        const glm::dvec3 before = holds_[i].normal;
        holds_[i] = surfaces_[i].at(axes_, hands_[i]);
        const glm::dvec3 change = holds_[i].normal - before;
        turned_ = std::max(turned_, glm::dot(change, change));
    }
    left_ = t < left_ ? left_ - t : 0.0;
}

template <std::size_t count>
void Passage<count>::meet(std::size_t i)
{
    // A spring that was apart stores nothing: it does not begin a little before its depth is
    // reached, and when it begins a little late, that is settled in the end.
    Press& press = presses_[i];
    press.depth = holds_[i].depth;
    if (press.phase != PressPhase::pressing) return;
    constexpr double near = 1e-9;
    if (press.depth < -near * press.closing * tick_) press.phase = PressPhase::apart;
    press.depth = std::min(press.depth, 0.0);
}

template <std::size_t count>
std::array<HandSpring, count> Passage<count>::current() const
{
    std::array<HandSpring, count> springs;
    for (std::size_t i = 0; i < count; ++i) {
        HandSpring& spring = springs[i];
        spring = *springs_[i];
        spring.normal = holds_[i].normal;
        spring.gap = -presses_[i].depth;
        spring.arm = hands_[i] - (spring.radius + spring.gap) * spring.normal;
    }
    return springs;
}

template <std::size_t count>
void Passage<count>::settle()
{
    // Rounding alone is nothing to correct: a symmetric squeeze shall stay where it is.
    constexpr double unturned = 1e-10;
    if (turned_ < unturned * unturned) return;
    for (std::size_t i = 0; i < count; ++i) {
        if (presses_[i].phase == PressPhase::apart) continue;
        scene::settle({body_, answer_, inverse_inertia_, tick_}, *springs_[i],
                      {presses_[i].depth, holds_[i].depth}, *works_[i]);
    }
}

template class Passage<1>;
template class Passage<2>;

} // namespace hapnet::scene
