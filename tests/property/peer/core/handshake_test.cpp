// SPDX-FileCopyrightText: 2026 The Hapnet authors
// SPDX-License-Identifier: MIT
#include "peer/core/handshake.hpp"

#include "tests/support/seeds.hpp"
#include "tests/unit/peer/core/meeting.hpp"

#include <gtest/gtest.h>

namespace hapnet::peer {
namespace {

using namespace std::chrono_literals;

/// Conditions drawn from a seed: up to 300 ms, order free, up to 90 % loss, some duplicates.
Path path_of(base::Seed seed)
{
    const auto draw = seed.stream("path");
    const auto least = base::from_seconds(0.2 * draw.uniform(0));
    return {.delay_min = least,
            .delay_max = least + base::from_seconds(0.1 * draw.uniform(1)),
            .loss = 0.9 * draw.uniform(2),
            .duplication = 0.3 * draw.uniform(3)};
}

void expect_agreement(Meeting& meeting, std::uint64_t seed)
{
    ASSERT_TRUE(meeting.agree()) << "seed " << seed;
    // Half of the largest difference of the two ways.
    ASSERT_LE(meeting.start_error(), 50ms + 1ns) << "seed " << seed;
    meeting.hellos = {};
    meeting.run_for(2s);
    ASSERT_EQ(meeting.hellos, (std::array<int, 2>{0, 0})) << "seed " << seed;
}

// At 90 % loss each of the five hellos needed takes 0.2 s on average. The probability that they
// take more than 20 s is below 1e-30. The states do the rest.
TEST(Handshake, EndsInAgreementUnderLossReorderingAndDuplication)
{
    for (std::uint64_t seed = 0; seed < test::seeds(100); ++seed) {
        Meeting meeting{path_of(base::Seed{seed}), base::Seed{seed}};
        meeting.ahead[1] = base::from_seconds(1000.0 * base::Seed{seed}.stream("clock").uniform(0));
        meeting.run_for(20s);
        expect_agreement(meeting, seed);
    }
}

TEST(Handshake, TellsTheStartWithinASecondAndAHalfAlsoAt97PercentLoss)
{
    const Path path{.delay_min = 200ms, .delay_max = 230ms, .loss = 0.97};
    for (std::uint64_t seed = 0; seed < test::seeds(100); ++seed) {
        Meeting meeting{path, base::Seed{seed}};
        while (!meeting.sides[0]->session()) meeting.step();
        while (!meeting.sides[1]->session()) meeting.step();
        EXPECT_LT(meeting.now - meeting.sides[0]->session()->start, 1500ms) << "seed " << seed;
    }
}

TEST(Handshake, EndsInAgreementAfterAnyRestarts)
{
    for (std::uint64_t seed = 0; seed < test::seeds(100); ++seed) {
        const auto draw = base::Seed{seed}.stream("restarts");
        Meeting meeting{path_of(base::Seed{seed}), base::Seed{seed}};
        for (std::uint64_t restart = 0; restart < 4; ++restart) {
            meeting.run_for(base::from_seconds(3.0 * draw.uniform(restart, 0)));
            const std::size_t side = draw.below(2, restart, 1);
            if (draw.below(2, restart, 2) != 0) {
                meeting.kill(side);
                meeting.run_for(base::from_seconds(draw.uniform(restart, 3)));
            }
            meeting.restart(side);
        }
        meeting.run_for(20s);
        ASSERT_TRUE(meeting.agree()) << "seed " << seed;
        meeting.hellos = {};
        meeting.run_for(2s);
        ASSERT_EQ(meeting.hellos, (std::array<int, 2>{0, 0})) << "seed " << seed;
    }
}

} // namespace
} // namespace hapnet::peer
