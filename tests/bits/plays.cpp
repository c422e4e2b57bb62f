// SPDX-FileCopyrightText: 2026 The Hapnet authors
// SPDX-License-Identifier: MIT
#include "tests/bits/plays.hpp"

#include "proto/base/ensure.hpp"
#include "proto/base/math.hpp"
#include "scene/text/text.hpp"
#include "scene/world.hpp"
#include "tests/support/scene/bench_scenes.hpp"

#include <array>

namespace hapnet::bits {

namespace {

constexpr std::array all{
    Play{"paper"},     Play{"push-6dof"},       Play{"stack-10"}, Play{"mass-ratio-1000"},
    Play{"cubes-100"}, Play{"stack-10", false}, Play{"conveyor"}, Play{"soft-and-hard"},
    Play{"guide"},     Play{"stick-slip"},      Play{"rolling"},  Play{"hammer"},
};

scene::World world_of(const Play& play)
{
    const base::OpenFile no_files = [](const std::string&) { return base::fail("no files"); };
    const auto built_in = scene::load_scene(std::string{play.scene}, no_files);
    const scene::Description description =
        built_in ? *built_in : test::bench_scene(std::string{play.scene});
    auto world = scene::World::freeze(description, {.sleeping = play.sleeping});
    base::ensure(world.has_value());
    return *std::move(world);
}

/// The place of a hand on a circle at a tick.
scene::HandInput on_circle(double radius, double period_s, std::uint64_t tick)
{
    const double turn = base::two_pi * static_cast<double>(tick) * 1e-3 / period_s;
    const double speed = base::two_pi * radius / period_s;
    const double c = base::cos(turn);
    const double s = base::sin(turn);
    return {.position = {{-0.03 + radius * c, 0.004 * s, radius * s}},
            .velocity = {{-speed * s, 0.004 * base::two_pi / period_s * c, speed * c}}};
}

void play_on(scene::World& world, std::uint64_t ticks)
{
    for (std::uint64_t i = 0; i < ticks; ++i) {
        const std::uint64_t now = world.ticks();
        auto left = on_circle(0.025, 1.7, now);
        auto right = on_circle(-0.045, 2.9, now);
        right.gripping = now % 4000 > 3500;
        if (now % 5000 == 4999) left.position.value.x = 0.5; // and back in the next tick
        base::ensure(!world.set_hand(0, left) && !world.set_hand(1, right));
        world.tick();
    }
}

} // namespace

std::span<const Play> plays() { return all; }

std::uint64_t hash_after(const Play& play, std::uint64_t ticks)
{
    scene::World world = world_of(play);
    play_on(world, ticks);
    return world.hash();
}

std::uint64_t hash_over_snapshots(const Play& play, std::uint64_t ticks, std::uint64_t every)
{
    std::array worlds{world_of(play), world_of(play)};
    std::size_t current = 0;
    for (std::uint64_t done = 0; done < ticks; done += every) {
        play_on(worlds[current], every);
        const std::size_t next = 1 - current;
        worlds[next].restore(worlds[current].snapshot());
        current = next;
    }
    return worlds[current].hash();
}

} // namespace hapnet::bits
