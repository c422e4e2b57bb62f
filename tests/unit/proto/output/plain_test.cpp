// SPDX-FileCopyrightText: 2026 The Hapnet authors
// SPDX-License-Identifier: MIT
#include "proto/output/plain.hpp"

#include <gtest/gtest.h>

namespace hapnet::output {
namespace {

TEST(Plain, HasNoMarksOfMarkdown)
{
    EXPECT_EQ(plain("With `--fates` ([more](fates.md#a)), 1 % [so]."),
              "With --fates (more), 1 % so.");
    EXPECT_EQ(plain("an open [end](never"), "an open end");
    EXPECT_EQ(plain(""), "");
}

} // namespace
} // namespace hapnet::output
