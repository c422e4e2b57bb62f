// SPDX-FileCopyrightText: 2026 The Hapnet authors
// SPDX-License-Identifier: MIT
#include "proto/control/turns.hpp"

#include <atomic>
#include <chrono>
#include <gtest/gtest.h>
#include <optional>
#include <thread>

namespace hapnet::control {
namespace {

using namespace std::chrono_literals;

constexpr base::TimePoint start{1h};

/// Another thread that orders work.
class Orders {
public:
    Orders(Turns& turns, Step step)
        : thread_{[this, &turns, step = std::move(step)] {
              try {
                  turns.run(step);
                  is_done = true;
              } catch (const LoopHasEnded&) {
                  has_ended = true;
              }
          }}
    {}
    void join() { thread_.join(); }

    std::atomic<bool> is_done{false};
    std::atomic<bool> has_ended{false};

private:
    std::thread thread_;
};

void wait_for_work(const Turns& turns)
{
    while (!turns.next_deadline()) std::this_thread::yield();
}

TEST(Turns, DoWorkStepByStepOnTheThreadOfTheLoop)
{
    Turns turns;
    int steps = 0;
    std::thread::id where;
    Orders orders{turns, [&] {
                      where = std::this_thread::get_id();
                      return ++steps == 3;
                  }};
    wait_for_work(turns);
    auto now = start;
    for (int i = 1; i <= 3; ++i) {
        EXPECT_TRUE(turns.is_due(now, std::nullopt));
        turns.take(now);
        EXPECT_EQ(steps, i);
        now += Turns::pause;
    }
    orders.join();
    EXPECT_TRUE(orders.is_done);
    EXPECT_EQ(where, std::this_thread::get_id());
    EXPECT_FALSE(turns.next_deadline());
    EXPECT_FALSE(turns.is_due(now, std::nullopt));
}

TEST(Turns, LeaveTheLoopTimeBetweenTwoStepsAndBeforeADeparture)
{
    Turns turns;
    Orders orders{turns, [] { return false; }};
    wait_for_work(turns);
    turns.take(start);
    EXPECT_EQ(turns.next_deadline(), start + Turns::pause);
    EXPECT_FALSE(turns.is_due(start + Turns::pause - 1ns, std::nullopt));
    const auto now = start + Turns::pause;
    EXPECT_TRUE(turns.is_due(now, std::nullopt));
    EXPECT_TRUE(turns.is_due(now, now + Turns::step_takes + 1ns));
    EXPECT_FALSE(turns.is_due(now, now + Turns::step_takes));
    const auto late = start + Turns::put_off_max;
    EXPECT_TRUE(turns.is_due(late, late)) << "it is not put off for ever";
    turns.close();
    orders.join();
}

TEST(Turns, TellWhoOrdersThatTheLoopHasEnded)
{
    Turns turns;
    Orders before{turns, [] { return false; }};
    wait_for_work(turns);
    turns.take(start);
    turns.close();
    before.join();
    EXPECT_TRUE(before.has_ended);
    Orders after{turns, [] { return true; }};
    after.join();
    EXPECT_TRUE(after.has_ended);
    EXPECT_FALSE(after.is_done);
}

} // namespace
} // namespace hapnet::control
