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

template <typename Tick>
int spin(const scene::Description& description, long ticks)
{
    const scene::Frozen frozen{
        .planes = description.planes, .hips = description.hips, .gravity = description.gravity};
    scene::Stage stage{.bodies = scene::Bodies{description}};
    stage.pushes.resize(description.bodies.size());
    stage.is_pushed.resize(description.bodies.size());
    for (scene::HipInput& hip : stage.hips) hip.present = false;
    for (const std::uint32_t index : {0U, 1U}) stage.hips[index] = hapnet::cost::hand(index);
    Tick tick{description, frozen, stage};
    for (long left = ticks; left > 0; --left) tick.tick(frozen, stage);
    return 0;
}

} // namespace

int main(int argc, char** argv)
{
    if (argc != 3) return 2;
    const std::string_view profile = argv[1];
    const auto description = hapnet::cost::scene_for(profile);
    const long ticks = std::atol(argv[2]);
    if (profile == "sliding") return spin<scene::SlidingTick<false>>(description, ticks);
    if (profile == "sliding-coulomb") return spin<scene::SlidingTick<true>>(description, ticks);
    if (profile == "lone") return spin<scene::LoneTick>(description, ticks);
    if (profile == "few") return spin<scene::FewTick>(description, ticks);
    return 2;
}
