// SPDX-FileCopyrightText: 2026 The Hapnet authors
// SPDX-License-Identifier: MIT
#include "proto/base/ensure.hpp"
#include "proto/base/result.hpp"

#include <gtest/gtest.h>

namespace hapnet::base {
namespace {

Result<int> half(int number)
{
    if (number % 2 != 0) return fail("not even");
    return number / 2;
}

TEST(Result, HoldsAValueOrTheReasonWhyThereIsNone)
{
    EXPECT_EQ(half(4).value(), 2);
    ASSERT_FALSE(half(3));
    EXPECT_EQ(half(3).error().message, "not even");
}

TEST(EnsureDeathTest, NamesThePlaceAndTheFunctionOfTheMistake)
{
    EXPECT_DEATH(ensure(2 + 2 == 5), "result_test.cpp:[0-9]+: .*must never happen");
}

TEST(Ensure, IsSilentWhenTheConditionHolds)
{
    testing::internal::CaptureStderr();
    ensure(true);
    EXPECT_EQ(testing::internal::GetCapturedStderr(), "");
}

} // namespace
} // namespace hapnet::base
