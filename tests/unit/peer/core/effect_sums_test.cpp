// SPDX-FileCopyrightText: 2026 The Hapnet authors
// SPDX-License-Identifier: MIT
#include "peer/core/effect_sums.hpp"

#include <chrono>
#include <gtest/gtest.h>

namespace hapnet::peer {
namespace {

using namespace std::chrono_literals;

TEST(EffectSums, SumsInBillionths)
{
    EffectSums effects;
    EXPECT_EQ(effects.impulse_nns(), (std::array<std::int64_t, 3>{0, 0, 0}));
    for (int i = 0; i < 1000; ++i) effects.add(base::Force{{1.5, -0.5, 0.0}} * 1ms);
    EXPECT_EQ(effects.impulse_nns(), (std::array<std::int64_t, 3>{1'500'000'000, -500'000'000, 0}));
    effects.add(base::Displacement{{1e-9, -2e-9, 0.25}});
    effects.add(base::Displacement{{1e-9, 0.0, 0.25}});
    EXPECT_EQ(effects.displacement_nm(), (std::array<std::int64_t, 3>{2, -2, 500'000'000}));
}

TEST(EffectSums, LosesLessThanANanometreInAnHourOfTicks)
{
    EffectSums effects;
    for (int i = 0; i < 3'600'000; ++i) effects.add(base::Displacement{{1e-7, 0.0, 0.0}});
    EXPECT_NEAR(static_cast<double>(effects.displacement_nm()[0]), 360'000'000.0, 1.0);
}

} // namespace
} // namespace hapnet::peer
