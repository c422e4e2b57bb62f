// SPDX-FileCopyrightText: 2026 The Hapnet authors
// SPDX-License-Identifier: MIT
// Sessions over a path whose two ways take different times.
#include "emulator/core/profile/profile.hpp"
#include "peer/core/sync/algorithm.hpp"
#include "tests/sim/peer/core/score.hpp"

#include <gtest/gtest.h>
#include <optional>

namespace hapnet::sim::clocks_test {
namespace {

using namespace std::chrono_literals;

struct Ways {
    base::Duration there{};
    base::Duration back{};
};

/// Clocks that are `apart`, and said to be synchronised within `error` each.
struct Clocks {
    std::optional<base::Duration> error{};
    base::Duration apart{};
};

/// Returns the mean distance of the cubes in T3, in mm.
double mean_mm(const Ways& ways, const Clocks& clocks)
{
    Setting setting;
    setting.task = device::Task::t3;
    setting.length = 20s;
    setting.profile.path.up.delay = emulator::constant(ways.there);
    setting.profile.path.down.delay = emulator::constant(ways.back);
    for (auto& player : setting.players) {
        player.algorithm = peer::algorithm_named("remote-proxy").value();
        player.clock.synchronised_within = clocks.error;
    }
    setting.players[1].clock_ahead = clocks.apart;
    World world{setting};
    run_until_started(world);
    const base::TimePoint end = world.now() + world.side(0).peer().hands_on();
    Spread apart;
    while (world.now() < end) {
        world.step();
        apart.add(1e3 * discrepancy_x(world));
    }
    return apart.mean();
}

TEST(Clocks, ThatAreSynchronisedKeepCopiesCloserOnAnAsymmetricPath)
{
    constexpr Ways even{160ms, 160ms};
    constexpr Ways uneven{10ms, 310ms};
    const double by_echoes = mean_mm(uneven, {});
    EXPECT_GT(by_echoes, 3.0 * mean_mm(even, {}));
    EXPECT_LT(mean_mm(uneven, {0ms, 0ms}), 0.6 * by_echoes);
    EXPECT_LT(mean_mm(uneven, {2ms, 4ms}), 0.6 * by_echoes);
    EXPECT_NEAR(mean_mm(even, {0ms, 0ms}), mean_mm(even, {}), 0.3);
}

// A host whose clock was never synchronised: the echoes show it, and the session goes on by them.
TEST(Clocks, ThatAreNotWhatTheyStateAreFoundOutByTheEchoes)
{
    constexpr Ways even{20ms, 20ms};
    EXPECT_NEAR(mean_mm(even, {1ms, 5s}), mean_mm(even, {}), 0.3);
}

} // namespace
} // namespace hapnet::sim::clocks_test
