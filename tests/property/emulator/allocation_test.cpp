// SPDX-FileCopyrightText: 2026 The Hapnet authors
// SPDX-License-Identifier: MIT
// Counts the allocations of this whole test program by replacing the global operator new.
#include "emulator/core/conditions.hpp"
#include "emulator/core/link.hpp"

#include <array>
#include <chrono>
#include <cstddef>
#include <cstdint>
#include <cstdlib>
#include <gtest/gtest.h>
#include <new>
#include <span>

namespace {

std::uint64_t allocations = 0;

} // namespace

// NOLINTBEGIN(cppcoreguidelines-no-malloc): this is where new and delete are made.
// Not inline: GCC would see malloc() on one side and delete on the other, and object.
[[gnu::noinline]] void* operator new(std::size_t size)
{
    ++allocations;
    if (void* memory = std::malloc(size)) return memory;
    throw std::bad_alloc{};
}
[[gnu::noinline]] void operator delete(void* memory) noexcept { std::free(memory); }
[[gnu::noinline]] void operator delete(void* memory, std::size_t /*size*/) noexcept
{
    std::free(memory);
}
// NOLINTEND(cppcoreguidelines-no-malloc)

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
    Link link{conditions, {base::Seed{42}, Direction::up, start, {}}};
    const std::array<std::byte, 1400> bytes{};

    const auto before = allocations;
    EXPECT_GT(before, 0U); // the counter is in place
    for (int i = 0; i < 100'000; ++i) {
        const auto now = start + i * 100us;
        if (i == 50'000) link.change(conditions, now); // as a ramp does, again and again
        link.on_packet(std::span{bytes}.first(static_cast<std::size_t>(i) % bytes.size()), now);
        while (const auto departure = link.poll(now)) link.on_sent(*departure, now);
    }
    EXPECT_EQ(allocations - before, 0U);
    EXPECT_GT(link.statistics().duplicated, 1000U);
    EXPECT_GT(link.statistics().reordered, 1000U);
}

} // namespace hapnet::emulator
