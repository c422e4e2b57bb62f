// SPDX-FileCopyrightText: 2026 The Hapnet authors
// SPDX-License-Identifier: MIT
#include "emulator/core/delay/delay.hpp"
#include "tests/support/allocations.hpp"

#include <chrono>
#include <gtest/gtest.h>
#include <memory>
#include <string>
#include <vector>

namespace hapnet::emulator {
namespace {

using namespace std::chrono_literals;

TEST(Allocation, ADelayProcessNeitherDrawsNorChangesWithOne)
{
    const std::vector<double> values{-1.0, 0.0, 2.0};
    const auto table = std::make_shared<const QuantileTable>(values, QuantileTable::Unit::own);
    const auto trace = std::make_shared<const DelayTrace>(std::vector<base::Duration>{10ms, 30ms});
    const std::string file = "a name that is too long to be kept within the string itself";
    std::vector<Variation> laws;
    for (const base::Duration mean : {20ms, 21ms, 22ms}) {
        for (const DelayLaw& law :
             {DelayLaw{ConstantLaw{mean}}, DelayLaw{UniformLaw{mean, 5ms}},
              DelayLaw{NormalLaw{mean, 5ms}}, DelayLaw{LogNormalLaw{mean, 5ms}},
              DelayLaw{ExponentialLaw{mean}}, DelayLaw{ParetoLaw{mean, 3.0}},
              DelayLaw{GammaLaw{mean, 5ms}}, DelayLaw{TableLaw{file, mean, 5ms, table}}}) {
            laws.push_back({law, 100ms});
        }
        laws.push_back({TraceLaw{file, trace}});
    }
    DelayProcess process{{}, base::Seed{42}.stream("up/jitter")};
    base::Duration sum{};
    const auto before = test::allocations();
    for (std::uint64_t n = 0; n < 1000; ++n) {
        process.change(laws[n % laws.size()]);
        sum += process.on_packet({n, 96, static_cast<base::Duration::rep>(n) * 1'000us});
    }
    const auto after = test::allocations();
    EXPECT_EQ(after, before);
    EXPECT_GT(sum, 0ms);
}

} // namespace
} // namespace hapnet::emulator
