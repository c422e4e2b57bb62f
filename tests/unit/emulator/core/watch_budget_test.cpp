// SPDX-FileCopyrightText: 2026 The Hapnet authors
// SPDX-License-Identifier: MIT
#include "emulator/core/watch_budget.hpp"

#include <gtest/gtest.h>

namespace hapnet::emulator {
namespace {

using namespace std::chrono_literals;

constexpr base::TimePoint budget_start{1s};

TEST(WatchBudget, PermitsWatchingAtTheBeginning)
{
    const WatchBudget budget{budget_start};
    EXPECT_TRUE(budget.permits());
    EXPECT_FALSE(budget.wants_usage(budget_start + 5ms - 1ns));
    EXPECT_TRUE(budget.wants_usage(budget_start + 5ms));
}

TEST(WatchBudget, EndsWhenAThreadTakesMoreThanItsShareAndIsThereAgainWhenItHasSlept)
{
    WatchBudget budget{budget_start};
    budget.on_usage(100s, budget_start); // what was used before does not count
    budget.on_usage(100s + 100ms, budget_start + 100ms);
    EXPECT_TRUE(budget.permits()); // 20 ms left of 50
    budget.on_usage(100s + 167ms, budget_start + 167ms);
    EXPECT_FALSE(budget.permits()); // 0.1 ms too much
    budget.on_usage(100s + 167ms, budget_start + 168ms);
    EXPECT_TRUE(budget.permits());
}

TEST(WatchBudget, SavesAndOwesFiftyMillisecondsAtMost)
{
    WatchBudget budget{budget_start};
    budget.on_usage(0s, budget_start);
    budget.on_usage(10s, budget_start + 10s);
    EXPECT_FALSE(budget.permits());
    budget.on_usage(10s, budget_start + 10s + 71ms);
    EXPECT_FALSE(budget.permits());
    budget.on_usage(10s, budget_start + 10s + 72ms);
    EXPECT_TRUE(budget.permits());
    budget.on_usage(10s, budget_start + 100s);
    budget.on_usage(10s + 100ms, budget_start + 100s + 70ms); // earns 49 ms
    EXPECT_FALSE(budget.permits());                           // 50 + 49 - 100
}

} // namespace
} // namespace hapnet::emulator
