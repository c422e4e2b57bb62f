// SPDX-FileCopyrightText: 2026 The Hapnet authors
// SPDX-License-Identifier: MIT
#include "emulator/core/loss/random.hpp"

#include "tests/unit/emulator/core/loss/running.hpp"

#include <gtest/gtest.h>

namespace hapnet::emulator {

namespace {

using namespace base::literals; // NOLINT(google-build-using-namespace): literals only
using test::losses;

} // namespace

TEST(RandomLoss, OfMoreTakesWhatItTookBeforeAndMore)
{
    const auto few = losses(RandomLoss{10_percent}, 5000);
    const auto many = losses(RandomLoss{60_percent}, 5000);
    for (std::size_t i = 0; i < few.size(); ++i) EXPECT_TRUE(many[i] == '1' || few[i] == '0');
}

} // namespace hapnet::emulator
