// SPDX-FileCopyrightText: 2026 The Hapnet authors
// SPDX-License-Identifier: MIT
#include "lab/experiment/criteria_text.hpp"
#include "lab/metrics/criteria.hpp"

#include <gtest/gtest.h>
#include <string>
#include <string_view>

namespace hapnet::lab::metrics {
namespace {

std::string complaint(const std::string& text)
{
    const auto read = parse_criteria(text, "c.toml");
    return read ? "none" : read.error().message;
}

TEST(Criteria, ReadBackAsTheyWerePrinted)
{
    Criteria unusual;
    unusual.filter_order = FilterOrder::fourth;
    unusual.usable.vibration_max_m = {.first = 1.234e-3, .second = 0.1, .fourth = 3e-7};
    unusual.usable.slow_stiffness_error_max = 0.4321;
    unusual.usable.discrepancy_max_m = 0.02;
    unusual.usable.force_vibration_max_n = 0.25;
    unusual.usable.scored_share_min = 0.5;
    unusual.good.stiffness_error_max = 0.1;
    unusual.good.discrepancy_max_m = 0.001;
    unusual.good.force_discrepancy_max = 0.07;
    unusual.good.contact_lost_max = 0.0;
    unusual.good.drag_max_n = 0.001;
    for (const Criteria& printed : {Criteria{}, unusual}) {
        const auto read = parse_criteria(print_criteria(printed), "criteria.toml");
        ASSERT_TRUE(read) << read.error().message;
        EXPECT_EQ(*read, printed);
    }
}

TEST(Criteria, OfThePaperAreWhatIsBuiltIn)
{
    const auto read = experiment::load_criteria("paper", {});
    ASSERT_TRUE(read) << read.error().message;
    EXPECT_EQ(*read, Criteria{});
    // Below the line that names the run.
    const std::string_view text = experiment::built_in_criteria().front().text;
    EXPECT_EQ(print_criteria(*read), text.substr(text.find('\n') + 1));
}

TEST(Criteria, HaveTheirDefaultsWhereATextSaysNothing)
{
    EXPECT_EQ(parse_criteria("", "c").value(), Criteria{});
    const auto read = parse_criteria("[usable]\nvibration_max = { first = \"2mm\" }\n", "c");
    ASSERT_TRUE(read) << read.error().message;
    EXPECT_EQ(read->usable.vibration_max_m.first, 0.002);
    EXPECT_EQ(read->usable.vibration_max_m.second, Criteria{}.usable.vibration_max_m.second);
}

TEST(Criteria, AreRefusedWithThePlaceOfWhatIsWrong)
{
    EXPECT_EQ(complaint("filter_order = 3"),
              "c.toml:1:16: expected the filter order 1, 2 or 4, not 3");
    EXPECT_EQ(complaint("[good]\ncontact_lost_max = 77\n"),
              "c.toml:2:20: 77 is out of range: use 0 to 1");
    for (const std::string tier : {"usable", "good"}) {
        const auto gone = complaint("[" + tier + "]\nstiffness_ratio_min = 0.07\n");
        EXPECT_TRUE(gone.starts_with("c.toml:2:1: ")) << gone;
        EXPECT_NE(gone.find("write slow_stiffness_error_max below [usable] and "
                            "stiffness_error_max below [good]"),
                  std::string::npos)
            << gone;
    }
    EXPECT_TRUE(complaint("[usable]\nforce_vibration_max = \"-0.1N\"\n")
                    .starts_with("c.toml:2:23: '-0.1N' is too small: use 0"));
    EXPECT_TRUE(complaint("[usable]\nforce_vibration_max = 0.1\n").starts_with("c.toml:2:23: "));
    EXPECT_TRUE(complaint("[usable]\nvibration = \"1mm\"\n").starts_with("c.toml:2:1: "));
    EXPECT_TRUE(complaint("usable = 1\n").starts_with("c.toml:1:10: "));
    EXPECT_TRUE(complaint("[usable\n").starts_with("c.toml:1:"));
}

} // namespace
} // namespace hapnet::lab::metrics
