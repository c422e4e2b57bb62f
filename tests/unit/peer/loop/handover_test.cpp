// SPDX-FileCopyrightText: 2026 The Hapnet authors
// SPDX-License-Identifier: MIT
#include "peer/loop/handover.hpp"

#include <array>
#include <atomic>
#include <gtest/gtest.h>
#include <thread>

namespace hapnet::peer {
namespace {

/// Larger than anything that is written at once.
using Pages = std::array<int, 4096>;

TEST(Handover, GivesWhatWasAskedForOnce)
{
    Handover<int> desk;
    int fills = 0;
    const auto give = [&](int& value) { value = ++fills; };
    int taken = 0;
    desk.give_if_asked(give);
    EXPECT_EQ(fills, 0);
    EXPECT_FALSE(desk.take(taken));
    desk.ask();
    desk.ask();
    EXPECT_FALSE(desk.take(taken)) << "not given yet";
    desk.give_if_asked(give);
    desk.give_if_asked(give);
    desk.ask(); // what was given is still there
    EXPECT_TRUE(desk.take(taken));
    EXPECT_EQ(taken, 1);
    EXPECT_FALSE(desk.take(taken));
}

TEST(Handover, IsWholeAcrossThreads)
{
    constexpr int rounds = 2000;
    Handover<Pages> desk;
    std::atomic<bool> over{false};
    std::thread giver{[&] {
        for (int turn = 1; !over; ++turn) {
            desk.give_if_asked([turn](Pages& pages) { pages.fill(turn); });
            std::this_thread::yield();
        }
    }};
    Pages pages{};
    int broken = 0;
    for (int round = 0, last = 0; round < rounds; ++round) {
        desk.ask();
        while (!desk.take(pages)) std::this_thread::yield();
        if (pages.front() <= last || pages.front() != pages.back()) ++broken;
        last = pages.front();
    }
    over = true;
    giver.join();
    EXPECT_EQ(broken, 0);
}

} // namespace
} // namespace hapnet::peer
