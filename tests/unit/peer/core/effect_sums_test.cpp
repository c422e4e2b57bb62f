// SPDX-FileCopyrightText: 2026 The Hapnet authors
// SPDX-License-Identifier: MIT
#include "peer/core/effect_sums.hpp"

#include <chrono>
#include <gtest/gtest.h>

namespace hapnet::peer {
namespace {

using namespace std::chrono_literals;

TEST(EffectSums, SumsInMillionthsModuloTwoToThe32)
{
    EffectSums effects;
    EXPECT_EQ(effects.impulse_uns(), (wire::Sums{0, 0, 0}));
    for (int i = 0; i < 1000; ++i) effects.add(base::Force{{1.5, -0.5, 0.0}} * 1ms);
    EXPECT_EQ(effects.impulse_uns(), (wire::Sums{1'500'000, 0U - 500'000, 0}));
    effects.add(base::Displacement{{1e-6, -2e-6, 2500.0}});
    effects.add(base::Displacement{{1e-6, 0.0, 2500.0}});
    EXPECT_EQ(effects.displacement_um(), (wire::Sums{2, 0U - 2, 705'032'704}));
}

TEST(EffectSums, LosesLessThanAMicrometreInAnHourOfTicks)
{
    EffectSums effects;
    for (int i = 0; i < 3'600'000; ++i) effects.add(base::Displacement{{1e-7, 0.0, 0.0}});
    EXPECT_NEAR(static_cast<double>(effects.displacement_um()[0]), 360'000.0, 1.0);
}

} // namespace
} // namespace hapnet::peer
