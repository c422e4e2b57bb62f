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
#include <utility>

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

TEST(Link, AllocatesNothingOnceItHasSeenItsTraffic)
{
    const Conditions conditions{.loss = base::Probability::from_fraction(0.3).value(),
                                .burst_loss = Burst{4, 100},
                                .delay = 160ms,
                                .jitter = 15ms,
                                .order = Order::free};
    Link link{pipeline_of(conditions, base::Seed{42}, Direction::up), conditions.order};
    const std::array<std::byte, 1400> bytes{};
    const auto drain = [&](base::TimePoint now) {
        while (auto datagram = link.poll(now)) link.on_sent(*std::move(datagram), now);
    };
    // More at once, and larger, than what comes later.
    for (int i = 0; i < 1000; ++i) link.on_packet(bytes, start);
    drain(start + 1s);

    const auto before = allocations;
    EXPECT_GT(before, 0U); // the counter is in place
    for (int i = 0; i < 100'000; ++i) {
        const auto now = start + 1s + i * 1ms;
        link.on_packet(std::span{bytes}.first(static_cast<std::size_t>(i) % bytes.size()), now);
        drain(now);
    }
    EXPECT_EQ(allocations - before, 0U);
}

} // namespace hapnet::emulator
