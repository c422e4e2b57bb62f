// SPDX-FileCopyrightText: 2026 The Hapnet authors
// SPDX-License-Identifier: MIT
#include "emulator/workers.hpp"

#include "proto/net/clock.hpp"
#include "proto/net/wake_event.hpp"

#include <atomic>
#include <chrono>
#include <gtest/gtest.h>
#include <stdexcept>
#include <thread>
#include <vector>

namespace hapnet::emulator {
namespace {

using namespace std::chrono_literals;

/// Waits as long as it takes; a test that hangs is stopped from outside.
void wait_until(const auto& condition)
{
    while (!condition()) std::this_thread::yield();
}

/// A part that is always due, and counts its rounds in a number without a lock of its own.
Workers::Part counting(long& rounds)
{
    return {.descriptors = {},
            .next_deadline = [] { return net::monotonic_now() + 100us; },
            .relay = [&rounds] { ++rounds; }};
}

TEST(Workers, StandStillAsLongAsTheMainThreadAsksForIt)
{
    std::vector<long> rounds(3, 0);
    std::vector<Workers::Part> parts;
    for (long& own : rounds) parts.push_back(counting(own));
    Workers workers{std::move(parts), Timing::eco};
    for (int i = 0; i < 200; ++i) {
        const Workers::Rest rest{workers};
        const auto before = rounds;
        std::this_thread::yield();
        ASSERT_EQ(rounds, before);
    }
    wait_until([&] {
        const Workers::Rest rest{workers};
        return rounds[0] > 10 && rounds[1] > 10 && rounds[2] > 10;
    });
    workers.stop();
    const auto before = rounds;
    std::this_thread::yield();
    EXPECT_EQ(rounds, before);
}

TEST(Workers, LookAtTheirDeadlinesAgainAfterARest)
{
    std::optional<base::TimePoint> deadline; // never
    const auto is_soon = [&] {
        return deadline ? std::optional{net::monotonic_now() + 100us} : deadline;
    };
    std::atomic<int> rounds{0};
    std::vector<Workers::Part> parts;
    parts.push_back({.descriptors = {}, .next_deadline = is_soon, .relay = [&] { ++rounds; }});
    Workers workers{std::move(parts), Timing::precise};
    {
        const Workers::Rest rest{workers};
        deadline = net::monotonic_now();
    }
    wait_until([&] { return rounds > 10; });
    workers.stop();
}

TEST(Workers, WakeForTheirDescriptors)
{
    const net::WakeEvent event;
    std::atomic<int> rounds{0};
    std::vector<Workers::Part> parts;
    parts.push_back({.descriptors = {event.descriptor()},
                     .next_deadline = [] { return std::nullopt; },
                     .relay =
                         [&] {
                             event.clear();
                             ++rounds;
                         }});
    Workers workers{std::move(parts), Timing::precise};
    wait_until([&] { return rounds > 0; });
    for (int i = 0; i < 20; ++i) {
        const int before = rounds;
        event.signal();
        wait_until([&] { return rounds > before; });
    }
}

TEST(Workers, TellOfAFailureAndThrowItInTheEnd)
{
    std::vector<Workers::Part> parts;
    parts.push_back({.descriptors = {},
                     .next_deadline = [] { return std::nullopt; },
                     .relay = [] { throw std::runtime_error{"out of order"}; }});
    Workers workers{std::move(parts), Timing::precise};
    wait_until([&] { return workers.has_failed(); });
    EXPECT_THROW(workers.stop(), std::runtime_error);
}

TEST(Workers, MayBeNone)
{
    Workers workers{{}, Timing::precise};
    EXPECT_TRUE(workers.empty());
    const Workers::Rest rest{workers};
    EXPECT_FALSE(workers.has_failed());
    workers.stop();
}

} // namespace
} // namespace hapnet::emulator
