// SPDX-FileCopyrightText: 2026 The Hapnet authors
// SPDX-License-Identifier: MIT
#include "lab/report/demo_page.hpp"
#include "tests/unit/lab/records/recording.hpp"

#include <gtest/gtest.h>

namespace hapnet::lab {
namespace {

/// The cube at 1 mm per millisecond, the device at 1 N per second.
void move(record::TickRow& row, base::Duration time)
{
    row.cube = {{base::to_seconds(time), 0.0, 0.0}};
    row.device = {{0.0, base::to_seconds(time), 0.0}};
}

TEST(TaskTrace, HoldsEveryTenthTickOfTheSessionInMillimetresAndNewtons)
{
    Recording a{1};
    Recording b{2};
    a.session(1s).ticks(-1s, 0s, Phase::countdown).ticks(0s, 50ms, Phase::running, move);
    b.session(1s).ticks(20ms, 50ms, Phase::running, move);
    const auto session = common_session(a.content(), b.content());
    ASSERT_TRUE(session);
    const TaskTrace trace = task_trace_of(*session);
    ASSERT_EQ(trace.cube_a_mm.size(), 5U);
    EXPECT_DOUBLE_EQ(trace.cube_a_mm[3].x, 0.030);
    EXPECT_DOUBLE_EQ(trace.cube_a_mm[3].y, 30.0);
    EXPECT_DOUBLE_EQ(trace.force_a_n[3].y, 0.030);
    ASSERT_EQ(trace.cube_b_mm.size(), 3U);
    EXPECT_DOUBLE_EQ(trace.cube_b_mm[0].x, 0.020);
}

TEST(DemoPage, IsOnePageWithTheTableFourPlotsAndTheManifest)
{
    const DemoCircumstances circumstances{"scripts/demo.sh --out <here & there>", "now", 1.0, {}};
    const auto none = nlohmann::ordered_json::object();
    const DemoTask nothing{none, none, none};
    const std::string page = demo_page({nothing, nothing}, circumstances, {}, {});
    EXPECT_TRUE(page.starts_with("<!DOCTYPE html>"));
    EXPECT_NE(page.find("Table 1 of the paper"), std::string::npos);
    EXPECT_NE(page.find("--out &lt;here &amp; there&gt;"), std::string::npos);
    EXPECT_EQ(page.find("<here"), std::string::npos);
    std::size_t plots = 0;
    for (auto at = page.find("<svg"); at != std::string::npos; at = page.find("<svg", at + 1)) {
        ++plots;
    }
    EXPECT_EQ(plots, 4U);
    EXPECT_EQ(page.find("http"), page.find("http://www.w3.org/2000/svg")); // fetches nothing
}

} // namespace
} // namespace hapnet::lab
