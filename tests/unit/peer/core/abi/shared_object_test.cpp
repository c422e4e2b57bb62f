// SPDX-FileCopyrightText: 2026 The Hapnet authors
// SPDX-License-Identifier: MIT
#include "peer/core/abi/shared_object.hpp"

#include "peer/core/sync/algorithm.hpp"
#include "peer/core/sync/text.hpp"

#include <array>
#include <cmath>
#include <cstring>
#include <gtest/gtest.h>
#include <limits>
#include <string_view>
#include <tuple>

namespace hapnet::peer {
namespace {

using namespace std::chrono_literals;

/// The data in the memory of these tests' algorithms.
struct Notes {
    double number;
    std::uint32_t heard, forgotten, from;
    hapnet_received last;
};

Notes& notes(void* state) { return *static_cast<Notes*>(state); }

const char* begin(void* state, const char* parameters)
{
    if (std::string_view{parameters} == "wrong") return "wrong is not a number";
    notes(state).number = std::strlen(parameters) == 0 ? 1.0 : 2.0;
    return nullptr;
}

void hear(void* state, const hapnet_received* received)
{
    ++notes(state).heard;
    notes(state).last = *received;
}

void forget(void* state, std::uint32_t other)
{
    ++notes(state).forgotten;
    notes(state).from = other;
}

/// Puts the body where the other peer has it, with the received force on the hand.
void tick(void* state, const hapnet_world* world, const hapnet_situation* now,
          hapnet_outcome* outcome)
{
    world->tick(world->handle);
    world->tick(world->handle); // ignored
    const hapnet_other& other = now->others[now->leader];
    if (other.state.has_body != 0) world->place(world->handle, &other.state.body);
    outcome->has_on_hand = 1;
    outcome->on_hand.x = notes(state).heard;
    outcome->remote_force.y = notes(state).number;
    outcome->has_remote_hip = other.heard;
    outcome->remote_hip = other.state.hip;
}

void lazy(void* /*state*/, const hapnet_world* /*world*/, const hapnet_situation* /*now*/,
          hapnet_outcome* outcome)
{
    outcome->remote_force.x = std::numeric_limits<double>::quiet_NaN();
}

hapnet_algorithm whole()
{
    return {.abi = HAPNET_ALGORITHM_ABI,
            .state_bytes = sizeof(Notes),
            .plays_with_many = 0,
            .reserved = 0,
            .name = "of a test",
            .begin = begin,
            .hear = hear,
            .tick = tick,
            .forget = forget};
}

base::Result<SharedObject> loaded(const hapnet_algorithm& algorithm, const char* parameters = "")
{
    return SharedObject{{"./x.so", parameters}}.with(
        std::make_shared<const hapnet_algorithm>(algorithm));
}

/// A peer's copy of the paper's scene, and one other peer that was heard.
struct Play {
    scene::World world = scene::World::freeze(scene::paper_scene()).value();
    Remote remote{{.id = 7}};
    wire::State state;
    base::TimePoint now{1s};

    Play()
    {
        state.sequence = 3;
        state.sent = base::TimePoint{990ms};
        state.hip = {{0.5, 0.0, 0.0}};
        state.touching = true;
        wire::BodyState body;
        body.position = {{0.01, 0.0, 0.0}};
        state.bodies.add(body);
        remote.update(state, base::TimePoint{995ms});
        remote.look(now);
    }
    [[nodiscard]] Situation situation() const
    {
        return {.now = now, .body = 0, .others = {&remote, 1}, .remote = remote};
    }
};

TEST(SharedObject, TicksTheWorldOnceAndSaysWhatTheAlgorithmSays)
{
    Play play;
    auto algorithm = loaded(whole()).value();
    algorithm.hear({.state = play.state, .arrived = base::TimePoint{995ms}});
    const Outcome outcome = algorithm.tick(play.world, play.situation());
    EXPECT_EQ(play.world.ticks(), 1U);
    EXPECT_EQ(play.world.position(0).x(), 0.01);
    EXPECT_EQ(outcome.on_hand.x(), 1.0);
    EXPECT_EQ(outcome.remote_force.y(), 1.0);
    ASSERT_TRUE(outcome.remote_hip);
    EXPECT_EQ(outcome.remote_hip->x(), 0.5);
}

TEST(SharedObject, TicksTheWorldForAnAlgorithmThatDoesNot)
{
    Play play;
    hapnet_algorithm description = whole();
    description.tick = lazy;
    auto algorithm = loaded(description).value();
    const Outcome outcome = algorithm.tick(play.world, play.situation());
    EXPECT_EQ(play.world.ticks(), 1U);
    EXPECT_EQ(outcome.on_hand, outcome.touched.on_hand);
    EXPECT_EQ(outcome.remote_force, base::Force{}); // a force that is not finite counts as zero
}

TEST(SharedObject, TellsWhatArrivesAndWhoIsForgotten)
{
    struct Spy {
        static void tick(void* state, const hapnet_world* world, const hapnet_situation* now,
                         hapnet_outcome* outcome)
        {
            std::ignore = now;
            world->tick(world->handle);
            const Notes& seen = notes(state);
            outcome->remote_force = {double(seen.last.from), double(seen.last.state.sequence),
                                     double(seen.last.taken)};
            outcome->has_on_hand = 1;
            outcome->on_hand = {double(seen.last.clock.known), double(seen.last.clock.offset_ns),
                                double(100 * seen.forgotten + seen.from)};
        }
    };
    Play play;
    hapnet_algorithm description = whole();
    description.tick = Spy::tick;
    auto algorithm = loaded(description).value();
    algorithm.hear({.state = play.state,
                    .arrived = base::TimePoint{995ms},
                    .taken = false,
                    .clock = RemoteClock{ClockEstimate{.offset = 5ns, .uncertainty = 1ns}},
                    .from = 4});
    algorithm.forget(6);
    const Outcome outcome = algorithm.tick(play.world, play.situation());
    EXPECT_EQ(outcome.remote_force, (base::Force{{4.0, 3.0, 0.0}}));
    EXPECT_EQ(outcome.on_hand, (base::Force{{1.0, 5.0, 106.0}}));
}

TEST(SharedObject, HasAMemoryOfItsOwnInEachCopy)
{
    Play play;
    auto one = loaded(whole()).value();
    one.hear({.state = play.state, .arrived = base::TimePoint{995ms}});
    auto two = one;
    two.hear({.state = play.state, .arrived = base::TimePoint{995ms}});
    EXPECT_EQ(one.tick(play.world, play.situation()).on_hand.x(), 1.0);
    EXPECT_EQ(two.tick(play.world, play.situation()).on_hand.x(), 2.0);
}

TEST(SharedObject, IsRefusedWithAReason)
{
    const auto reason = [](const hapnet_algorithm& algorithm, const char* parameters = "") {
        const auto result = loaded(algorithm, parameters);
        return result ? std::string{} : result.error().message;
    };
    EXPECT_EQ(reason(whole()), "");
    EXPECT_EQ(reason(whole(), "wrong"), "parameters: wrong is not a number");
    hapnet_algorithm other = whole();
    other.abi = 2;
    EXPECT_EQ(reason(other), "it is for version 2 of hapnet/algorithm.h, and this program for 1: "
                             "compile it anew");
    other = whole();
    other.tick = nullptr;
    EXPECT_EQ(reason(other), "it has no tick()");
    other = whole();
    other.begin = nullptr;
    EXPECT_EQ(reason(other), "");
    EXPECT_EQ(reason(other, "2"), "it takes no parameters");
    other = whole();
    other.state_bytes = HAPNET_STATE_BYTES_MAX + 1;
    EXPECT_EQ(reason(other), "its memory of 1048577 bytes is more than the 1048576 that it may "
                             "have");
}

TEST(SharedObject, IsAnAlgorithmThatReadsBackAndIsNotLoadedByReading)
{
    const auto no_file = [](const std::string& name) { return base::Result<std::string>{name}; };
    const Algorithm algorithm = load_algorithm("lib/x.so", no_file).value();
    EXPECT_EQ(name_of(algorithm), "shared-object");
    EXPECT_FALSE(is_loaded(algorithm));
    EXPECT_TRUE(is_loaded(algorithm_named("base").value()));
    const std::string text = print_algorithm(algorithm);
    EXPECT_EQ(print_algorithm(parse_algorithm(text, "x.toml").value()), text);
    EXPECT_EQ(std::get<SharedObject>(parse_algorithm(text, "x.toml").value()).options().file,
              "lib/x.so");
}

TEST(SharedObject, PlaysWithManyIfItSaysSo)
{
    hapnet_algorithm description = whole();
    EXPECT_FALSE(plays_with_many(Algorithm{loaded(description).value()}));
    description.plays_with_many = 1;
    EXPECT_TRUE(plays_with_many(Algorithm{loaded(description).value()}));
}

} // namespace
} // namespace hapnet::peer
