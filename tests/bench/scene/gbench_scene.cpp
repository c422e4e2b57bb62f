// SPDX-FileCopyrightText: 2026 The Hapnet authors
// SPDX-License-Identifier: MIT
//
// Parts of a tick, each timed alone, as a help for changes. The numbers hold for one machine and
// are no targets.
#include "scene/collide/box_box.hpp"
#include "scene/collide/sphere_box.hpp"
#include "scene/world.hpp"
#include "tests/bench/scene/crowd.hpp"

#include <benchmark/benchmark.h>
#include <cmath>
#include <tuple>

namespace hapnet::bench {

namespace {

scene::World frozen(const scene::Description& scene, const scene::FreezeOptions& options = {})
{
    return scene::World::freeze(scene, options).value();
}

/// The tick of a course, its hands moving.
void tick(benchmark::State& state, const Course& course, bool sleeping)
{
    scene::World world = frozen(course.scene, {.sleeping = sleeping});
    double time_s = 0.0;
    const auto step = [&] {
        for (std::uint32_t i = 0; course.hands && i < course.scene.hands.count; ++i) {
            std::ignore = world.set_hand(i, course.hands(i, time_s));
        }
        world.tick();
        time_s += 1e-3;
    };
    while (time_s < course.warm_up_s) step();
    for ([[maybe_unused]] auto _ : state) step();
    state.SetLabel(std::string{scene::name_of(world.stepper_kind())});
}

scene::OrientedBox box_at(const glm::dvec3& centre, double turn)
{
    const glm::dquat q{std::cos(turn), 0.6 * std::sin(turn), 0.0, 0.8 * std::sin(turn)};
    return {centre, glm::mat3_cast(q), glm::dvec3{0.02}};
}

void boxes(benchmark::State& state, double turn, double gap)
{
    const auto a = box_at(glm::dvec3{0.0}, 0.0), b = box_at({0.003, 0.04 + gap, 0.002}, turn);
    scene::BoxBoxMemory memory;
    for ([[maybe_unused]] auto _ : state)
        benchmark::DoNotOptimize(scene::collide(a, b, 1e-3, memory));
}

void spheres(benchmark::State& state)
{
    const auto box = box_at(glm::dvec3{0.0}, 0.2);
    const glm::dvec3 centre = box.axes * glm::dvec3{-0.024, 0.003, 0.002};
    scene::SphereBoxMemory memory;
    for ([[maybe_unused]] auto _ : state) benchmark::DoNotOptimize(memory.find(box, centre, 0.005));
}

void snapshot(benchmark::State& state)
{
    const auto world = frozen(pushed_crowd(static_cast<int>(state.range(0))).scene);
    for ([[maybe_unused]] auto _ : state) benchmark::DoNotOptimize(world.snapshot());
}

void restore(benchmark::State& state)
{
    auto world = frozen(pushed_crowd(static_cast<int>(state.range(0))).scene);
    const auto taken = world.snapshot();
    for ([[maybe_unused]] auto _ : state) {
        world.restore(taken);
        benchmark::ClobberMemory();
    }
}

void hash(benchmark::State& state)
{
    const auto world = frozen(pushed_crowd(static_cast<int>(state.range(0))).scene);
    for ([[maybe_unused]] auto _ : state) benchmark::DoNotOptimize(world.hash());
}

void register_ticks()
{
    using scene::Turning;
    const auto add = [](const char* name, Course course, bool sleeping) {
        benchmark::RegisterBenchmark(name, [course = std::move(course), sleeping](auto& state) {
            tick(state, course, sleeping);
        });
    };
    add("tick/tumbling", tumble().course, false);
    add("tick/1000_in_flight", flying_crowd(1000), false);
    add("tick/paper", paper_course(Turning::locked), false);
    Course dry = paper_course(Turning::free);
    dry.scene.bodies[0].turning = Turning::locked;
    add("tick/paper_dry_friction", dry, false);
    add("tick/paper_6dof", paper_course(Turning::free), false);
    add("tick/stack_of_ten", stack(1.0).course, false);
    add("tick/1_pushed_99_asleep", pushed_crowd(100), true);
    add("tick/1_pushed_9999_asleep", pushed_crowd(10000), true);
}

void register_parts()
{
    benchmark::RegisterBenchmark("box_box/faces", boxes, 0.0, -1e-4);
    benchmark::RegisterBenchmark("box_box/skew", boxes, 0.2, 4e-3);
    benchmark::RegisterBenchmark("box_box/apart", boxes, 0.2, 0.1);
    benchmark::RegisterBenchmark("sphere_box/face", spheres);
    benchmark::RegisterBenchmark("snapshot", snapshot)->Arg(1)->Arg(1000);
    benchmark::RegisterBenchmark("restore", restore)->Arg(1)->Arg(1000);
    benchmark::RegisterBenchmark("hash", hash)->Arg(1)->Arg(1000);
}

} // namespace

} // namespace hapnet::bench

int main(int argc, char** argv)
{
    hapnet::bench::register_ticks();
    hapnet::bench::register_parts();
    benchmark::Initialize(&argc, argv);
    benchmark::RunSpecifiedBenchmarks();
    return 0;
}
