// SPDX-FileCopyrightText: 2026 The Hapnet authors
// SPDX-License-Identifier: MIT
#include "scene/hand/friction.hpp"

#include "proto/base/ensure.hpp"
#include "scene/hand/midpoint.hpp"
#include "scene/hand/passivity.hpp"
#include "scene/maths/vector.hpp"

#include <algorithm>
#include <array>
#include <glm/geometric.hpp>

namespace hapnet::scene {

namespace {

/// Returns the first time within [0, most] at which |start + rate t| reaches `limit`; else `most`.
double time_within(const glm::dvec3& start, const glm::dvec3& rate, double limit, double most)
{
    constexpr double rounding = 1e-12;
    const double room = limit * limit - glm::dot(start, start);
    if (room < -rounding * limit * limit) return 0.0;
    const double square = glm::dot(rate, rate);
    if (square == 0.0) return most;
    const double along = glm::dot(start, rate);
    const double root = std::sqrt(std::max(along * along + square * room, 0.0));
    // This form avoids cancellation.
    const double time = along > 0.0 ? room / (along + root) : (root - along) / square;
    return std::clamp(time, 0.0, most);
}

glm::dvec3 cut(const glm::dvec3& v, double most)
{
    const double size = length(v);
    return size > most ? (most / size) * v : v;
}

} // namespace

HandEnergy advance_with_friction(MovingBody& body, const BodyDynamics& dynamics,
                                 const FrictionContacts& contacts, double tick)
{
    const auto [springs, frictions, work] = contacts;
    base::ensure(work.size() >= springs.size() && frictions.size() >= springs.size());
    const MovingBody start = body;
    std::array<HandSpring, MidpointBudget::springs_max> pushes;
    for (std::size_t i = 0; i < springs.size(); ++i) {
        pushes[i] = springs[i];
        pushes[i].force_max = push_max(springs[i].force_max, frictions[i].limits);
        work[i] = {};
    }
    MidpointRule<true> rule{body, dynamics, {pushes.data(), springs.size()}, work};
    rule.set_friction(frictions);
    const std::size_t rows = rule.advance(tick);
    HandEnergy energy = keep_passive({start, body, dynamics, tick},
                                     {springs, frictions, work.first(springs.size())});
    energy.rows = rows;
    return energy;
}

glm::dvec3 rub_evenly(const Rub& rub, FrictionSpring& friction)
{
    const double push = rub.impulse / rub.tick;
    const glm::dvec3 start = rub.stiffness * friction.stretch + rub.damping * rub.velocity;
    const glm::dvec3 rate = rub.stiffness * rub.velocity;
    const double sticks = time_within(start, rate, friction.limit() * push, rub.tick);
    const glm::dvec3 stuck = sticks * (start + (0.5 * sticks) * rate);
    const glm::dvec3 wanted = friction.stretch + rub.tick * rub.velocity;
    friction.slides = sticks < rub.tick;
    if (!friction.slides) {
        friction.slid = glm::dvec3{0.0};
        return -stuck;
    }
    const double most = friction.limits.sliding * push;
    const glm::dvec3 end = cut(rub.stiffness * wanted, most);
    friction.slid = rub.stiffness > 0.0 ? wanted - end / rub.stiffness : wanted;
    // The direction goes from that of the pull at the slip to that of the pull at the end.
    const glm::dvec3 broke = start + sticks * rate;
    const glm::dvec3 drawn = rub.stiffness > 0.0 ? end : rub.damping * rub.velocity;
    const glm::dvec3 mean = cut(broke, most) + cut(drawn, most);
    const double size = length(mean);
    const glm::dvec3 along = size > 0.0 ? mean / size : glm::dvec3{0.0};
    return -(stuck + ((rub.tick - sticks) * most) * along);
}

} // namespace hapnet::scene
