// SPDX-FileCopyrightText: 2026 The Hapnet authors
// SPDX-License-Identifier: MIT
#include "proto/base/shared_vector.hpp"

#include <gtest/gtest.h>
#include <vector>

namespace hapnet::base {
namespace {

TEST(SharedVector, IsSharedByItsCopies)
{
    const SharedVector<int> numbers{1, 2, 3};
    const auto copy = numbers; // NOLINT(performance-unnecessary-copy-initialization)
    EXPECT_EQ(&copy.get(), &numbers.get());
    EXPECT_EQ(copy.size(), 3U);
    EXPECT_EQ(copy[2], 3);
}

TEST(SharedVector, IsEqualToAnotherWithTheSameElements)
{
    const std::vector<bool> bits{true, false};
    EXPECT_EQ(SharedVector<bool>{bits}, (SharedVector<bool>{true, false}));
    EXPECT_NE(SharedVector<bool>{bits}, (SharedVector<bool>{true, true}));
    EXPECT_EQ(SharedVector<bool>{}, SharedVector<bool>{std::vector<bool>{}});
    EXPECT_TRUE(SharedVector<bool>{}.empty());
}

} // namespace
} // namespace hapnet::base
