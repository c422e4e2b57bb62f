// SPDX-FileCopyrightText: 2026 The Hapnet authors
// SPDX-License-Identifier: MIT
#include "emulator/core/client_table.hpp"

#include <gtest/gtest.h>

namespace hapnet::emulator::client_table_test {
namespace {

using namespace std::chrono_literals;

constexpr base::TimePoint start{1h};

TEST(ClientTable, FindsClientsByTheirAddresses)
{
    ClientTable<int> table{3, 60s};
    EXPECT_EQ(table.find(70, start), std::nullopt);
    const auto first = table.add(70, start);
    const auto second = table.add(50, start);
    ASSERT_TRUE(first && second);
    EXPECT_EQ(table.find(50, start), second);
    EXPECT_EQ(table.find(70, start), first);
    EXPECT_EQ(table.address(*second), 50);
}

TEST(ClientTable, HasNoMorePlacesThanItIsGivenAndFreesThoseThatAreForgotten)
{
    ClientTable<int> table{2, 60s};
    const auto first = table.add(1, start);
    ASSERT_TRUE(table.add(2, start));
    EXPECT_EQ(table.add(3, start), std::nullopt);
    table.forget(*first);
    EXPECT_EQ(table.find(1, start), std::nullopt);
    const auto third = table.add(3, start);
    EXPECT_EQ(third, first);
    EXPECT_EQ(table.find(3, start), third);
}

TEST(ClientTable, CallsAClientIdleWhenItHasBeenSilentForSoLong)
{
    ClientTable<int> table{4, 60s};
    const auto one = table.add(1, start);
    const auto other = table.add(2, start + 10s);
    EXPECT_EQ(table.idle_at(*one), start + 60s);
    std::ignore = table.find(1, start + 30s);
    EXPECT_EQ(table.idle_at(*one), start + 90s);
    EXPECT_EQ(table.idle_at(*other), start + 70s);
}

} // namespace
} // namespace hapnet::emulator::client_table_test
