// SPDX-FileCopyrightText: 2026 The Hapnet authors
// SPDX-License-Identifier: MIT
//
// spin_alone PROFILE TICKS: one tick called directly; nothing chooses, nothing else is there.
#include "scene/one_box/step.hpp"
#include "scene/rigid/step.hpp"
#include "tests/cost/spin.hpp"

#include <cstdlib>

namespace {

namespace scene = hapnet::scene;

template <typename Stepper>
int spin(const scene::Description& description, long ticks)
{
    const scene::WorldConfig config{
        .planes = description.planes, .hands = description.hands, .gravity = description.gravity};
    scene::WorldState state{.bodies = scene::Bodies{description}};
    state.pushes.resize(description.bodies.size());
    state.torques.resize(description.bodies.size());
    state.is_pushed.resize(description.bodies.size());
    for (scene::HandInput& hand : state.hands) hand.present = false;
    for (const std::uint32_t index : {0U, 1U}) state.hands[index] = hapnet::cost::hand(index);
    Stepper stepper{description, config, state};
    for (long left = ticks; left > 0; --left) stepper.step(config, state);
    return 0;
}

} // namespace

int main(int argc, char** argv)
{
    if (argc != 3) return 2;
    const std::string_view kind = argv[1];
    const auto description = hapnet::cost::scene_for(kind);
    const long ticks = std::atol(argv[2]);
    if (kind == "sliding") return spin<scene::OneBoxStepper<false>>(description, ticks);
    if (kind == "sliding-coulomb") return spin<scene::OneBoxStepper<true>>(description, ticks);
    if (kind == "lone")
        return spin<scene::RigidStepper<scene::BroadPhase::none>>(description, ticks);
    if (kind == "few")
        return spin<scene::RigidStepper<scene::BroadPhase::all_pairs>>(description, ticks);
    return 2;
}
