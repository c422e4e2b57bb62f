// SPDX-FileCopyrightText: 2026 The Hapnet authors
// SPDX-License-Identifier: MIT
#include "peer/loop/snapshot_slot.hpp"

#include <array>
#include <atomic>
#include <gtest/gtest.h>
#include <thread>

namespace hapnet::peer::loop {
namespace {

/// Larger than anything that is written at once.
using Pages = std::array<int, 4096>;

TEST(SnapshotSlot, GivesARequestedValueOnce)
{
    SnapshotSlot<int> slot;
    int fills = 0;
    const auto fill = [&](int& value) { value = ++fills; };
    int taken = 0;
    slot.fill_if_requested(fill);
    EXPECT_EQ(fills, 0);
    EXPECT_FALSE(slot.take(taken));
    slot.request();
    slot.request();
    EXPECT_FALSE(slot.take(taken)) << "not filled in yet";
    slot.fill_if_requested(fill);
    slot.fill_if_requested(fill);
    slot.request(); // the filled value is still there
    EXPECT_TRUE(slot.take(taken));
    EXPECT_EQ(taken, 1);
    EXPECT_FALSE(slot.take(taken));
}

TEST(SnapshotSlot, IsWholeAcrossThreads)
{
    constexpr int rounds = 2000;
    SnapshotSlot<Pages> slot;
    std::atomic<bool> over{false};
    std::thread filler{[&] {
        for (int round = 1; !over; ++round) {
            slot.fill_if_requested([round](Pages& pages) { pages.fill(round); });
            std::this_thread::yield();
        }
    }};
    Pages pages{};
    int broken = 0;
    for (int round = 0, last = 0; round < rounds; ++round) {
        slot.request();
        while (!slot.take(pages)) std::this_thread::yield();
        if (pages.front() <= last || pages.front() != pages.back()) ++broken;
        last = pages.front();
    }
    over = true;
    filler.join();
    EXPECT_EQ(broken, 0);
}

} // namespace
} // namespace hapnet::peer::loop
