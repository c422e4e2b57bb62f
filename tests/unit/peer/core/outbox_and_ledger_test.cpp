// SPDX-FileCopyrightText: 2026 The Hapnet authors
// SPDX-License-Identifier: MIT
#include "peer/core/ledger.hpp"
#include "peer/core/outbox.hpp"

#include <chrono>
#include <gtest/gtest.h>

namespace hapnet::peer {
namespace {

using namespace std::chrono_literals;

TEST(Outbox, GivesBackInOrder)
{
    Outbox<int, 3> box;
    EXPECT_FALSE(box.take());
    box.put(1);
    box.put(2);
    EXPECT_EQ(box.take(), 1);
    box.put(3);
    box.put(4);
    EXPECT_EQ(box.take(), 2);
    EXPECT_EQ(box.take(), 3);
    EXPECT_EQ(box.take(), 4);
    EXPECT_FALSE(box.take());
}

TEST(Outbox, DropsTheOldestWhenItIsFull)
{
    Outbox<int, 3> box;
    for (int i = 1; i <= 10; ++i) box.put(i);
    EXPECT_EQ(box.take(), 8);
    EXPECT_EQ(box.take(), 9);
    EXPECT_EQ(box.take(), 10);
    EXPECT_FALSE(box.take());
}

TEST(Ledger, SumsInBillionths)
{
    Ledger ledger;
    EXPECT_EQ(ledger.impulse_nns(), (std::array<std::int64_t, 3>{0, 0, 0}));
    for (int i = 0; i < 1000; ++i) ledger.add(base::Force{{1.5, -0.5, 0.0}} * 1ms);
    EXPECT_EQ(ledger.impulse_nns(), (std::array<std::int64_t, 3>{1'500'000'000, -500'000'000, 0}));
    ledger.add(base::Displacement{{1e-9, -2e-9, 0.25}});
    ledger.add(base::Displacement{{1e-9, 0.0, 0.25}});
    EXPECT_EQ(ledger.displacement_nm(), (std::array<std::int64_t, 3>{2, -2, 500'000'000}));
}

TEST(Ledger, LosesLessThanANanometreInAnHourOfTicks)
{
    Ledger ledger;
    for (int i = 0; i < 3'600'000; ++i) ledger.add(base::Displacement{{1e-7, 0.0, 0.0}});
    EXPECT_NEAR(static_cast<double>(ledger.displacement_nm()[0]), 360'000'000.0, 1.0);
}

} // namespace
} // namespace hapnet::peer
