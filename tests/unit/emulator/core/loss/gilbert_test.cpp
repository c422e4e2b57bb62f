// SPDX-FileCopyrightText: 2026 The Hapnet authors
// SPDX-License-Identifier: MIT
#include "emulator/core/loss/gilbert.hpp"

#include "tests/unit/emulator/core/loss/running.hpp"

#include <gtest/gtest.h>
#include <limits>
#include <tuple>

namespace hapnet::emulator {

namespace {

using namespace std::chrono_literals;
using namespace base::literals; // NOLINT(google-build-using-namespace): literals only
using test::losses;
using test::refusal;
using test::stream;

} // namespace

TEST(Gilbert, IsTheGilbertElliottChainWithItsShareAndMeanBurst)
{
    // P = 10 %, L = 5: r = 1/5, p = 0.1 / (0.9 * 5).
    const auto p = base::Probability::from_fraction(0.1 / (0.9 * 5.0)).value();
    LossProcess gilbert{Gilbert{10_percent, 5.0}, stream()};
    LossProcess elliott{GilbertElliott{p, 20_percent, 0_percent, 100_percent}, stream()};
    EXPECT_EQ(losses(gilbert, 0, 5000), losses(elliott, 0, 5000));
}

TEST(Gilbert, WantsBurstsLongEnoughForTheirShare)
{
    EXPECT_EQ(refusal(Gilbert{93_percent, 5.0}),
              "mean_burst must be more than share / (1 - share) = 13.29 datagrams at a share of "
              "93%: the good runs between bursts would be shorter than one");
    EXPECT_EQ(refusal(Gilbert{1_percent, 0.5}), "mean_burst must be at least 1 datagram");
    EXPECT_EQ(refusal(Gilbert{1_percent, std::numeric_limits<double>::quiet_NaN()}),
              "mean_burst must be at least 1 datagram");
    EXPECT_NE(refusal(Gilbert{100_percent, 1e9}), "");
}

TEST(GilbertElliott, KeepsItsStateThroughAChangeOfItsNumbers)
{
    // Bad from the start and never left. A chain that began again could be good.
    for (std::uint64_t seed = 0; seed < 20; ++seed) {
        LossProcess process{GilbertElliott{100_percent, 0_percent, 0_percent, 100_percent},
                            base::Seed{seed}.stream("up/loss")};
        EXPECT_EQ(losses(process, 0, 10), "1111111111");
        process.change(GilbertElliott{1_percent, 0_percent, 0_percent, 100_percent});
        EXPECT_EQ(losses(process, 10, 10), "1111111111");
    }
}

TEST(GilbertElliott, WantsAChainThatMoves)
{
    EXPECT_NE(refusal(GilbertElliott{}), "");
    EXPECT_EQ(refusal(GilbertElliott{1_percent, 0_percent, 0_percent, 100_percent}), "");
}

TEST(TimedGilbertElliott, StaysAsItIsForDatagramsOfTheSameMoment)
{
    const TimedGilbertElliott law{1ms, 1ms, 0_percent, 100_percent};
    LossProcess process{law, stream()};
    auto first = LossState::none; // of its moment
    for (std::uint64_t n = 0; n < 100; ++n) {
        const auto at = 1ms * static_cast<int>(n / 10);
        std::ignore = process.on_packet({n, 96, at});
        const auto state = process.state();
        if (n % 10 == 0) first = state;
        EXPECT_EQ(state, first);
    }
}

TEST(TimedGilbertElliott, WantsTimesInBothStates)
{
    EXPECT_NE(refusal(TimedGilbertElliott{0ms, 1ms, 0_percent, 100_percent}), "");
}

} // namespace hapnet::emulator
