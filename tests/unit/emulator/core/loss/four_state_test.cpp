// SPDX-FileCopyrightText: 2026 The Hapnet authors
// SPDX-License-Identifier: MIT
#include "emulator/core/loss/four_state.hpp"

#include "tests/unit/emulator/core/loss/running.hpp"

#include <gtest/gtest.h>

namespace hapnet::emulator {

namespace {

using namespace base::literals; // NOLINT(google-build-using-namespace): literals only
using test::packet;
using test::refusal;
using test::stream;

} // namespace

TEST(FourState, IsLostInItsLostStatesAndNeverTwiceInAGap)
{
    LossProcess process{FourState{30_percent, 10.0, 60_percent, 20_percent}, stream()};
    LossState last = LossState::none;
    for (std::uint64_t n = 0; n < 5000; ++n) {
        const auto cause = process.on_packet(packet(n));
        const auto state = process.state();
        EXPECT_EQ(cause.has_value(),
                  state == LossState::lost_in_burst || state == LossState::lost_in_gap);
        if (last == LossState::lost_in_gap) {
            EXPECT_EQ(state, LossState::received_in_gap);
        }
        last = state;
    }
}

TEST(FourState, WantsStepsThatAreProbabilities)
{
    EXPECT_EQ(refusal(FourState{5_percent, 20.0, 80_percent, 1_percent}), "");
    EXPECT_EQ(refusal(FourState{5_percent, 20.0, 100_percent, 0_percent}), "");
    EXPECT_EQ(refusal(FourState{5_percent, 20.0, 5_percent, 1_percent}),
              "isolated (1%) < share (5%) < density (5%) must hold: bursts lose more than the "
              "whole does, and the gaps between them less");
    // p31 + p32 = 1 / 1 + 0.5 * 0.25 / 0.75, too much; 1 / (0.8 - 0.2 / 2) = 1.4286.
    EXPECT_EQ(refusal(FourState{5_percent, 1.25, 80_percent, 1_percent}),
              "burst must be at least 1.429 for a density of 80% with good runs of 2");
    EXPECT_EQ(refusal(FourState{5_percent, 1.429, 80_percent, 1_percent}), "");
    EXPECT_EQ(
        refusal(FourState{5_percent, 50.0, 20_percent, 1_percent, 3.0}),
        "good runs of mean length 3 are too short for a density of 20%: write more than 4 for "
        "good_run");
    // p13 = 0.8 / (E_B 0.15), p14 = 0: E_B is at least 5.3333.
    EXPECT_EQ(refusal(FourState{80_percent, 5.0, 95_percent, 0_percent}),
              "bursts of 5 are too short for a share of 80%, as each is followed by a gap: write "
              "at least 5.334, or a higher density");
    EXPECT_EQ(refusal(FourState{80_percent, 5.334, 95_percent, 0_percent}), "");
    EXPECT_NE(refusal(FourState{70_percent, 20.0, 80_percent, 60_percent}), "");
    EXPECT_NE(refusal(FourState{5_percent, 20.0, 80_percent, 1_percent, 0.5}), "");
}

} // namespace hapnet::emulator
