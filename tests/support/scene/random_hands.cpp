// SPDX-FileCopyrightText: 2026 The Hapnet authors
// SPDX-License-Identifier: MIT
#include "tests/support/scene/random_hands.hpp"

#include "proto/base/random.hpp"
#include "tests/support/scene/dice.hpp"

#include <algorithm>
#include <cmath>

namespace hapnet::test {

namespace {

using scene::BodyDescription;
using scene::Description;

/// A point of a body at its first place: on a face, an edge or a corner, or inside.
glm::dvec3 goal(Dice& dice, const Description& description)
{
    const BodyDescription& body = description.bodies[dice.below(description.bodies.size())];
    glm::dvec3 at = body.half * dice.vector();
    for (const int axis : {0, 1, 2}) {
        if (dice.one_in(2)) at[axis] = dice.one_in(2) ? body.half[axis] : -body.half[axis];
    }
    return body.position.value + body.orientation * at;
}

class Hand {
public:
    Hand(Dice& dice, const Description& description, double tick)
        : dice_{dice}, description_{description}, tick_{tick}
    {
        appear();
    }

    scene::HandInput next()
    {
        if (dice_.one_in(40)) appear();
        if (left_ == 0) set_out();
        --left_;
        if (dice_.one_in(15)) now_.gripping = !now_.gripping;
        now_.present = !dice_.one_in(50);
        const scene::HandInput given = now_;
        now_.position.value += tick_ * now_.velocity.value;
        return given;
    }

private:
    void appear()
    {
        const glm::dvec3 beside = 2.0 * description_.bodies[0].half.x * dice_.vector();
        now_.position.value = goal(dice_, description_) + beside;
        left_ = 0;
    }
    void set_out()
    {
        const glm::dvec3 way = goal(dice_, description_) - now_.position.value;
        const double length = std::sqrt(glm::dot(way, way));
        const double speed = dice_.one_in(20) ? 100.0 : dice_.power(0.01, 3.0);
        const double ticks = std::ceil(length / (speed * tick_));
        left_ = static_cast<std::uint32_t>(std::clamp(ticks, 1.0, 30.0));
        now_.velocity.value = length > 0.0 ? (speed / length) * way : glm::dvec3{0.0};
        if (dice_.one_in(10)) now_.velocity.value = glm::dvec3{0.0};
    }

    Dice& dice_;
    const Description& description_;
    double tick_;
    std::uint32_t left_ = 0;
    scene::HandInput now_;
};

scene::BodyState elsewhere(Dice& dice, const BodyDescription& body)
{
    const scene::MassFrame frame = frame_of_mass(body);
    scene::BodyState state{frame.centre, frame.orientation, body.velocity, body.angular_velocity};
    state.position.value += body.half * dice.vector();
    return state;
}

} // namespace

std::vector<TickInputs> random_inputs(std::uint64_t seed, const RandomPlay& play,
                                      std::uint32_t ticks)
{
    Dice dice{base::Seed{seed}.stream("inputs")};
    const Description& description = play.description;
    std::vector<TickInputs> inputs(ticks);
    if (dice.one_in(4)) return inputs;
    const double tick = base::to_seconds(play.options.tick);
    std::vector<Hand> hands;
    for (std::uint32_t i = 0; i < description.hands.count; ++i)
        hands.emplace_back(dice, description, tick);
    const bool meddles = dice.one_in(3);
    for (TickInputs& now : inputs) {
        for (Hand& hand : hands) now.hands.push_back(hand.next());
        if (!meddles || !dice.one_in(6)) continue;
        const auto body = static_cast<scene::BodyId>(dice.below(description.bodies.size()));
        const BodyDescription& form = description.bodies[body];
        if (!form.movable) continue;
        if (dice.one_in(4)) {
            now.places.emplace_back(body, elsewhere(dice, form));
        } else {
            const glm::dvec3 direction = dice.vector();
            now.pushes.emplace_back(body,
                                    base::Force{form.mass_kg * dice.power(0.1, 1e3) * direction});
        }
    }
    return inputs;
}

} // namespace hapnet::test
