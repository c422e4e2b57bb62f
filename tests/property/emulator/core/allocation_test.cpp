// SPDX-FileCopyrightText: 2026 The Hapnet authors
// SPDX-License-Identifier: MIT
#include "emulator/core/conditions.hpp"
#include "emulator/core/link.hpp"
#include "tests/support/allocations.hpp"

#include <array>
#include <chrono>
#include <cstddef>
#include <cstdint>
#include <gtest/gtest.h>
#include <memory>
#include <span>

namespace hapnet::emulator {

namespace {

using namespace std::chrono_literals;

constexpr base::TimePoint start{1h};

} // namespace

TEST(Link, AllocatesNothingOnceItIsMade)
{
    using base::literals::operator""_percent;
    const Conditions conditions{.mtu = {1500},
                                .rate = {100'000'000, 28, 64 << 10},
                                .loss = {RandomLoss{10_percent}, Burst{4, 100, {}}},
                                .corrupt = {10_percent, 2},
                                .duplicate = {10_percent, 3ms},
                                .delay = constant(160ms),
                                .jitter = uniform(15ms),
                                .order = Order::free,
                                .reorder = {1_percent, {2, {}}}};
    const auto shared = std::make_shared<const Conditions>(conditions);
    Link link{conditions, {base::Seed{42}, Direction::up, start, {}}};
    const std::array<std::byte, 1400> bytes{};

    const auto before = test::allocations();
    EXPECT_GT(before, 0U); // the counter is in place
    for (int i = 0; i < 100'000; ++i) {
        const auto now = start + i * 100us;
        if (i == 50'000) link.share(shared, now); // repeatedly, as a ramp does
        link.on_packet(std::span{bytes}.first(static_cast<std::size_t>(i) % bytes.size()), now);
        while (const auto departure = link.poll(now)) link.on_sent(*departure, now);
    }
    EXPECT_EQ(test::allocations() - before, 0U);
    EXPECT_GT(link.statistics().duplicated, 1000U);
    EXPECT_GT(link.statistics().reordered, 1000U);
}

} // namespace hapnet::emulator
