// SPDX-FileCopyrightText: 2026 The Hapnet authors
// SPDX-License-Identifier: MIT
#include "emulator/core/loss/loss.hpp"

#include "tests/unit/emulator/core/loss/running.hpp"

#include <gtest/gtest.h>
#include <memory>
#include <optional>
#include <string>
#include <vector>

namespace hapnet::emulator {

namespace {

using namespace base::literals; // NOLINT(google-build-using-namespace): literals only
using test::losses;
using test::packet;
using test::stream;

std::vector<LossLaw> one_of_each()
{
    const auto trace = std::make_shared<const LossTrace>(parse_loss_trace("0110 0010").value());
    return {RandomLoss{30_percent},
            BlockLoss{93, 100},
            PeriodicLoss{7, 3},
            Burst{4, 17},
            TimedBurst{20ms, 100ms},
            TimedBurst{5U, 50ms},
            Gilbert{10_percent, 5.0},
            GilbertElliott{1_percent, 10_percent, 2_percent, 80_percent},
            TimedGilbertElliott{100ms, 20ms, 0_percent, 100_percent},
            FourState{5_percent, 20.0, 80_percent, 1_percent},
            ListedLoss{{2, 3, 5, 7, 5000}},
            PatternLoss{{true, false, false}},
            TraceLoss{"losses.txt", trace},
            TimedTraceLoss{"losses.csv",
                           std::make_shared<const LossSeries>(
                               std::vector{0.1, 0.9}, std::vector<base::Duration>{0ms, 50ms})},
            Outage{{{10ms, 20ms}, {3s, 4s}}}};
}

} // namespace

TEST(LossProcess, NamesEveryLawAsInProfiles)
{
    std::string names;
    for (const LossLaw& law : one_of_each()) names += std::string{name_of(law)} + " ";
    EXPECT_EQ(names, "random k-of-n every burst timed-burst timed-burst gilbert gilbert-elliott "
                     "timed-gilbert-elliott four-state list pattern trace timed-trace "
                     "outage ");
}

TEST(LossProcess, SaysWhichLawTookADatagram)
{
    const std::vector<DropCause> causes{
        DropCause::random_loss,     DropCause::block_loss,      DropCause::periodic_loss,
        DropCause::burst_loss,      DropCause::burst_loss,      DropCause::burst_loss,
        DropCause::gilbert_elliott, DropCause::gilbert_elliott, DropCause::gilbert_elliott,
        DropCause::four_state,      DropCause::listed_loss,     DropCause::pattern_loss,
        DropCause::trace_loss,      DropCause::trace_loss,      DropCause::outage};
    const auto laws = one_of_each();
    for (std::size_t i = 0; i < laws.size(); ++i) {
        LossProcess process{laws[i], stream()};
        std::optional<DropCause> cause;
        for (std::uint64_t n = 0; !cause && n < 1000; ++n) cause = process.on_packet(packet(n));
        EXPECT_EQ(cause, causes[i]) << name_of(laws[i]);
    }
}

TEST(LossProcess, JudgesEquallyForTheSameStream)
{
    for (const LossLaw& law : one_of_each()) {
        EXPECT_EQ(losses(law, 3000), losses(law, 3000)) << name_of(law);
    }
}

TEST(LossProcess, ChangedToItsOwnLawAtAnyTimeJudgesAsIfNothingHadHappened)
{
    for (const LossLaw& law : one_of_each()) {
        LossProcess still{law, stream()};
        LossProcess changed{law, stream()};
        for (std::uint64_t n = 0; n < 6000; ++n) {
            ASSERT_EQ(still.on_packet(packet(n)), changed.on_packet(packet(n)))
                << name_of(law) << " " << n;
            ASSERT_EQ(still.state(), changed.state()) << name_of(law) << " " << n;
            changed.change(law);
        }
    }
}

TEST(LossProcess, ChangedToAnotherKindJudgesLikeANewOne)
{
    const LossLaw law = Gilbert{10_percent, 5.0};
    LossProcess changed{RandomLoss{50_percent}, stream()};
    changed.change(law);
    LossProcess fresh{law, stream()};
    EXPECT_EQ(losses(changed, 0, 1000), losses(fresh, 0, 1000));
}

TEST(LossLaw, IsAcceptedWhenItCanBeDone)
{
    const LossLaw law = Gilbert{93_percent, 13.3};
    EXPECT_TRUE(validate(law));
}

} // namespace hapnet::emulator
