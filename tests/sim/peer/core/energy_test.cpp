// SPDX-FileCopyrightText: 2026 The Hapnet authors
// SPDX-License-Identifier: MIT
// The energy that the other side can bring into a hand: honest tasks need less than the budget, and
// a forged remote cannot exceed it.
#include "peer/core/energy_budget.hpp"
#include "proto/wire/message.hpp"
#include "scene/text/text.hpp"
#include "tests/sim/peer/core/score.hpp"
#include "tests/support/seeds.hpp"
#include "tests/support/session/guarded_play.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <gtest/gtest.h>
#include <string>
#include <tuple>

namespace hapnet::sim {
namespace {

using namespace std::chrono_literals;
using device::Task;
using test::GuardedPlay;
using test::HandEnergy;
using test::play_guarded;

/// The largest power and energy that a hand gets at an Omni with an algorithm, honest or attacked.
/// The power is the mean over 5 ms.
struct Most {
    std::string_view algorithm;
    double power_w = 0.5;
    double work_j = 0.15;
};
/// The needs of honest sessions that exceed those.
constexpr std::array exceptions{
    Most{.algorithm = "dead-reckoning", .power_w = 1.1},
    Most{.algorithm = "sep", .power_w = 1.1},
    Most{.algorithm = "base-tdpa", .power_w = 0.52, .work_j = 0.201},
    Most{.algorithm = "wave", .power_w = 1.2},
    Most{.algorithm = "couple", .power_w = 0.7},
};
Most most_of(std::string_view algorithm)
{
    const auto* const found = std::ranges::find(exceptions, algorithm, &Most::algorithm);
    return found != exceptions.end() ? *found : Most{.algorithm = algorithm};
}

Setting playing(Task task, base::Duration delay, const peer::Algorithm& algorithm,
                std::size_t players = 2)
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
    setting.players.resize(players);
    for (auto& player : setting.players) player.algorithm = algorithm;
    return setting;
}

GuardedPlay played(Setting setting, bool limited)
{
    setting.energy_limit = limited;
    const GuardedPlay result = play_guarded(setting);
    EXPECT_EQ(result.guarded_hands, limited ? setting.players.size() : 0U);
    return result;
}

/// A part of the sessions of a task: one for each algorithm, or the others.
enum class Part : std::uint8_t { one_delay, other_delays };

class Honest : public testing::TestWithParam<std::tuple<Task, Part>> {
protected:
    static constexpr std::array<base::Duration, 3> delays{0ms, 80ms, 160ms};

    /// Successive tasks take successive delays, so that each algorithm meets all of them.
    static Part part_of(Task task, std::size_t algorithm, std::size_t delay)
    {
        const std::string_view name = peer::algorithm_names.at(algorithm);
        const bool is_one = test::is_sanitized
                                ? name == "base" && delays.at(delay) == 80ms // others take minutes
                                : (static_cast<std::size_t>(task) + algorithm + delay) % 3 == 0;
        return is_one ? Part::one_delay : Part::other_delays;
    }
};

TEST_P(Honest, HandsNeverNeedMoreThanTheBudgetAndKeepTheirBits)
{
    const auto [task, part] = GetParam();
    for (std::size_t algorithm = 0; algorithm < peer::algorithm_names.size(); ++algorithm) {
        const std::string_view name = peer::algorithm_names.at(algorithm);
        for (std::size_t i = 0; i < delays.size(); ++i) {
            if (part_of(task, algorithm, i) != part) continue;
            const base::Duration delay = delays.at(i);
            // Rollback plays past ticks again, which takes twenty times as long.
            if (name == "rollback" && delay != 160ms) continue;
            const Setting setting = playing(task, delay, peer::algorithm_named(name).value());
            if (!validate(setting)) continue; // bodies that turn, or friction, are not for all
            const GuardedPlay free = played(setting, false);
            const GuardedPlay guarded = played(setting, true);
            if (task == Task::t10) { // a hand that takes hold of what another still holds
                EXPECT_LE(guarded.limited, 200U) << delay.count(); // of 60 000
            } else {
                EXPECT_EQ(guarded.limited, 0U) << name << ' ' << delay.count();
                EXPECT_EQ(guarded.hash, free.hash) << name << ' ' << delay.count();
            }
            EXPECT_LT(guarded.work_5s_j, most_of(name).work_j) << name;
            EXPECT_LT(guarded.power_w, most_of(name).power_w) << name;
            if (testing::Test::HasFailure()) return;
        }
    }
}

std::string task_of(const testing::TestParamInfo<std::tuple<Task, Part>>& info)
{
    return std::string{name_of(std::get<Task>(info.param))};
}
INSTANTIATE_TEST_SUITE_P(Tasks, Honest,
                         testing::Combine(testing::ValuesIn(device::all_tasks),
                                          testing::Values(Part::one_delay)),
                         task_of);
INSTANTIATE_TEST_SUITE_P(All, Honest,
                         testing::Combine(testing::ValuesIn(device::all_tasks),
                                          testing::Values(Part::other_delays)),
                         task_of);

/// Scenes with several or rotating bodies, and in how many ticks the limit may act.
struct Turning {
    Task task;
    std::size_t players;
    std::uint64_t limited_max; // of 30 000 for each
};

class HonestHandsOn : public testing::TestWithParam<Turning> {};

TEST_P(HonestHandsOn, BodiesThatTurnGetNoMoreThanTheBudgetOfTwoOrThree)
{
    const auto [task, players, limited_max] = GetParam();
    for (const base::Duration delay : {0ms, 40ms, 160ms}) {
        if (test::is_sanitized && delay != 40ms) continue;
        SCOPED_TRACE("ms: " + std::to_string(delay / 1ms));
        const GuardedPlay guarded =
            played(playing(task, delay, peer::BaseAlgorithm{}, players), true);
        const std::string of = std::to_string(delay / 1ms);
        RecordProperty("limited_ticks_" + of, static_cast<int>(guarded.limited));
        RecordProperty("work_mj_" + of, static_cast<int>(std::lround(1e3 * guarded.work_5s_j)));
        EXPECT_LE(guarded.work_5s_j, most_of("base").work_j);
        EXPECT_LE(guarded.power_w, most_of("base").power_w);
        EXPECT_LE(guarded.limited, limited_max);
    }
}

// In T10 two hands hold a body with little drag, which swings up at 40 ms: 4640 ticks.
std::string turning_of(const testing::TestParamInfo<Turning>& info)
{
    return std::string{name_of(info.param.task)} + "Of" + std::to_string(info.param.players);
}
INSTANTIATE_TEST_SUITE_P(Tasks, HonestHandsOn,
                         testing::Values(Turning{Task::t8, 3, 0}, Turning{Task::t9, 2, 0},
                                         Turning{Task::t10, 2, 5000}),
                         turning_of);
INSTANTIATE_TEST_SUITE_P(All, HonestHandsOn,
                         testing::Values(Turning{Task::t8, 2, 0}, Turning{Task::t9, 3, 0},
                                         Turning{Task::t10, 3, 5000}),
                         turning_of);

TEST(EnergyBudget, OfAnAlgorithmFromASharedObjectIsThatOfBase)
{
    device::Capabilities omni;
    omni.force_max_n = 3.3;
    const auto unknown = peer::algorithm_named("shared-object").value();
    EXPECT_EQ(peer::energy_budget(omni, unknown), peer::energy_budget(omni, peer::BaseAlgorithm{}));
}

/// The direction in which a forged remote pushes the hand along x: 1 or -1.
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

/// A remote that puts the cube where the hand is 7 mm deep in it, on the side that pushes as
/// requested; or throws it to and fro in every tick.
struct Attack {
    const char* name;
    Push push; // nullptr: throws the cube
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
    state.sent = victim.stepped_at;
    state.touching = true;
    state.hip = hand.hip;
    state.contact_force = {{3.3 * push, 0.0, 0.0}};
    state.intention = {{0.02 * push, 0.0, 0.0}};
    wire::BodyState& body = state.bodies.add(wire::BodyState{});
    body.position = {{place, 0.0, 0.0}};
    body.velocity = {{hand.velocity.x(), 0.0, 0.0}};
    return state;
}

/// The victim's energy after an attack of 12 s.
struct Suffered {
    double work_5s_j = 0.0;
    double power_w = 0.0;
    std::uint64_t limited = 0;
};

Suffered suffered(const Attack& attack, Task task, bool limited,
                  std::string_view algorithm = "base")
{
    Setting setting = playing(task, 0ms, peer::algorithm_named(algorithm).value());
    setting.energy_limit = limited;
    World world{setting};
    run_until_started(world);
    world.run_for(1500ms);
    world.cut(0, 1, true); // from now on only the forged remote is heard
    Player& victim = world.side(0);
    auto sequence = static_cast<std::uint32_t>(victim.peer().counters().states) + 10;
    HandEnergy hand{victim};
    for (int tick = 0; tick < 12'000; ++tick) {
        wire::State state = forged(attack, victim, tick);
        state.sequence = ++sequence;
        victim.receive(0, wire::encode(state).bytes(), world.now());
        world.step();
        hand.add(victim, world.now());
    }
    EXPECT_GT(victim.peer().counters().states, 11'000U) << "the forged states are taken";
    return {hand.work_5s_j(), hand.power_w(), victim.rig.governor().counters().energy_limited};
}

class Attacked : public testing::TestWithParam<Attack> {};

TEST_P(Attacked, AHandGetsNoMoreThanTheBudget)
{
    const Most most = most_of("base");
    for (const Task task : {Task::p1, Task::t3, Task::t6}) {
        const Suffered guarded = suffered(GetParam(), task, true);
        EXPECT_LE(guarded.work_5s_j, most.work_j) << name_of(task);
        EXPECT_LE(guarded.power_w, most.power_w) << name_of(task);
    }
}

TEST_P(Attacked, AHandGetsNoMoreThanWhatTheAlgorithmNeeds)
{
    for (const std::string_view algorithm : peer::algorithm_names) {
        const Suffered guarded = suffered(GetParam(), Task::t3, true, algorithm);
        const Most most = most_of(algorithm);
        EXPECT_LE(guarded.work_5s_j, most.work_j) << algorithm;
        EXPECT_LE(guarded.power_w, most.power_w) << algorithm;
        const std::string of{algorithm};
        RecordProperty("work_mj_" + of, static_cast<int>(std::lround(1e3 * guarded.work_5s_j)));
        RecordProperty("power_mw_" + of, static_cast<int>(std::lround(1e3 * guarded.power_w)));
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
    const Most most = most_of("base");
    const Suffered in_step = suffered({"InPhase", in_phase}, Task::t3, false);
    EXPECT_GT(in_step.work_5s_j, 2.0 * most.work_j);
    EXPECT_GT(in_step.power_w, 1.7 * most.power_w);
    EXPECT_EQ(in_step.limited, 0U);
    const Suffered resonant = suffered({"Square5Hz", square_wave<5>}, Task::t3, false);
    EXPECT_GT(resonant.work_5s_j, 5.0 * most.work_j);
    const Suffered guarded = suffered({"InPhase", in_phase}, Task::t3, true);
    EXPECT_GT(guarded.limited, 1000U);
}

} // namespace
} // namespace hapnet::sim
