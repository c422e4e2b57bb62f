// SPDX-FileCopyrightText: 2026 The Hapnet authors
// SPDX-License-Identifier: MIT
// Single ticks, computed by hand.
#include "peer/core/sync/base_tdpa.hpp"
#include "tests/unit/peer/core/sync/copy.hpp"

#include <algorithm>
#include <cmath>
#include <gtest/gtest.h>

namespace hapnet::peer::base_tdpa_test {
namespace {

Copy<BaseTdpa> with_one_other()
{
    BaseTdpa algorithm;
    algorithm.prepare(1);
    return Copy<BaseTdpa>{algorithm};
}

/// This hand rests in the cube. The other hand pushes it with 1 N, and sends this amount of work.
struct Squeezed {
    void play(int ticks, double work_per_tick_j)
    {
        for (int i = 0; i < ticks; ++i) {
            ++ms;
            wire::State state;
            state.sequence = static_cast<std::uint32_t>(ms);
            state.touching = true;
            state.contact_force = {{-1.0, 0.0, 0.0}};
            work_j += work_per_tick_j;
            state.work_uj = static_cast<std::uint32_t>(std::llround(1e6 * work_j));
            state.bodies.add(wire::BodyState{});
            const bool taken = copy.remote.update(state, at_ms(ms));
            copy.algorithm.hear({.state = state, .arrived = at_ms(ms), .taken = taken});
            last = copy.tick(ms, pushing_hip(0.0005)); // 0.25 N
        }
    }

    Copy<BaseTdpa> copy = with_one_other();
    double ms = 0.0;
    double work_j = 0.0;
    Outcome last;
};

TEST(BaseTdpa, IsBaseWhileTheOtherHandWorksForItsForce)
{
    Squeezed there;
    there.play(2, 0.1); // its work counts from its second message on
    there.play(20, 1e-3);
    EXPECT_GT(there.copy.algorithm.observed_j(), 0.0);
    EXPECT_EQ(there.last.remote_force.x(), -1.0);
}

TEST(BaseTdpa, DampsAForceWithoutWorkBehindIt)
{
    // The hand's own spring gives way. The body moves on to the left under -1 N, and comes back.
    Squeezed working;
    working.play(2, 0.1);
    Squeezed idle;
    double most_n = 0.0;
    for (int i = 0; i < 60; ++i) {
        working.play(1, 1e-3);
        idle.play(1, 0.0);
        most_n = std::max(most_n, std::abs(idle.last.remote_force.x() + 1.0));
    }
    EXPECT_GT(most_n, 0.05);
    EXPECT_LE(most_n, force_max);
    EXPECT_EQ(working.last.remote_force.x(), -1.0);
}

} // namespace
} // namespace hapnet::peer::base_tdpa_test
