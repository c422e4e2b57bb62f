// SPDX-FileCopyrightText: 2026 The Hapnet authors
// SPDX-License-Identifier: MIT
// The energy that the other side can bring into a hand: honest tasks need less than the budget, and
// a forged remote does not get beyond it.
#include "peer/core/energy_budget.hpp"
#include "proto/wire/message.hpp"
#include "scene/text/text.hpp"
#include "tests/sim/peer/core/score.hpp"
#include "tests/support/seeds.hpp"
#include "tests/support/session/work_of_5s.hpp"

#include <algorithm>
#include <cmath>
#include <gtest/gtest.h>
#include <string>

namespace hapnet::sim {
namespace {

using namespace std::chrono_literals;
using device::Task;

// The targets. The power is the mean of 5 ms.
constexpr double work_max_j = 0.15;
constexpr double power_max_w = 0.5;
constexpr double predicting_power_max_w = 1.4;

Setting playing(Task task, base::Duration delay, const peer::Algorithm& algorithm)
{
    emulator::Conditions conditions;
    if (delay > 0ms) conditions.delay = emulator::constant(delay);
    Setting setting = under(task, conditions);
    const auto scene = device::scene_of(task);
    if (scene != "paper") {
        setting.scene = scene::load_scene(std::string{scene}, [](const std::string& file) {
                            return base::fail(file);
                        }).value();
    }
    for (auto& player : setting.players) player.algorithm = algorithm;
    return setting;
}

/// The bits of all forces and bodies of a session, and how often its energy was limited.
struct Played {
    std::uint64_t hash = 0;
    std::uint64_t limited = 0;
    device::EnergyFigures most{};
};

Played played(Setting setting, bool limited)
{
    setting.energy_limit = limited;
    World world{setting};
    run_until_started(world);
    Hash hash;
    while (world.side(0).last().phase == peer::Phase::running) {
        world.step();
        for (const std::size_t i : {0U, 1U}) hash.add(world, i);
    }
    Played result{.hash = hash.value()};
    for (const std::size_t i : {0U, 1U}) {
        const device::Governor& governor = world.side(i).rig.governor();
        result.limited += governor.counters().energy_limited;
        const device::EnergyFigures* figures = governor.energy();
        EXPECT_EQ(figures != nullptr, limited);
        if (figures == nullptr) continue;
        result.most.work_5s_max_j = std::max(result.most.work_5s_max_j, figures->work_5s_max_j);
        result.most.power_max_w = std::max(result.most.power_max_w, figures->power_max_w);
    }
    return result;
}

class Honest : public testing::TestWithParam<Task> {};

TEST_P(Honest, HandsNeverNeedMoreThanTheBudgetAndKeepTheirBits)
{
    // Of these, base alone plays with bodies that turn, and several.
    const bool is_for_base = GetParam() >= Task::t8;
    for (const std::string name : {"base", "dead-reckoning", "sep"}) {
        if (is_for_base && name != "base") continue;
        for (const base::Duration delay : {0ms, 80ms, 160ms}) {
            if (test::is_sanitized && delay != 80ms) continue; // they take minutes
            const Setting setting = playing(GetParam(), delay, peer::algorithm_named(name).value());
            const Played free = played(setting, false);
            const Played guarded = played(setting, true);
            if (GetParam() == Task::t10) { // a hand that takes hold of what another still holds
                EXPECT_LE(guarded.limited, 200U) << delay.count(); // of 60 000
            } else {
                EXPECT_EQ(guarded.limited, 0U) << name << ' ' << delay.count();
                EXPECT_EQ(guarded.hash, free.hash) << name << ' ' << delay.count();
            }
            EXPECT_LT(guarded.most.work_5s_max_j, work_max_j);
            if (testing::Test::HasFailure()) return;
        }
    }
}

INSTANTIATE_TEST_SUITE_P(Tasks, Honest, testing::ValuesIn(device::all_tasks),
                         [](const auto& info) { return std::string{name_of(info.param)}; });

/// Which way a forged remote pushes the hand along x: 1 or -1.
using Push = double (*)(double seconds, const device::Sample& hand);

double one_way(double /*seconds*/, const device::Sample& /*hand*/) { return 1.0; }
double in_phase(double /*seconds*/, const device::Sample& hand)
{
    return hand.velocity.x() >= 0.0 ? 1.0 : -1.0;
}
template <int hertz>
double square_wave(double seconds, const device::Sample& /*hand*/)
{
    return std::fmod(seconds * hertz, 1.0) < 0.5 ? 1.0 : -1.0;
}

/// A remote that puts the cube where the hand is in it by 7 mm, on the side that pushes as asked;
/// or throws it to and fro in every tick.
struct Attack {
    const char* name;
    Push push; // nullptr: throws
};

wire::State forged(const Attack& attack, const Player& victim, int tick)
{
    constexpr double half_and_radius_m = 0.025;
    constexpr double depth_m = 0.007;
    const device::Sample& hand = victim.side->sample();
    double push = tick % 2 == 0 ? 1.0 : -1.0;
    double place = 0.1 * push;
    if (attack.push != nullptr) {
        push = attack.push(1e-3 * tick, hand);
        place = hand.hip.x() - push * (half_and_radius_m - depth_m);
    }
    wire::State state;
    state.session = victim.side->peer().session()->number;
    state.touching = true;
    state.hip = hand.hip;
    state.contact_force = {{3.3 * push, 0.0, 0.0}};
    wire::BodyState& body = state.bodies.add(wire::BodyState{});
    body.position = {{place, 0.0, 0.0}};
    body.velocity = {{hand.velocity.x(), 0.0, 0.0}};
    return state;
}

/// The victim's energy after 12 s of it.
struct Suffered {
    double work_5s_j = 0.0;
    double power_w = 0.0;
    std::uint64_t limited = 0;
};

Suffered suffered(const Attack& attack, Task task, bool limited, const char* algorithm = "base")
{
    Setting setting = playing(task, 0ms, peer::algorithm_named(algorithm).value());
    setting.energy_limit = limited;
    World world{setting};
    run_until_started(world);
    world.run_for(1500ms);
    world.cut(0, 1, true); // from now on only the forged remote is heard
    Player& victim = world.side(0);
    auto sequence = static_cast<std::uint32_t>(victim.peer().counters().states) + 10;
    // Apart from the governor's own figures.
    test::WorkOf5s work;
    device::EnergyGuard observer{{}, 1ms};
    base::Position before = victim.side->sample().hip;
    for (int tick = 0; tick < 12'000; ++tick) {
        wire::State state = forged(attack, victim, tick);
        state.sequence = ++sequence;
        state.sent = world.now();
        victim.receive(0, wire::encode(state).bytes(), world.now());
        const base::Force held = victim.told();
        world.step();
        const base::Position hip = victim.side->sample().hip;
        observer.pass(held, hip, 1ms);
        const base::Displacement moved = hip - before;
        before = hip;
        work.add(held.x() * moved.x() + held.y() * moved.y() + held.z() * moved.z(), world.now());
    }
    EXPECT_GT(victim.peer().counters().states, 11'000U) << "the forged states are taken";
    return {work.most_j(), observer.figures().power_max_w,
            victim.rig.governor().counters().energy_limited};
}

class Attacked : public testing::TestWithParam<Attack> {};

TEST_P(Attacked, AHandGetsNoMoreThanTheBudget)
{
    for (const Task task : {Task::p1, Task::t3, Task::t6}) {
        const Suffered guarded = suffered(GetParam(), task, true);
        EXPECT_LE(guarded.work_5s_j, work_max_j) << name_of(task);
        EXPECT_LE(guarded.power_w, power_max_w) << name_of(task);
    }
}

TEST_P(Attacked, AHandGetsNoMoreThanWhatAPredictingAlgorithmNeeds)
{
    for (const char* algorithm : {"dead-reckoning", "sep"}) {
        const Suffered guarded = suffered(GetParam(), Task::t3, true, algorithm);
        EXPECT_LE(guarded.work_5s_j, work_max_j) << algorithm;
        EXPECT_LE(guarded.power_w, predicting_power_max_w) << algorithm;
    }
}

INSTANTIATE_TEST_SUITE_P(
    Forged, Attacked,
    testing::Values(Attack{"OneWay", one_way}, Attack{"InPhase", in_phase},
                    Attack{"Square3Hz", square_wave<3>}, Attack{"Square5Hz", square_wave<5>},
                    Attack{"Square10Hz", square_wave<10>}, Attack{"Square40Hz", square_wave<40>},
                    Attack{"Square75Hz", square_wave<75>}, Attack{"Square250Hz", square_wave<250>},
                    Attack{"Thrown", nullptr}),
    [](const auto& info) { return std::string{info.param.name}; });

TEST(Energy, OfAForgedRemoteIsFarBeyondTheBudgetWhereItIsNotLimited)
{
    const Suffered in_step = suffered({"InPhase", in_phase}, Task::t3, false);
    EXPECT_GT(in_step.work_5s_j, 2.0 * work_max_j);
    EXPECT_GT(in_step.power_w, 1.7 * power_max_w);
    EXPECT_EQ(in_step.limited, 0U);
    const Suffered resonant = suffered({"Square5Hz", square_wave<5>}, Task::t3, false);
    EXPECT_GT(resonant.work_5s_j, 5.0 * work_max_j);
    const Suffered guarded = suffered({"InPhase", in_phase}, Task::t3, true);
    EXPECT_GT(guarded.limited, 1000U);
}

} // namespace
} // namespace hapnet::sim
